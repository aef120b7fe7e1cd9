#include "tree/arcs_by_runs.h"

#include <utility>

#include "base/bit_ranks.h"
#include "base/memory_limit.h"
#include "tree/contour_tree.h"

namespace isoatlas {
namespace {

/// Which run a node is in. The outside is a run of its own.
class RunsOfNodes {
public:
    template <class Id>
    RunsOfNodes(std::span<const std::uint8_t> branches, std::span<const Id> join, std::span<const Id> split) : starts_(join.size()) {
        constexpr std::uint8_t kRegular = branches_of(1, 1);
        const std::size_t n = branches.size();
        BudgetPoll memory;
        for (std::size_t i = 0; i <= n; ++i) {
            memory.step();
            const bool goes_on = i > 0 && i < n && branches[i - 1] == kRegular && branches[i] == kRegular &&
                                 join[i - 1] == static_cast<Id>(i) && split[i] == static_cast<Id>(i - 1);
            if (!goes_on) starts_.add(i);
        }
        count_ = starts_.count();
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] bool starts(std::size_t node) const { return starts_.has(node); }
    [[nodiscard]] std::size_t of(std::size_t node) const { return starts_.rank(node + 1) - 1; }

private:
    BitRanks starts_;
    std::size_t count_;
};

}  // namespace

template <class Id>
BigVector<Id> arcs_by_runs(std::span<const std::uint8_t> branches, BigVector<Id> join, BigVector<Id> split, int threads) {
    const std::size_t nodes = join.size();
    const RunsOfNodes runs(branches, std::span<const Id>(join), std::span<const Id>(split));
    BigVector<Id> first, join_of_runs, split_of_runs;
    for (BigVector<Id>* of_runs : {&first, &join_of_runs, &split_of_runs}) of_runs->reserve(runs.count() + 1);
    BudgetPoll memory;
    for (std::size_t i = 0; i < nodes; ++i) {
        memory.step();
        if (runs.starts(i)) {
            first.push_back(static_cast<Id>(i));
            split_of_runs.push_back(static_cast<Id>(runs.of(split[i])));
        }
        if (i + 1 == nodes || runs.starts(i + 1)) join_of_runs.push_back(static_cast<Id>(runs.of(join[i])));
    }
    first.push_back(static_cast<Id>(nodes));
    release(join);
    release(split);
    const ContourTree<Id> tree = [&] {
        const PinInMemory keep;
        return contour_tree<Id>(join_of_runs, std::move(split_of_runs), {}, threads);
    }();
    BigVector<Id> other(nodes);
    for (std::size_t run = 0; run < runs.count(); ++run) {
        memory.step();
        const Id begin = first[run], last = first[run + 1] - 1, to = tree.other[run];
        const bool down = to > static_cast<Id>(run);
        for (Id i = begin; i <= last; ++i) other[i] = down ? i + 1 : i - 1;
        if (to == static_cast<Id>(run)) {
            other[begin] = begin;  // the outside
        } else if (down) {
            other[last] = first[to];
        } else {
            other[begin] = first[to + 1] - 1;
        }
    }
    return other;
}

template BigVector<std::uint32_t> arcs_by_runs(std::span<const std::uint8_t>, BigVector<std::uint32_t>, BigVector<std::uint32_t>, int);
template BigVector<std::uint64_t> arcs_by_runs(std::span<const std::uint8_t>, BigVector<std::uint64_t>, BigVector<std::uint64_t>, int);

}  // namespace isoatlas

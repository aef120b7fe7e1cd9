#include "tree/arcs_by_runs.h"

#include <utility>

#include "base/bit_ranks.h"
#include "base/memory_limit.h"
#include "base/streamed.h"
#include "tree/contour_tree.h"

namespace isoatlas {
namespace {

/// Which run a node is in. The outside is a run of its own.
class RunsOfNodes {
public:
    template <class Number>
    RunsOfNodes(ByElementView<Number, std::uint8_t> branches, MergeTreeView<Number> join, MergeTreeView<Number> split)
        : starts_(join.size()) {
        using Element = ElementIdOf<Number>;
        constexpr std::uint8_t kRegular = branches_of(1, 1);
        const Element outside(branches.size());
        for (const Element i : streamed<Element>(join.size(), in_order(8))) {
            const bool goes_on = i > Element(0) && i < outside && branches[i.previous()] == kRegular && branches[i] == kRegular &&
                                 join[i.previous()] == i && split[i] == i.previous();
            if (!goes_on) starts_.add(i.index());
        }
        count_ = starts_.count();
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    template <class Element>
    [[nodiscard]] bool starts(Element node) const {
        return starts_.has(node.index());
    }
    /// Runs are the elements of a smaller tree.
    template <class Element>
    [[nodiscard]] Element of(Element node) const {
        return Element(starts_.rank(node.index() + 1) - 1);
    }

private:
    BitRanks starts_;
    std::size_t count_;
};

}  // namespace

template <class Number>
ByElement<Number, ElementIdOf<Number>> arcs_by_runs(ByElementView<Number, std::uint8_t> branches, MergeTree<Number> join,
                                                    MergeTree<Number> split, int threads) {
    using Element = ElementIdOf<Number>;
    const std::size_t nodes = join.size();
    const RunsOfNodes runs(branches, MergeTreeView<Number>(join), MergeTreeView<Number>(split));
    ByElement<Number, Element> first;  // element of every run, and of the end
    MergeTree<Number> join_of_runs, split_of_runs;
    for (MergeTree<Number>* of_runs : {&first, &join_of_runs, &split_of_runs}) of_runs->items().reserve(runs.count() + 1);
    for (const Element i : streamed<Element>(nodes, in_order(8))) {
        if (runs.starts(i)) {
            first.push_back(i);
            split_of_runs.push_back(runs.of(split[i]));
        }
        if (i.index() + 1 == nodes || runs.starts(i.next())) join_of_runs.push_back(runs.of(join[i]));
    }
    first.push_back(Element(nodes));
    release(join.items());
    release(split.items());
    const ContourTree<Number> tree = [&] {
        const PinInMemory keep;
        return contour_tree<Number>(join_of_runs, std::move(split_of_runs), {}, threads);
    }();
    ByElement<Number, Element> other(nodes);
    for (const Element run : streamed<Element>(runs.count(), in_order(8))) {
        const Element begin = first[run], last = first[run.next()].previous(), to = tree.other[run];
        const bool down = to > run;
        for (Element i = begin; i <= last; ++i) other[i] = down ? i.next() : i.previous();
        if (to == run) {
            other[begin] = begin;  // the outside
        } else if (down) {
            other[last] = first[to];
        } else {
            other[begin] = first[to.next()].previous();
        }
    }
    return other;
}

#define ISOATLAS_RUNS(Number) \
    template MergeTree<Number> arcs_by_runs(ByElementView<Number, std::uint8_t>, MergeTree<Number>, MergeTree<Number>, int);
ISOATLAS_RUNS(std::uint32_t)
ISOATLAS_RUNS(std::uint64_t)
#undef ISOATLAS_RUNS

}  // namespace isoatlas

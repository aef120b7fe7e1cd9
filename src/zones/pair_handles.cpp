#include <algorithm>
#include <queue>

#include "base/check.h"
#include "field/order.h"
#include "isoatlas/handles.h"
#include "zones/analysis_data.h"

namespace isoatlas {
namespace {

template <class Id>
struct Pair {
    Id opens, closes;  ///< elements
};

/// Walks down the contour tree with the open tunnels of every contour. Elements descend: the largest number was opened last.
template <class Id>
class HandlePairs {
public:
    explicit HandlePairs(const ContourTree<Id>& tree) : tree_(tree), in_(tree.nodes()), out_(tree.nodes()) {
        for (std::size_t arc = 0; arc < tree.nodes(); ++arc) {
            if (!tree.has_arc(arc)) continue;
            in_[tree.lower(arc)].push_back(static_cast<Id>(arc));
            out_[tree.upper(arc)].push_back(static_cast<Id>(arc));
        }
    }

    [[nodiscard]] std::vector<Pair<Id>> pairs() && {
        open_.resize(tree_.nodes());
        for (std::size_t element = 0; element + 1 < tree_.nodes(); ++element) pass(element);
        return std::move(pairs_);
    }

private:
    using Open = std::priority_queue<Id>;

    [[nodiscard]] std::int64_t genus(std::size_t arc) const { return 1 - static_cast<std::int64_t>(tree_.half_chi[arc]); }

    /// Contours arrive, a tunnel opens or closes, contours leave.
    void pass(std::size_t element) {
        Open open;
        std::int64_t change = 0;
        for (const Id arc : in_[element]) {
            change -= genus(arc);
            if (open_[arc].size() > open.size()) std::swap(open, open_[arc]);
            for (; !open_[arc].empty(); open_[arc].pop()) open.push(open_[arc].top());
            open_[arc] = {};
        }
        for (const Id arc : out_[element]) change += genus(arc);
        for (; change > 0; --change) open.push(static_cast<Id>(element));
        for (; change < 0; ++change) {
            ISOATLAS_CHECK(!open.empty());
            pairs_.push_back({open.top(), static_cast<Id>(element)});
            open.pop();
        }
        leave(element, open);
    }

    /// Where a contour splits, those with fewest tunnels take the last ones.
    void leave(std::size_t element, Open& open) {
        auto& arcs = out_[element];
        std::ranges::stable_sort(arcs, {}, [this](Id arc) { return genus(arc); });
        for (std::size_t i = 0; i + 1 < arcs.size(); ++i) {
            for (std::int64_t k = genus(arcs[i]); k > 0; --k) {
                open_[arcs[i]].push(open.top());
                open.pop();
            }
        }
        if (!arcs.empty()) std::swap(open_[arcs.back()], open);
    }

    const ContourTree<Id>& tree_;
    std::vector<std::vector<Id>> in_, out_;  // per node: arcs that end, begin there
    std::vector<Open> open_;                 // per arc
    std::vector<Pair<Id>> pairs_;
};

template <class Id>
std::vector<Handle> handles_of(const AnalysisArrays<Id>& arrays, const Extent& extent, double least) {
    std::vector<Pair<Id>> pairs = HandlePairs<Id>(arrays.contours).pairs();
    const auto persistence = [&](const Pair<Id>& pair) { return arrays.value[pair.opens] - arrays.value[pair.closes]; };
    std::erase_if(pairs, [&](const Pair<Id>& pair) { return !(persistence(pair) > 0 && persistence(pair) >= least); });
    std::ranges::sort(pairs, [&](const Pair<Id>& p, const Pair<Id>& q) {
        return persistence(p) != persistence(q) ? persistence(p) > persistence(q) : p.opens < q.opens;
    });
    std::vector<Handle> handles;
    for (const Pair<Id>& pair : pairs) {
        handles.push_back({arrays.value[pair.opens], arrays.value[pair.closes],
                           element_position(ElementCode{arrays.code[pair.opens]}, extent),
                           element_position(ElementCode{arrays.code[pair.closes]}, extent),
                           static_cast<std::int64_t>(arrays.tree.event_of_element[pair.opens])});
    }
    return handles;
}

}  // namespace

std::vector<Handle> pair_handles(const Analysis& analysis, double least_persistence) {
    if (analysis.extent().rank == 2) return {};
    return analysis.data().visit([&](const auto& held) { return handles_of(held.arrays, analysis.extent(), least_persistence); });
}

}  // namespace isoatlas

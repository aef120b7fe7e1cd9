#include <algorithm>
#include <queue>

#include "base/check.h"
#include "isoatlas/handles.h"
#include "persistence/handle_pairs.h"

namespace isoatlas {
namespace {

/// Walks down the contour tree with the open tunnels of every contour. Elements descend: the largest number was opened last.
template <class Number>
class HandlePairs {
public:
    using Element = ElementIdOf<Number>;

    explicit HandlePairs(const ContourTree<Number>& tree) : tree_(tree), in_(tree.nodes()), out_(tree.nodes()) {
        for (const Element arc : tree.other.ids()) {
            if (!tree.has_arc(arc)) continue;
            in_[tree.lower(arc)].push_back(arc);
            out_[tree.upper(arc)].push_back(arc);
        }
    }

    [[nodiscard]] std::vector<HandlePair> pairs() && {
        open_.items().resize(tree_.nodes());
        for (const Element element : IdRange<Element>(tree_.outside().index())) pass(element);
        return std::move(pairs_);
    }

private:
    using Open = std::priority_queue<Element>;

    [[nodiscard]] std::int64_t genus(Element arc) const { return 1 - static_cast<std::int64_t>(tree_.half_chi[arc]); }

    /// Contours arrive, a tunnel opens or closes, contours leave.
    void pass(Element element) {
        Open open;
        std::int64_t change = 0;
        for (const Element arc : in_[element]) {
            change -= genus(arc);
            if (open_[arc].size() > open.size()) std::swap(open, open_[arc]);
            for (; !open_[arc].empty(); open_[arc].pop()) open.push(open_[arc].top());
            open_[arc] = {};
        }
        for (const Element arc : out_[element]) change += genus(arc);
        for (; change > 0; --change) open.push(element);
        for (; change < 0; ++change) {
            ISOATLAS_CHECK(!open.empty());
            pairs_.push_back({ElementId(open.top()), ElementId(element)});
            open.pop();
        }
        leave(element, open);
    }

    /// Where a contour splits, those with fewest tunnels take the last ones.
    void leave(Element element, Open& open) {
        std::vector<Element>& arcs = out_[element];
        std::ranges::stable_sort(arcs, {}, [this](Element arc) { return genus(arc); });
        for (std::size_t i = 0; i + 1 < arcs.size(); ++i) {
            for (std::int64_t k = genus(arcs[i]); k > 0; --k) {
                open_[arcs[i]].push(open.top());
                open.pop();
            }
        }
        if (!arcs.empty()) std::swap(open_[arcs.back()], open);
    }

    const ContourTree<Number>& tree_;
    ByElement<Number, std::vector<Element>> in_, out_;  // arcs that end, begin at a node
    ByElement<Number, Open> open_;                      // per arc
    std::vector<HandlePair> pairs_;
};

}  // namespace

std::vector<Handle> pair_handles(const Analysis& analysis, double min_persistence) {
    if (analysis.extent().rank == 2) return {};
    return analysis.data().visit([&](const auto& held) {
        return handles_of(held.arrays, analysis.extent(), HandlePairs(held.arrays.contours).pairs(), min_persistence);
    });
}

}  // namespace isoatlas

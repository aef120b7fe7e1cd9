#include <algorithm>
#include <numeric>

#include "analysis/analysis_data.h"

namespace isoatlas {
namespace {

/// Exclusive scan: counts (by list, shifted by one) become first positions.
template <class Number>
void accumulate(std::vector<Number>& first) {
    std::partial_sum(first.begin(), first.end(), first.begin());
}

/// Lists from (list, item) pairs given twice by `each(add)`.
template <class Number, class Each>
Lists<Number> make_lists(std::size_t lists, const Each& each) {
    Lists<Number> result{std::vector<Number>(lists + 1, Number{0}), {}};
    each([&](std::size_t list, Number) { ++result.first[list + 1]; });
    accumulate(result.first);
    result.item.resize(result.first.back());
    std::vector<Number> next(result.first.begin(), result.first.end() - 1);
    each([&](std::size_t list, Number item) { result.item[next[list]++] = item; });
    return result;
}

template <class Number>
void sort_lists(Lists<Number>& lists) {
    for (std::size_t i = 0; i + 1 < lists.first.size(); ++i) {
        std::sort(lists.item.begin() + lists.first[i], lists.item.begin() + lists.first[i + 1]);
    }
}

template <class Number>
std::vector<ElementIdOf<Number>> arcs_with_length(const AnalysisArrays<Number>& arrays) {
    const ContourTree<Number>& tree = arrays.contours;
    std::vector<ElementIdOf<Number>> arcs;
    for (const ElementIdOf<Number> x : tree.other.ids()) {
        if (!tree.has_arc(x)) continue;
        if (has_length<Number>(tree, arrays.value, x)) arcs.push_back(x);
    }
    std::sort(arcs.begin(), arcs.end(), [&](ElementIdOf<Number> p, ElementIdOf<Number> q) {
        return tree.upper(p) != tree.upper(q) ? tree.upper(p) < tree.upper(q) : tree.lower(p) < tree.lower(q);
    });
    return arcs;
}

}  // namespace

template <class Number>
LevelIndex<Number> index_levels(const AnalysisArrays<Number>& arrays) {
    LevelIndex<Number> index;
    const std::size_t n = arrays.value.size(), events = arrays.tree.size();
    const ContourTree<Number>& tree = arrays.contours;
    index.arcs = arcs_with_length(arrays);
    const auto genus = [&](ElementIdOf<Number> x) { return static_cast<Number>(1 - tree.half_chi[x]); };
    const Lists<Number> in = make_lists<Number>(n, [&](auto&& add) {
        for (const ElementIdOf<Number> x : index.arcs) {
            if (tree.lower(x) != tree.outside()) add(arrays.level[tree.lower(x)].index(), genus(x));
        }
    });
    const Lists<Number> out = make_lists<Number>(n, [&](auto&& add) {
        for (const ElementIdOf<Number> x : index.arcs) add(arrays.level[tree.upper(x)].index(), genus(x));
    });
    const auto is_trivial = [&](std::size_t r) {
        return in.first[r + 1] - in.first[r] == 1 && out.first[r + 1] - out.first[r] == 1 && in.item[in.first[r]] == out.item[out.first[r]];
    };
    for (const ElementIdOf<Number> r : arrays.level.ids()) {
        if (arrays.level[r] == r && !is_trivial(r.index())) index.levels.push_back(r);
    }
    const auto pick = [&](const Lists<Number>& from) {
        Lists<Number> picked = make_lists<Number>(index.levels.size(), [&](auto&& add) {
            for (std::size_t i = 0; i < index.levels.size(); ++i) {
                const std::size_t r = index.levels[i].index();
                for (Number k = from.first[r]; k < from.first[r + 1]; ++k) add(i, from.item[k]);
            }
        });
        sort_lists(picked);
        return picked;
    };
    index.level_in = pick(in);
    index.level_out = pick(out);
    index.event_levels = make_lists<Number>(events, [&](auto&& add) {
        for (std::size_t i = 0; i < index.levels.size(); ++i)
            add(arrays.tree.event_of_element[index.levels[i]].index(), static_cast<Number>(i));
    });
    return index;
}

template <class Number>
EventIndex<Number> index_events(const AnalysisArrays<Number>& arrays) {
    EventIndex<Number> index;
    const std::size_t events = arrays.tree.size();
    const Lists<Number> children = make_lists<Number>(events, [&](auto&& add) {
        for (const EventIdOf<Number> e : arrays.tree.parent.ids()) {
            if (!arrays.tree.is_root(e)) add(arrays.tree.parent[e].index(), e.number());
        }
    });
    index.first_child.assign(children.first.begin(), children.first.end());
    index.children.reserve(children.item.size());
    for (const Number child : children.item) index.children.emplace_back(child);
    index.object_voxels.assign(arrays.voxels.items().begin(), arrays.voxels.items().end());
    for (const EventIdOf<Number> e : arrays.voxels.ids()) {
        if (!arrays.tree.is_root(e)) index.object_voxels[arrays.tree.parent[e].index()] += index.object_voxels[e.index()];
    }
    return index;
}

#define ISOATLAS_INDEX(Number)                                               \
    template LevelIndex<Number> index_levels(const AnalysisArrays<Number>&); \
    template EventIndex<Number> index_events(const AnalysisArrays<Number>&);
ISOATLAS_INDEX(std::uint32_t)
ISOATLAS_INDEX(std::uint64_t)
#undef ISOATLAS_INDEX

}  // namespace isoatlas

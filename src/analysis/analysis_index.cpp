#include <algorithm>
#include <numeric>

#include "analysis/analysis_data.h"

namespace isoatlas {
namespace {

/// Exclusive scan: counts (by list, shifted by one) become first positions.
template <class Id>
void accumulate(std::vector<Id>& first) {
    std::partial_sum(first.begin(), first.end(), first.begin());
}

/// Lists from (list, item) pairs given twice by `each(add)`.
template <class Id, class Each>
Lists<Id> make_lists(std::size_t lists, const Each& each) {
    Lists<Id> result{std::vector<Id>(lists + 1, Id{0}), {}};
    each([&](std::size_t list, Id) { ++result.first[list + 1]; });
    accumulate(result.first);
    result.item.resize(result.first.back());
    std::vector<Id> next(result.first.begin(), result.first.end() - 1);
    each([&](std::size_t list, Id item) { result.item[next[list]++] = item; });
    return result;
}

template <class Id>
void sort_lists(Lists<Id>& lists) {
    for (std::size_t i = 0; i + 1 < lists.first.size(); ++i) {
        std::sort(lists.item.begin() + lists.first[i], lists.item.begin() + lists.first[i + 1]);
    }
}

template <class Id>
std::vector<Id> arcs_with_length(const AnalysisArrays<Id>& arrays) {
    const ContourTree<Id>& tree = arrays.contours;
    const std::size_t n = arrays.value.size();
    std::vector<Id> arcs;
    for (std::size_t x = 0; x <= n; ++x) {
        if (!tree.has_arc(x)) continue;
        if (has_length<Id>(tree, arrays.value, x)) arcs.push_back(static_cast<Id>(x));
    }
    std::sort(arcs.begin(), arcs.end(),
              [&](Id p, Id q) { return tree.upper(p) != tree.upper(q) ? tree.upper(p) < tree.upper(q) : tree.lower(p) < tree.lower(q); });
    return arcs;
}

}  // namespace

template <class Id>
LevelIndex<Id> index_levels(const AnalysisArrays<Id>& arrays) {
    LevelIndex<Id> index;
    const std::size_t n = arrays.value.size(), events = arrays.tree.size();
    const ContourTree<Id>& tree = arrays.contours;
    index.arcs = arcs_with_length(arrays);
    const auto genus = [&](Id x) { return static_cast<Id>(1 - tree.half_chi[x]); };
    const Lists<Id> in = make_lists<Id>(n, [&](auto&& add) {
        for (const Id x : index.arcs) {
            if (tree.lower(x) != static_cast<Id>(n)) add(arrays.level[tree.lower(x)], genus(x));
        }
    });
    const Lists<Id> out = make_lists<Id>(n, [&](auto&& add) {
        for (const Id x : index.arcs) add(arrays.level[tree.upper(x)], genus(x));
    });
    const auto is_trivial = [&](std::size_t r) {
        return in.first[r + 1] - in.first[r] == 1 && out.first[r + 1] - out.first[r] == 1 && in.item[in.first[r]] == out.item[out.first[r]];
    };
    for (std::size_t r = 0; r < n; ++r) {
        if (arrays.level[r] == static_cast<Id>(r) && !is_trivial(r)) index.levels.push_back(static_cast<Id>(r));
    }
    const auto pick = [&](const Lists<Id>& from) {
        Lists<Id> picked = make_lists<Id>(index.levels.size(), [&](auto&& add) {
            for (std::size_t i = 0; i < index.levels.size(); ++i) {
                const std::size_t r = index.levels[i];
                for (Id k = from.first[r]; k < from.first[r + 1]; ++k) add(i, from.item[k]);
            }
        });
        sort_lists(picked);
        return picked;
    };
    index.level_in = pick(in);
    index.level_out = pick(out);
    index.event_levels = make_lists<Id>(events, [&](auto&& add) {
        for (std::size_t i = 0; i < index.levels.size(); ++i) add(arrays.tree.event_of_element[index.levels[i]], static_cast<Id>(i));
    });
    return index;
}

template <class Id>
EventIndex<Id> index_events(const AnalysisArrays<Id>& arrays) {
    EventIndex<Id> index;
    const std::size_t events = arrays.tree.size();
    const Lists<Id> children = make_lists<Id>(events, [&](auto&& add) {
        for (std::size_t e = 0; e < events; ++e) {
            if (!arrays.tree.is_root(e)) add(arrays.tree.parent[e], static_cast<Id>(e));
        }
    });
    index.first_child.assign(children.first.begin(), children.first.end());
    index.children.reserve(children.item.size());
    for (const Id child : children.item) index.children.emplace_back(child);
    index.object_voxels.assign(arrays.voxels.begin(), arrays.voxels.end());
    for (std::size_t e = 0; e < index.object_voxels.size(); ++e) {
        if (!arrays.tree.is_root(e)) index.object_voxels[arrays.tree.parent[e]] += index.object_voxels[e];
    }
    return index;
}

#define ISOATLAS_INDEX(Id)                                           \
    template LevelIndex<Id> index_levels(const AnalysisArrays<Id>&); \
    template EventIndex<Id> index_events(const AnalysisArrays<Id>&);
ISOATLAS_INDEX(std::uint32_t)
ISOATLAS_INDEX(std::uint64_t)
#undef ISOATLAS_INDEX

}  // namespace isoatlas

#include "analysis/trees.h"

#include <algorithm>
#include <utility>

#include "base/cancel.h"
#include "base/check.h"
#include "base/parallel.h"
#include "base/streamed.h"
#include "critical/scan.h"
#include "tree/contour_tree.h"
#include "tree/criticality_tree.h"
#include "tree/levels.h"
#include "tree/merge_tree.h"
#include "tree/predicates.h"

namespace isoatlas {
namespace {

/// Levels and events. join: parents of the join tree.
template <class Number>
ElementMeasures<Number> make_events(MergeTreeView<Number> join, AnalysisArrays<Number>& arrays, int rank, const Context& context) {
    stop_if_cancelled(context);
    ByElement<Number, std::int8_t> delta = rank == 3 ? delta_chis(arrays.code, 3) : ByElement<Number, std::int8_t>();
    ByElement<Number, ElementIdOf<Number>> group;
    run_both(
        context.threads, [&] { arrays.level = level_roots<Number>(arrays.contours, arrays.value); },
        [&] { group = join_groups<Number>(join, arrays.value); });
    ISOATLAS_DCHECK(every_level_has_one_value<Number>(arrays.contours, arrays.level, arrays.value));
    ByElement<Number, LevelKind> kind = level_kinds<Number>(arrays.contours, arrays.level, arrays.value, delta);
    stop_if_cancelled(context);
    arrays.tree = criticality_tree<Number>(std::move(group), join, arrays.level, kind, context.threads);
    ISOATLAS_DCHECK(every_event_has_its_zone<Number>(arrays.tree, arrays.value));
    stop_if_cancelled(context);
    if (rank != 3) delta = delta_chis(arrays.code, rank);
    return {std::move(delta), std::move(kind)};
}

/// Of the High set when all elements are in it.
template <class Number>
std::int64_t euler_number(const ByElement<Number, std::uint64_t>& code, int rank) {
    std::int64_t sum = 0;
    for (const auto x : streamed<ElementIdOf<Number>>(code.size(), in_order(1))) sum += delta_chi(ElementCode{code[x]}, rank);
    return sum;
}

}  // namespace

template <class Number>
ByElement<Number, std::int8_t> delta_chis(const ByElement<Number, std::uint64_t>& code, int rank) {
    ByElement<Number, std::int8_t> delta(code.size());
    for (const auto x : streamed<ElementIdOf<Number>>(code.size(), in_order(2))) {
        delta[x] = static_cast<std::int8_t>(delta_chi(ElementCode{code[x]}, rank));
    }
    return delta;
}

template <class Number>
MergeTree<Number> make_arcs(CriticalSet<Number> set, AnalysisArrays<Number>& arrays, int threads) {
    MergeTree<Number> join, split;
    run_both(threads, [&] { join = join_tree(set); }, [&] { split = split_tree(set); });
    for (auto* field : {&set.up_a, &set.up_b}) release(field->items());
    for (auto* field : {&set.low_a, &set.low_b}) release(field->items());
    ISOATLAS_DCHECK(is_join_tree<Number>(join));
    ISOATLAS_DCHECK(is_split_tree<Number>(split));
    const bool is_3d = set.rank == 3;
    const ByElement<Number, std::int8_t> delta = is_3d ? delta_chis(set.code, 3) : ByElement<Number, std::int8_t>();
    arrays.contours = contour_tree<Number>(join, std::move(split), delta, threads);
    ISOATLAS_DCHECK(is_contour_tree(arrays.contours));
    if (!is_3d) std::ranges::fill(arrays.contours.half_chi.items(), 1);
    arrays.value = std::move(set.value);
    arrays.code = std::move(set.code);
    return join;
}

template <class Number>
ElementMeasures<Number> make_trees(CriticalSet<Number> set, AnalysisArrays<Number>& arrays, const Context& context) {
    const int rank = set.rank;
    const MergeTree<Number> join = make_arcs(std::move(set), arrays, context.threads);
    return make_events<Number>(join, arrays, rank, context);
}

template <class Number>
void make_measures(const ElementMeasures<Number>& elements, AnalysisArrays<Number>& arrays, int threads) {
    arrays.measures = measure_events<Number>(arrays.tree, arrays.contours, arrays.level, elements.kind, elements.delta_chi, threads);
}

template <class Number>
bool restore_trees(AnalysisArrays<Number>& arrays, int rank, const Context& context) {
    const bool is_3d = rank == 3;
    if (arrays.contours.other.size() != arrays.value.size() + 1 || arrays.code.size() != arrays.value.size()) return false;
    if (euler_number(arrays.code, rank) != 1) return false;  // the volume is a box
    if (!complete_contour_tree<Number>(arrays.contours, is_3d ? delta_chis(arrays.code, 3) : ByElement<Number, std::int8_t>()))
        return false;
    if (!is_3d) std::ranges::fill(arrays.contours.half_chi.items(), 1);
    stop_if_cancelled(context);
    const MergeTree<Number> join = join_tree_of(arrays.contours);
    make_measures(make_events<Number>(join, arrays, rank, context), arrays, context.threads);
    return true;
}

template <class Number>
void add_up_voxels(ByElementView<Number, Number> element_voxels, AnalysisArrays<Number>& arrays) {
    arrays.voxels.items().assign(arrays.tree.size(), Number{0});
    for (const auto i : element_voxels.ids()) arrays.voxels[arrays.tree.event_of_element[i]] += element_voxels[i];
}

#define ISOATLAS_TREES(Number)                                                                                 \
    template ByElement<Number, std::int8_t> delta_chis(const ByElement<Number, std::uint64_t>&, int);          \
    template MergeTree<Number> make_arcs(CriticalSet<Number>, AnalysisArrays<Number>&, int);                   \
    template ElementMeasures<Number> make_trees(CriticalSet<Number>, AnalysisArrays<Number>&, const Context&); \
    template void make_measures(const ElementMeasures<Number>&, AnalysisArrays<Number>&, int);                 \
    template bool restore_trees(AnalysisArrays<Number>&, int, const Context&);                                 \
    template void add_up_voxels(ByElementView<Number, Number>, AnalysisArrays<Number>&);
ISOATLAS_TREES(std::uint32_t)
ISOATLAS_TREES(std::uint64_t)
#undef ISOATLAS_TREES

}  // namespace isoatlas

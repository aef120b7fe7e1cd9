#include "analysis/trees.h"

#include <algorithm>
#include <utility>

#include "base/cancel.h"
#include "base/check.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "critical/scan.h"
#include "tree/contour_tree.h"
#include "tree/criticality_tree.h"
#include "tree/levels.h"
#include "tree/merge_tree.h"
#include "tree/predicates.h"

namespace isoatlas {
namespace {

/// Levels, events and their measures. join: parents of the join tree.
template <class Id>
void make_events(std::span<const Id> join, AnalysisArrays<Id>& arrays, int rank, const Context& context) {
    stop_if_cancelled(context);
    BigVector<std::int8_t> delta = rank == 3 ? delta_chis(arrays.code, 3) : BigVector<std::int8_t>();
    BigVector<Id> group;
    run_both(
        context.threads, [&] { arrays.level = level_roots<Id>(arrays.contours, arrays.value); },
        [&] { group = join_groups<Id>(join, arrays.value); });
    ISOATLAS_DCHECK(every_level_has_one_value<Id>(arrays.contours, arrays.level, arrays.value));
    const BigVector<LevelKind> kind = level_kinds<Id>(arrays.contours, arrays.level, arrays.value, delta);
    stop_if_cancelled(context);
    arrays.tree = criticality_tree<Id>(std::move(group), join, arrays.level, kind);
    ISOATLAS_DCHECK(every_event_has_its_zone<Id>(arrays.tree, arrays.value));
    stop_if_cancelled(context);
    if (rank != 3) delta = delta_chis(arrays.code, rank);
    arrays.measures = measure_events<Id>(arrays.tree, arrays.contours, arrays.level, kind, delta, context.threads);
}

/// Of the High set when all elements are in it.
std::int64_t euler_number(std::span<const std::uint64_t> code, int rank) {
    std::int64_t sum = 0;
    BudgetPoll memory;
    for (const std::uint64_t bits : code) sum += delta_chi(ElementCode{bits}, rank), memory.step(sizeof bits);
    return sum;
}

}  // namespace

BigVector<std::int8_t> delta_chis(std::span<const std::uint64_t> code, int rank) {
    BigVector<std::int8_t> delta(code.size());
    BudgetPoll memory;
    for (std::size_t i = 0; i < delta.size(); ++i) {
        memory.step(sizeof(std::uint64_t) + 1);
        delta[i] = static_cast<std::int8_t>(delta_chi(ElementCode{code[i]}, rank));
    }
    return delta;
}

template <class Id>
BigVector<Id> make_arcs(CriticalSet<Id> set, AnalysisArrays<Id>& arrays, int threads) {
    BigVector<Id> join, split;
    run_both(threads, [&] { join = join_tree(set); }, [&] { split = split_tree(set); });
    for (BigVector<Id>* field : {&set.up_a, &set.up_b, &set.low_a, &set.low_b}) release(*field);
    ISOATLAS_DCHECK(is_join_tree<Id>(join));
    ISOATLAS_DCHECK(is_split_tree<Id>(split));
    const bool is_3d = set.rank == 3;
    arrays.contours = contour_tree<Id>(join, std::move(split), is_3d ? delta_chis(set.code, 3) : BigVector<std::int8_t>(), threads);
    ISOATLAS_DCHECK(is_contour_tree(arrays.contours));
    if (!is_3d) std::fill(arrays.contours.half_chi.begin(), arrays.contours.half_chi.end(), 1);
    arrays.value = std::move(set.value);
    arrays.code = std::move(set.code);
    return join;
}

template <class Id>
void make_trees(CriticalSet<Id> set, AnalysisArrays<Id>& arrays, const Context& context) {
    const int rank = set.rank;
    const BigVector<Id> join = make_arcs(std::move(set), arrays, context.threads);
    make_events<Id>(join, arrays, rank, context);
}

template <class Id>
bool restore_trees(AnalysisArrays<Id>& arrays, int rank, const Context& context) {
    const bool is_3d = rank == 3;
    if (arrays.contours.other.size() != arrays.value.size() + 1 || arrays.code.size() != arrays.value.size()) return false;
    if (euler_number(arrays.code, rank) != 1) return false;  // the volume is a box
    if (!complete_contour_tree<Id>(arrays.contours, is_3d ? delta_chis(arrays.code, 3) : BigVector<std::int8_t>())) return false;
    if (!is_3d) std::fill(arrays.contours.half_chi.begin(), arrays.contours.half_chi.end(), 1);
    stop_if_cancelled(context);
    const BigVector<Id> join = join_tree_of(arrays.contours);
    make_events<Id>(join, arrays, rank, context);
    return true;
}

template <class Id>
void add_up_voxels(std::span<const Id> element_voxels, AnalysisArrays<Id>& arrays) {
    arrays.voxels.assign(arrays.tree.size(), Id{0});
    for (std::size_t i = 0; i < element_voxels.size(); ++i) {
        arrays.voxels[arrays.tree.event_of_element[i]] += element_voxels[i];
    }
}

#define ISOATLAS_TREES(Id)                                                          \
    template BigVector<Id> make_arcs(CriticalSet<Id>, AnalysisArrays<Id>&, int);    \
    template void make_trees(CriticalSet<Id>, AnalysisArrays<Id>&, const Context&); \
    template bool restore_trees(AnalysisArrays<Id>&, int, const Context&);          \
    template void add_up_voxels(std::span<const Id>, AnalysisArrays<Id>&);
ISOATLAS_TREES(std::uint32_t)
ISOATLAS_TREES(std::uint64_t)
#undef ISOATLAS_TREES

}  // namespace isoatlas

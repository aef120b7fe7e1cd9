#include "atlas/stored_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "atlas/access.h"
#include "atlas/event_arrays.h"
#include "atlas/object_arrays.h"
#include "atlas/tree_arrays.h"
#include "features/hierarchy.h"
#include "features/keep_entries.h"
#include "field/volume_view.h"
#include "isoatlas/atlas.h"
#include "store/container.h"

namespace isoatlas {
namespace {

bool is_uniform(const Geometry& geometry) {
    return std::ranges::all_of(geometry.coordinates, [](const auto& c) { return c.size() < 2; });
}

/// Per event; nullopt when the store does not have it.
std::optional<ZoneSums> stored_sums(const Atlas& atlas, const Analysis& analysis) {
    const Container& store = AtlasAccess::store(atlas);
    const std::vector<double> sums = event_sums_of(store, analysis.event_count());
    if (sums.empty() || !analysis.counts_voxels()) return std::nullopt;
    if (!std::ranges::all_of(sums, [](double sum) { return std::isfinite(sum); })) {
        throw Error(ErrorKind::input, {.file = store.path(),
                                       .where = "events/sum",
                                       .what = "a sum is not finite",
                                       .next = "the store is damaged: build it again from the volume"});
    }
    ZoneSums zones{{}, atlas.range()[0]};
    zones.height.items().assign(sums.begin(), sums.end());
    return zones;
}

}  // namespace

std::optional<BranchHierarchy> stored_hierarchy(const Atlas& atlas, const Context& context) {
    const Container& store = AtlasAccess::store(atlas);
    if (!has_objects(store)) return std::nullopt;
    const ObjectTable table = objects_of(store);
    if (!is_whole(table) || !knows_branches(table)) return std::nullopt;  // significant ones may be missing
    std::vector<EventId> tops;
    for (const ObjectEntry& entry : table.entries) tops.push_back(entry.branch_top);
    std::ranges::sort(tops);
    if (is_uniform(atlas.info().geometry) && has_event_sums(store)) {
        const Analysis& analysis = AtlasAccess::analysis(atlas);
        if (const std::optional<ZoneSums> zones = stored_sums(atlas, analysis)) return hierarchy_of(atlas.info(), analysis, *zones, tops);
    }
    const Volume whole = atlas.volume(context);
    Analysis zoned = zoned_analysis_of(store, whole, context);
    BranchHierarchy hierarchy = hierarchy_of(atlas.info(), zoned, sum_zones(whole, zoned), tops);
    AtlasAccess::keep(atlas, std::move(zoned));
    return hierarchy;
}

std::optional<ObjectTable> selected_entries(const Atlas& atlas, const ObjectTable& stored, const Selection& selection,
                                            const Context& context) {
    const std::optional<BranchHierarchy> hierarchy = stored_hierarchy(atlas, context);
    if (!hierarchy) return std::nullopt;
    std::set<EventId> known, kept;
    for (const ObjectEntry& entry : stored.entries) known.insert(entry.branch_top);
    for (const BranchId branch : hierarchy->kept(selection)) kept.insert(hierarchy->branches()[branch.index()].top);
    if (!std::ranges::includes(known, kept)) return std::nullopt;
    ObjectTable table{stored.entries, {}, stored.branches, stored.noise};
    std::vector<bool> keep;
    for (const ObjectEntry& entry : stored.entries) keep.push_back(kept.contains(entry.branch_top));
    keep_entries(table.entries, keep);
    std::ranges::copy_if(stored.isovalues, std::back_inserter(table.isovalues),
                         [&](const RecommendedIsovalue& isovalue) { return kept.contains(EventId(isovalue.branch_top)); });
    return table;
}

}  // namespace isoatlas

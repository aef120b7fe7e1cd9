#include "atlas/overview.h"

#include <array>
#include <string_view>

#include "atlas/access.h"
#include "atlas/object_arrays.h"
#include "atlas/tree_arrays.h"
#include "base/cancel.h"
#include "features/rank.h"
#include "field/volume_view.h"
#include "isoatlas/atlas.h"
#include "store/container.h"

namespace isoatlas {
namespace {

/// What an overview is read from, and the counts of the samples, which are shown beside it.
constexpr std::array<std::string_view, 7> kGroups{"objects", "isovalues", "dark", "dark_isovalues", "elements", "events", "census"};

/// Are both tables stored, and whole?
bool has_tables(const Container& store) {
    if (!has_objects(store) || !has_cavities(store)) return false;
    const ObjectTable objects = objects_of(store);
    return is_whole(objects) && knows_branches(objects) && is_whole(cavities_of(store));
}

}  // namespace

std::optional<ObjectTable> stored_objects(const Atlas& atlas, std::int64_t top, const Context& context) {
    constexpr std::array<std::string_view, 2> kTable{"objects", "isovalues"};
    const Container& store = AtlasAccess::store(atlas);
    store.fetch_groups(kTable);
    if (!has_objects(store)) return std::nullopt;
    return atlas.objects({.top = top}, context);  // which keeps the table for overview_of()
}

Overview overview_of(const Atlas& atlas, const Context& context) {
    AtlasAccess::store(atlas).fetch_groups(kGroups);
    if (has_tables(AtlasAccess::store(atlas)))
        return {atlas.objects({.top = 0}, context), atlas.cavities({.top = 0}, context), atlas.hierarchy(context)};
    const Volume whole = atlas.volume(context);
    Analysis zoned = zoned_analysis_of(AtlasAccess::store(atlas), whole, context);
    stop_if_cancelled(context);
    ObjectsAndCavities tables = rank_both(whole, zoned, {.top = 0}, context);
    stop_if_cancelled(context);
    BranchHierarchy hierarchy(whole, zoned, context);
    AtlasAccess::keep(atlas, std::move(zoned));
    return {std::move(tables.objects), std::move(tables.cavities), std::move(hierarchy)};
}

}  // namespace isoatlas

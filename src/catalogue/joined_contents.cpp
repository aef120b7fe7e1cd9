#include "catalogue/joined_contents.h"

#include <algorithm>
#include <map>

#include "base/cancel.h"
#include "catalogue/at_once.h"
#include "isoatlas/both_polarities.h"
#include "isoatlas/locate.h"

namespace isoatlas {
namespace {

/// Lines of a table up to the last one that the list has.
std::int64_t lines_needed(const std::vector<RankedObject>& list, Polarity polarity) {
    std::int64_t lines = 1;
    for (const RankedObject& object : list) {
        if (object.polarity == polarity) lines = std::max(lines, static_cast<std::int64_t>(object.entry) + 1);
    }
    return lines;
}

PageContents contents_of(const Atlas& atlas, const Overview& found, const PageOptions& options, const std::vector<RankedObject>& list,
                         const Context& context) {
    PageOptions own = options;
    own.top = lines_needed(list, polarity_of(atlas.info())), own.top_cavities = 0;
    if (polarity_of(atlas.info()) == Polarity::low) own.names = options.low_names;
    return page_contents(atlas, found, own, context);
}

std::vector<RankedObject> ranked(const StoreSides& sides, const Overview& high, const Overview& low, const PageOptions& options,
                                 const Context& context) {
    const auto holds = [&](const ObjectEntry& object, std::int64_t voxel) {
        stop_if_cancelled(context);
        const std::optional<std::int64_t> holder = Locator(*sides.low, voxel, context).object(object.best_tau);
        return holder && holder == Locator(*sides.low, object.id, context).object(object.best_tau);
    };
    const ObjectsAndCavities tables{high.objects, high.cavities};
    return rank_together(tables, low.objects, sides.main.info().extent, {.top = options.top, .holds = holds});
}

/// Their branches, those of low values behind the others.
void add_branches(PageContents& joined, std::vector<PageBranch> more) {
    const auto first = static_cast<std::int64_t>(joined.branches.size());
    for (PageBranch& branch : more) {
        if (branch.parent >= 0) branch.parent += first;
        joined.branches.push_back(std::move(branch));
    }
}

}  // namespace

PageContents joined_contents(const StoreSides& sides, const Overview& high, const Overview& low, const PageOptions& options,
                             const Context& context) {
    const std::vector<RankedObject> list = ranked(sides, high, low, options, context);
    PageContents joined, of_low;
    at_once(
        context, [&](const Context& own) { joined = contents_of(sides.main, high, options, list, own); },
        [&](const Context& own) { of_low = contents_of(*sides.low, low, options, list, own); });
    const auto behind = static_cast<std::int64_t>(joined.branches.size());
    const std::vector<PageEntry> of_high = std::move(joined.entries);
    joined.entries.clear();
    for (const RankedObject& object : list) {
        const bool is_low = object.polarity == Polarity::low;
        PageEntry entry = (is_low ? of_low.entries : of_high)[object.entry];
        if (is_low) entry.branch += behind;
        entry.inside = object.inside, entry.around = object.cavity_of;
        const ObjectTable& table = is_low ? low.objects : high.objects;
        entry.is_background = is_background(table, object.entry, sides.main.info().extent);
        entry.border = is_low ? border_text(table.entries[object.entry].border, sides.main.info().extent) : "";
        entry.is_enclosed = object.is_enclosed;
        joined.entries.push_back(std::move(entry));
    }
    joined.cavities = joined.significant_cavities = 0;
    add_branches(joined, std::move(of_low.branches));
    joined.low = PageSide{of_low.objects, of_low.significant_objects, of_low.noise, std::move(of_low.curve), std::move(of_low.spectrum)};
    return joined;
}

}  // namespace isoatlas

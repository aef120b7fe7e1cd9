#include "catalogue/longest_tunnels.h"

#include <unordered_map>

#include "atlas/access.h"
#include "catalogue/at_once.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMax = 12;  // of one object

/// Per event: the position of the branch that has entries.
std::unordered_map<EventId, std::size_t> branches_of_events(const PageContents& contents, const Analysis& analysis, Polarity polarity) {
    std::unordered_map<EventId, std::size_t> branch_of;
    for (std::size_t b = 0; b < contents.branches.size(); ++b) {
        const PageBranch& branch = contents.branches[b];
        if (branch.is_cavity || branch.polarity != polarity || branch.shape.empty()) continue;
        for (const EventId event : events_of(analysis, branch.top, branch.merges)) branch_of.emplace(event, b);
    }
    return branch_of;
}

/// Of one side of a store, whose objects have this noise.
FoundHandles handles_of(const Atlas& atlas, double noise, const Context& context) {
    const double min = noise_height(noise, atlas.info().extent.voxels());
    return find_handles(atlas.info(), AtlasAccess::analysis(atlas), min, [&] { return atlas.volume(context); }, context);
}

void add_found(PageContents& contents, const Atlas& atlas, const FoundHandles& found) {
    const std::unordered_map<EventId, std::size_t> branch_of =
        branches_of_events(contents, AtlasAccess::analysis(atlas), polarity_of(atlas.info()));
    for (const Handle& handle : found.handles) {  // by descending persistence
        const auto place = branch_of.find(handle.event);
        if (place == branch_of.end()) continue;
        PageBranch& branch = contents.branches[place->second];
        ++branch.significant_tunnels;
        if (branch.tunnels.size() < kMax) branch.tunnels.push_back({handle.opens, handle.closes});
    }
}

}  // namespace

PageTunnels find_tunnels(const PageContents& contents, const StoreSides& sides, const Context& context) {
    PageTunnels found;
    if (sides.main.info().extent.rank != 3) return found;
    at_once(
        context, [&](const Context& own) { found.main = handles_of(sides.main, contents.noise, own); },
        [&](const Context& own) {
            if (sides.has_both()) found.low = handles_of(*sides.low, contents.low->noise, own);
        });
    return found;
}

void add_tunnels(PageContents& contents, const StoreSides& sides, const PageTunnels& found) {
    if (!found.main) return;
    add_found(contents, sides.main, *found.main);
    contents.exact_tunnels = found.main->exact;
    if (!found.low) return;
    add_found(contents, *sides.low, *found.low);
    contents.exact_tunnels = found.main->exact && found.low->exact;
}

}  // namespace isoatlas

#include "catalogue/longest_tunnels.h"

#include <unordered_map>

#include "isoatlas/handles.h"

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

}  // namespace

void add_tunnels(PageContents& contents, const Atlas& atlas, const Context& context) {
    if (atlas.info().extent.rank != 3) return;
    Context silent = context;
    silent.progress = nullptr;
    const Analysis analysis = atlas.analysis();
    const Polarity polarity = polarity_of(atlas.info());
    const bool is_second = contents.low && polarity == Polarity::low;
    const double min = noise_height(is_second ? contents.low->noise : contents.noise, atlas.info().extent.voxels());
    const FoundHandles found = find_handles(atlas.info(), analysis, min, [&] { return atlas.volume(silent); }, silent);
    contents.exact_tunnels = found.exact && (!is_second || contents.exact_tunnels);
    const std::unordered_map<EventId, std::size_t> branch_of = branches_of_events(contents, analysis, polarity);
    for (const Handle& handle : found.handles) {  // by descending persistence
        const auto place = branch_of.find(handle.event);
        if (place == branch_of.end()) continue;
        PageBranch& branch = contents.branches[place->second];
        ++branch.significant_tunnels;
        if (branch.tunnels.size() < kMax) branch.tunnels.push_back({handle.opens, handle.closes});
    }
}

}  // namespace isoatlas

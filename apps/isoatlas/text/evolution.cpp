#include "text/evolution.h"

#include <algorithm>
#include <set>
#include <utility>

#include "data/source.h"

namespace isoatlas::cli {

Evolution::Evolution(const Arguments& arguments, Source& source) : Evolution(arguments, source, source.analysis_and_hierarchy()) {}

Evolution::Evolution(const Arguments& arguments, Source& source, std::pair<Analysis, BranchHierarchy> trees)
    : analysis_(std::move(trees.first)) {
    const BranchHierarchy& hierarchy = trees.second;
    if (source.is_store()) {
        index_ = &source.atlas().active_index();
    } else {
        made_.emplace(analysis_);
        index_ = &*made_;
    }
    RankOptions options{.top = 0};
    if (arguments.selects) options.selection = source.selection();
    mark_kept(hierarchy, options.selection ? hierarchy.kept(*options.selection) : hierarchy.significant());

    double min = options.selection ? options.selection->min_persistence : 0;
    if (min == 0) min = noise_height(source.objects({.top = 1}).noise, source.info().extent.voxels());
    const FoundHandles found = find_handles(source.info(), analysis_, min, [&] { return source.volume(); }, source.context());
    exact_tunnels_ = found.exact;
    for (const Handle& handle : found.handles) {
        if (rank_of_event_[handle.event.index()] >= 0) tunnels_.push_back({handle.opens, handle.closes});
    }
    std::set<std::array<double, 3>> known;  // several lines may show the same cavity
    for (const CavityEntry& cavities : source.cavities(options).entries) {
        if (known.insert(cavities.position).second) cavities_.push_back({cavities.merges, cavities.appears});
    }
}

void Evolution::mark_kept(const BranchHierarchy& hierarchy, const std::vector<BranchId>& kept) {
    rank_of_event_.assign(static_cast<std::size_t>(analysis_.event_count()), -1);
    for (const BranchId id : kept) {
        const BranchInfo& branch = hierarchy.branches()[id.index()];
        objects_.push_back({branch.appears, branch.merges});
        for (const EventId event : events_of(analysis_, branch.top, branch.merges)) rank_of_event_[event.index()] = id.number();
    }
}

Census Evolution::kept_at(double tau, const std::optional<double>& before) const {
    const auto count = [&](const std::vector<Life>& lives) {
        return std::ranges::count_if(lives, [&](const Life& life) { return life.holds(tau); });
    };
    Census census{.objects = count(objects_), .tunnels = count(tunnels_), .cavities = count(cavities_)};
    if (!before) return census;
    const auto [low, high] = std::minmax({tau, *before});
    for (const Life& life : objects_) {
        census.appeared += low <= life.begins && life.begins < high;
        census.merged += low <= life.ends && life.ends < high;
    }
    return census;
}

Frame Evolution::at(double tau, const std::optional<double>& before) const {
    Frame frame{.tau = tau, .events = 0, .all = {}, .kept = kept_at(tau, before)};
    for (const ActiveObject& object : index_->at(tau, {.contours = false}).objects) {
        ++frame.all.objects;
        frame.all.tunnels += object.b1, frame.all.cavities += object.b2;
    }
    if (!before) return frame;
    const ObjectChanges changes = index_->changes(*before, tau);
    frame.all.appeared = changes.appeared, frame.all.merged = changes.merged, frame.events = changes.events;
    return frame;
}

std::map<std::int64_t, std::int64_t> Evolution::kept_objects(double tau) const {
    std::map<std::int64_t, std::int64_t> ranks;
    for (const ActiveObject& object : index_->at(tau, {.contours = false}).objects) {
        const std::int64_t rank = rank_of_event_[object.event.index()];
        if (rank >= 0) ranks.emplace(object.id, rank);
    }
    return ranks;
}

}  // namespace isoatlas::cli

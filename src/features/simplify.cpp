// Accessors of include/isoatlas/simplify.h.
#include "isoatlas/simplify.h"

#include <algorithm>
#include <limits>

#include "analysis/event_alone.h"
#include "analysis/object_tree.h"
#include "base/paced_fill.h"
#include "features/hierarchy.h"
#include "features/noise.h"
#include "features/select_branches.h"
#include "field/order.h"
#include "isoatlas/environment.h"

namespace isoatlas {

namespace {

using Data = BranchHierarchy::Data;

/// zone: of every voxel; of uniform grids it may be empty.
template <class Id>
void gather(const VolumeInfo& info, const AnalysisArrays<Id>& arrays, const ZoneSums& zones, Data& data) {
    data.parent = IdArray<EventId, EventId>(arrays.tree.size());
    for (const EventId e : data.parent.ids()) data.parent[e] = EventId(arrays.tree.parent[e]);
    data.voxels.items().assign(arrays.voxels.items().begin(), arrays.voxels.items().end());
    const ObjectTree<Id> tree = superlevel_tree<Id>(arrays, data.value.items());
    data.branches = decompose_branches(tree, zones);
    data.measure = branch_measures(tree, data.branches, info);
    for (const BranchId i : data.branches.branch.ids()) {
        const Branch& b = data.branches.branch[i];
        const std::int64_t id = ElementCode{arrays.code[arrays.tree.top[b.highest]]}.index();
        data.info.push_back({id, b.top, b.parent, b.appears, b.merges, b.persistence, b.hypervolume, b.voxels, data.measure[i]});
    }
}

/// The events that become nodes: where kept branches begin, and where they end.
std::vector<bool> node_events(const Data& data, const std::vector<BranchId>& kept) {
    std::vector<bool> is_node(data.parent.size(), false);
    for (const BranchId i : kept) {
        const Branch& b = data.branches.branch[i];
        is_node[b.top.index()] = true;
        if (b.parent.exists()) is_node[data.parent[b.bottom].index()] = true;
    }
    return is_node;
}

/// The event of the node that its zone joins. On a kept branch that is the next node above; another branch goes by what it ends in.
IdArray<EventId, EventId> node_events_of(const Data& data, const std::vector<BranchId>& kept, const std::vector<bool>& is_node) {
    IdArray<EventId, EventId> node(filled(data.parent.size(), EventId::none()));
    for (const BranchId i : kept) {
        const Branch& b = data.branches.branch[i];
        EventId last = b.top;
        for (EventId e = b.top;; e = data.parent[e]) {
            node[e] = last = is_node[e.index()] ? e : last;
            if (e == b.bottom) break;
        }
    }
    for (EventId e(data.parent.size() - 1); e.exists(); e = e.previous()) {
        if (!node[e].exists()) node[e] = node[data.parent[e]];
    }
    return node;
}

/// What lies in branches that are not kept.
void add_hidden(const Data& data, const std::vector<bool>& is_kept, Simplified& result) {
    for (const EventId e : data.voxels.ids()) {
        if (!is_kept[data.branches.of_event[e].index()]) result.hidden_voxels += data.voxels[e];
    }
    for (std::size_t i = 0; i < is_kept.size(); ++i) {
        if (!is_kept[i]) result.hidden_hypervolume = std::max(result.hidden_hypervolume, data.info[i].hypervolume);
    }
}

SelectionCurve curve_of(const Data& data, const std::string& size, const auto& size_of) {
    SelectionCurve curve{size, {}, {}, 0, static_cast<std::int64_t>(data.significant.size())};
    std::vector<double> sizes;
    for (const BranchInfo& b : data.info) sizes.push_back(size_of(b));
    std::ranges::sort(sizes, std::greater<>());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (i + 1 < sizes.size() && sizes[i + 1] == sizes[i]) continue;
        curve.threshold.push_back(sizes[i]);
        curve.kept.push_back(static_cast<std::int64_t>(i) + 1);
    }
    curve.automatic_threshold = std::numeric_limits<double>::infinity();
    for (const BranchId i : data.significant)
        curve.automatic_threshold = std::min(curve.automatic_threshold, size_of(data.info[i.index()]));
    return curve;
}

}  // namespace

ZoneSums sum_zones(const VolumeView& volume, const Analysis& analysis) {
    return analysis.data().visit([&](const auto& held) {
        const BigVector<double> values = event_values(held.arrays);
        return sum_zones(superlevel_tree(held.arrays, std::span<const double>(values)), volume);
    });
}

BranchHierarchy hierarchy_of(const VolumeInfo& info, const Analysis& analysis, const ZoneSums& zones, std::span<const EventId> tops) {
    auto data = std::make_unique<Data>();
    analysis.data().visit([&](const auto& held) {
        data->value = IdArray<EventId, double>(event_values(held.arrays));
        gather(info, held.arrays, zones, *data);
    });
    for (const BranchId i : ids<BranchId>(data->info.size())) {
        if (std::ranges::binary_search(tops, data->info[i.index()].top)) data->significant.push_back(i);
    }
    return BranchHierarchy(std::move(data));
}

std::vector<EventId> events_of(const Analysis& analysis, EventId top, double merges) {
    std::vector<EventId> events;
    for (EventId id = top; id.exists();) {
        const Event event = event_alone(analysis.data(), id);
        if (!(event.value > merges)) break;
        events.push_back(id);
        id = event.parent;
    }
    return events;
}

BranchHierarchy::BranchHierarchy(const Volume& volume, const Analysis& analysis, const Context& context) : data_(std::make_unique<Data>()) {
    const EnvironmentScope scope(context);
    if (volume.info.extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
    analysis.data().visit([&](const auto& held) {
        if (held.arrays.zone.empty()) throw Error(ErrorKind::usage, {.what = "simplifying needs an analysis with zones"});
        data_->value = IdArray<EventId, double>(event_values(held.arrays));
        gather(volume.info, held.arrays, sum_zones(VolumeView(volume), analysis), *data_);
    });
    data_->significant = significant_branches(data_->branches, volume.info.extent.voxels(), fit_noise(VolumeView(volume)), 1);
}
BranchHierarchy::BranchHierarchy(std::unique_ptr<Data> data) : data_(std::move(data)) {}
BranchHierarchy::BranchHierarchy(BranchHierarchy&&) noexcept = default;
BranchHierarchy& BranchHierarchy::operator=(BranchHierarchy&&) noexcept = default;
BranchHierarchy::~BranchHierarchy() = default;

std::span<const BranchInfo> BranchHierarchy::branches() const { return data_->info; }
const std::vector<BranchId>& BranchHierarchy::significant() const { return data_->significant; }

std::vector<BranchId> BranchHierarchy::kept(const Selection& selection) const {
    return select_branches(data_->branches, data_->measure, selection);
}

Simplified BranchHierarchy::simplify(const Selection& selection) const { return simplify(kept(selection)); }

Simplified BranchHierarchy::simplify(std::vector<BranchId> kept) const {
    const std::vector<bool> is_node = node_events(*data_, kept);
    const IdArray<EventId, EventId> node_event = node_events_of(*data_, kept, is_node);
    Simplified result;
    std::vector<std::int64_t>& number = result.node_of_event;  // first of the events that are nodes
    number.assign(is_node.size(), -1);
    for (const EventId e : node_event.ids()) {
        if (!is_node[e.index()]) continue;
        number[e.index()] = static_cast<std::int64_t>(result.nodes.size());
        const BranchId branch = data_->branches.of_event[e];
        const bool is_maximum = data_->branches.branch[branch].top == e;
        result.nodes.push_back({e, branch, -1, is_maximum, 0, data_->value[e], 0, 0});
    }
    for (const EventId e : node_event.ids()) {
        number[e.index()] = number[node_event[e].index()];
        result.nodes[number[e.index()]].voxels += data_->voxels[e];
    }
    for (SimplifiedNode& node : result.nodes) {
        EventId below = node.event;
        while (!data_->is_root(below) && (below == node.event || !is_node[below.index()])) below = data_->parent[below];
        const bool is_last = below == node.event || !is_node[below.index()];
        node.parent = is_last ? -1 : number[below.index()];
        node.tau_low = is_last ? -std::numeric_limits<double>::infinity() : data_->value[below];
        node.object_voxels += node.voxels;
        if (!is_last) result.nodes[node.parent].object_voxels += node.object_voxels;
    }
    std::vector<bool> is_kept(data_->info.size(), false);
    for (const BranchId i : kept) is_kept[i.index()] = true;
    add_hidden(*data_, is_kept, result);
    result.hidden = static_cast<std::int64_t>(data_->info.size() - kept.size());
    result.kept = std::move(kept);
    return result;
}

std::vector<SelectionCurve> BranchHierarchy::curves() const {
    return {curve_of(*data_, "hypervolume", [](const BranchInfo& b) { return b.hypervolume; }),
            curve_of(*data_, "persistence", [](const BranchInfo& b) { return b.persistence; }),
            curve_of(*data_, "voxels", [](const BranchInfo& b) { return static_cast<double>(b.voxels); })};
}

}  // namespace isoatlas

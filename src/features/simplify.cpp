// Accessors of include/isoatlas/simplify.h.
#include "isoatlas/simplify.h"

#include <algorithm>
#include <limits>

#include "analysis/object_tree.h"
#include "features/hierarchy.h"
#include "features/noise.h"
#include "features/select_branches.h"
#include "field/order.h"

namespace isoatlas {

namespace {

using Data = BranchHierarchy::Data;

/// zone: of every voxel; of uniform grids it may be empty.
template <class Id>
void gather(const VolumeInfo& info, const AnalysisArrays<Id>& arrays, const ZoneSums& zones, Data& data) {
    data.parent.assign(arrays.tree.parent.begin(), arrays.tree.parent.end());
    data.voxels.assign(arrays.voxels.begin(), arrays.voxels.end());
    const ObjectTree<Id> tree = superlevel_tree<Id>(arrays, data.value);
    data.branches = decompose_branches(tree, zones);
    data.measure = branch_measures(tree, data.branches, info);
    for (std::size_t i = 0; i < data.branches.branch.size(); ++i) {
        const Branch& b = data.branches.branch[i];
        const std::int64_t id = ElementCode{arrays.code[arrays.tree.top[b.highest]]}.index();
        data.info.push_back({id, b.top, b.parent, b.appears, b.merges, b.persistence, b.hypervolume, b.voxels, data.measure[i]});
    }
}

/// The events that become nodes: where kept branches begin, and where they end.
std::vector<bool> node_events(const Data& data, const std::vector<std::int64_t>& kept) {
    std::vector<bool> is_node(data.parent.size(), false);
    for (const std::int64_t i : kept) {
        const Branch& b = data.branches.branch[i];
        is_node[b.top] = true;
        if (b.parent >= 0) is_node[data.parent[b.bottom]] = true;
    }
    return is_node;
}

/// Per event: the one of the node that its zone joins. On a kept branch that is the next node above; another branch goes by what it ends
/// in.
std::vector<std::int64_t> node_of_events(const Data& data, const std::vector<std::int64_t>& kept, const std::vector<bool>& is_node) {
    std::vector<std::int64_t> node(data.parent.size(), -1);
    for (const std::int64_t i : kept) {
        const Branch& b = data.branches.branch[i];
        std::int64_t last = b.top;
        for (std::int64_t e = b.top;; e = data.parent[e]) {
            node[e] = last = is_node[e] ? e : last;
            if (e == b.bottom) break;
        }
    }
    for (std::size_t e = node.size(); e-- > 0;) {
        if (node[e] < 0) node[e] = node[data.parent[e]];
    }
    return node;
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
    for (const std::int64_t i : data.significant) curve.automatic_threshold = std::min(curve.automatic_threshold, size_of(data.info[i]));
    return curve;
}

}  // namespace

ZoneSums sum_zones(const VolumeView& volume, const Analysis& analysis) {
    return analysis.data().visit([&](const auto& held) {
        const BigVector<double> values = event_values(held.arrays);
        return sum_zones(superlevel_tree(held.arrays, std::span<const double>(values)), volume);
    });
}

BranchHierarchy hierarchy_of(const VolumeInfo& info, const Analysis& analysis, const ZoneSums& zones, std::span<const std::int64_t> tops) {
    auto data = std::make_unique<Data>();
    analysis.data().visit([&](const auto& held) {
        data->value = event_values(held.arrays);
        gather(info, held.arrays, zones, *data);
    });
    for (std::size_t i = 0; i < data->info.size(); ++i) {
        if (std::ranges::binary_search(tops, data->info[i].top)) data->significant.push_back(static_cast<std::int64_t>(i));
    }
    return BranchHierarchy(std::move(data));
}

std::vector<std::int64_t> events_of(const Analysis& analysis, std::int64_t top, double merges) {
    std::vector<std::int64_t> events;
    for (std::int64_t id = top; id >= 0;) {
        const Event event = analysis.event(id);
        if (!(event.value > merges)) break;
        events.push_back(id);
        id = event.parent;
    }
    return events;
}

BranchHierarchy::BranchHierarchy(const Volume& volume, const Analysis& analysis, const Context&) : data_(std::make_unique<Data>()) {
    if (volume.info.extent != analysis.extent())
        throw Error(ErrorKind::usage, {.what = "the analysis is of another volume: the extents differ"});
    analysis.data().visit([&](const auto& held) {
        if (held.arrays.zone.empty()) throw Error(ErrorKind::usage, {.what = "simplifying needs an analysis with zones"});
        data_->value = event_values(held.arrays);
        gather(volume.info, held.arrays, sum_zones(VolumeView(volume), analysis), *data_);
    });
    data_->significant = significant_branches(data_->branches, volume.info.extent.voxels(), fit_noise(VolumeView(volume)), 1);
}
BranchHierarchy::BranchHierarchy(std::unique_ptr<Data> data) : data_(std::move(data)) {}
BranchHierarchy::BranchHierarchy(BranchHierarchy&&) noexcept = default;
BranchHierarchy& BranchHierarchy::operator=(BranchHierarchy&&) noexcept = default;
BranchHierarchy::~BranchHierarchy() = default;

std::span<const BranchInfo> BranchHierarchy::branches() const { return data_->info; }
const std::vector<std::int64_t>& BranchHierarchy::significant() const { return data_->significant; }

std::vector<std::int64_t> BranchHierarchy::kept(const Selection& selection) const {
    return select_branches(data_->branches, data_->measure, selection);
}

Simplified BranchHierarchy::simplify(const Selection& selection) const { return simplify(kept(selection)); }

Simplified BranchHierarchy::simplify(std::vector<std::int64_t> kept) const {
    const std::vector<bool> is_node = node_events(*data_, kept);
    Simplified result;
    result.node_of_event = node_of_events(*data_, kept, is_node);
    std::vector<std::int64_t> number(is_node.size(), -1);
    for (std::size_t e = 0; e < is_node.size(); ++e) {
        if (!is_node[e]) continue;
        number[e] = static_cast<std::int64_t>(result.nodes.size());
        const std::int64_t branch = data_->branches.of_event[e];
        const bool is_maximum = data_->branches.branch[branch].top == static_cast<std::int64_t>(e);
        result.nodes.push_back({static_cast<std::int64_t>(e), branch, -1, is_maximum, 0, data_->value[e], 0, 0});
    }
    std::vector<bool> is_kept(data_->info.size(), false);
    for (const std::int64_t i : kept) is_kept[i] = true;
    for (std::size_t e = 0; e < is_node.size(); ++e) {
        std::int64_t& node = result.node_of_event[e];
        node = number[node];
        result.nodes[node].voxels += data_->voxels[e];
        if (!is_kept[data_->branches.of_event[e]]) result.hidden_voxels += data_->voxels[e];
    }
    for (std::size_t i = 0; i < result.nodes.size(); ++i) {
        SimplifiedNode& node = result.nodes[i];
        std::int64_t below = node.event;
        while (!data_->is_root(below) && (below == node.event || !is_node[below])) below = data_->parent[below];
        const bool is_last = below == node.event || !is_node[below];
        node.parent = is_last ? -1 : number[below];
        node.tau_low = is_last ? -std::numeric_limits<double>::infinity() : data_->value[below];
        node.object_voxels += node.voxels;
        if (!is_last) result.nodes[node.parent].object_voxels += node.object_voxels;
    }
    for (std::size_t i = 0; i < is_kept.size(); ++i) {
        if (!is_kept[i]) result.hidden_hypervolume = std::max(result.hidden_hypervolume, data_->info[i].hypervolume);
    }
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

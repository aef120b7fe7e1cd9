// The simplified tree is what is left when small objects are taken away one after the other, as the dissertation's figure 13.2 does it.
#include "isoatlas/simplify.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <random>
#include <set>

#include "isoatlas/objects.h"
#include "isoatlas/phantom.h"
#include "oracle/difference.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::BranchHierarchy;
using isoatlas::BranchId;
using isoatlas::BranchInfo;
using isoatlas::EventId;
using isoatlas::Selection;
using isoatlas::Simplified;
using isoatlas::SimplifiedNode;
using isoatlas::Volume;
using isoatlas::VoxelId;

/// A path of events from a leaf down to where it was pruned, and the sizes of the object at its low end.
struct Arm {
    std::vector<EventId> events;        ///< from above
    EventId ends_in = EventId::none();  ///< none: the main branch
    double hypervolume = 0, persistence = 0;
    Index voxels = 0;
};

/// The object of an event at its low end: every voxel in its zone or in one above it.
Arm sizes_of(const Analysis& analysis, const Grid& grid, EventId event, double base) {
    Arm arm;
    double sum = 0, highest = -kInfinity;
    for (Index v = 0; v < grid.voxels(); ++v) {
        EventId e = analysis.zone(VoxelId(v));
        while (e.exists() && e != event) e = analysis.event(e).parent;
        if (e != event) continue;
        ++arm.voxels;
        sum += grid.value[v], highest = std::max(highest, grid.value[v]);
    }
    arm.hypervolume = sum - static_cast<double>(arm.voxels) * base;
    arm.persistence = highest - base;
    return arm;
}

/// Takes the smallest arm away until one is left; arms in the order in which they went.
std::vector<Arm> prune(const Analysis& analysis, const Grid& grid) {
    std::vector<std::set<EventId>> children(static_cast<std::size_t>(analysis.event_count()));
    for (const EventId e : isoatlas::ids<EventId>(analysis.event_count())) {
        if (analysis.event(e).parent.exists()) children[analysis.event(e).parent.index()].insert(e);
    }
    std::vector<EventId> leaves;
    for (const EventId e : isoatlas::ids<EventId>(analysis.event_count())) {
        if (children[e.index()].empty()) leaves.push_back(e);
    }
    const double lowest = *std::min_element(grid.value.begin(), grid.value.end());
    std::vector<Arm> pruned;
    while (!leaves.empty()) {
        Arm smallest;
        EventId leaf_of_smallest = EventId::none();
        for (const EventId leaf : leaves) {
            std::vector<EventId> events{leaf};
            EventId below = analysis.event(leaf).parent;
            while (below.exists() && children[below.index()].size() == 1) events.push_back(below), below = analysis.event(below).parent;
            Arm arm = sizes_of(analysis, grid, events.back(), below.exists() ? analysis.event(below).value : lowest);
            arm.events = events, arm.ends_in = below;
            const auto key = [](const Arm& a) {
                return std::pair(a.hypervolume, -a.events.back().number());
            };  // equal: the lower event goes first
            if (!leaf_of_smallest.exists() || key(arm) < key(smallest)) smallest = arm, leaf_of_smallest = leaf;
        }
        if (smallest.ends_in.exists()) children[smallest.ends_in.index()].erase(smallest.events.back());
        leaves.erase(std::find(leaves.begin(), leaves.end(), leaf_of_smallest));
        pruned.push_back(smallest);
    }
    return pruned;
}

bool is_kept(const Arm& arm, const Selection& selection) {
    return !arm.ends_in.exists() || (arm.hypervolume >= selection.min_hypervolume && arm.persistence >= selection.min_persistence &&
                                     static_cast<double>(arm.voxels) >= selection.min_voxels);
}

/// The event of the node whose zone the zone of an event joins.
EventId joined(const std::vector<Arm>& arms, const Selection& selection, const std::set<EventId>& nodes, EventId event) {
    for (;;) {
        const Arm* of = nullptr;
        for (const Arm& arm : arms) {
            if (std::count(arm.events.begin(), arm.events.end(), event) > 0) of = &arm;
        }
        if (!is_kept(*of, selection)) {
            event = of->ends_in;
            continue;
        }
        auto at = std::find(of->events.begin(), of->events.end(), event);
        while (nodes.count(*at) == 0) --at;  // the top of a kept arm is a node
        return *at;
    }
}

/// Whole numbers, so that sums are exact; also the values of face points may differ in the last digit otherwise.
Grid arbitrary_whole_grid(Index longest, Index max) {
    Grid grid = *arbitrary_grid(longest, max);
    for (double& v : grid.value) v = std::floor(v);
    return grid;
}

void simplification_is_pruning_one_by_one() {
    const Grid grid = arbitrary_whole_grid(5, 80);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid);
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const BranchHierarchy hierarchy(volume, analysis);
    const std::vector<Arm> arms = prune(analysis, grid);
    RC_ASSERT(arms.size() == hierarchy.branches().size());
    Selection selection;
    const BranchInfo& some = hierarchy.branches()[*rc::gen::inRange<std::size_t>(0, arms.size())];
    const int kind = *rc::gen::inRange(0, 4);
    if (kind == 0) selection.min_hypervolume = some.hypervolume;
    if (kind == 1) selection.min_persistence = some.persistence;
    if (kind == 2) selection.min_voxels = static_cast<double>(some.voxels);
    const Simplified simplified = hierarchy.simplify(selection);

    std::set<EventId> nodes, tops;
    for (const Arm& arm : arms) {
        if (!is_kept(arm, selection)) continue;
        tops.insert(arm.events.front());
        nodes.insert(arm.events.front());
        if (arm.ends_in.exists()) nodes.insert(arm.ends_in);
    }
    RC_ASSERT(simplified.kept.size() == tops.size());
    RC_ASSERT(simplified.hidden == static_cast<Index>(arms.size() - tops.size()));
    for (const BranchId i : simplified.kept) RC_ASSERT(tops.count(hierarchy.branches()[i.index()].top) == 1);
    RC_ASSERT(simplified.nodes.size() == nodes.size());
    std::map<EventId, Index> voxels;
    for (const EventId e : isoatlas::ids<EventId>(analysis.event_count())) {
        const EventId node = simplified.nodes[simplified.node_of_event[e.index()]].event;
        RC_ASSERT(node == joined(arms, selection, nodes, e));
        voxels[node] += analysis.event(e).zone.voxels;
    }
    Index total = 0;
    for (const SimplifiedNode& node : simplified.nodes) {
        RC_ASSERT(nodes.count(node.event) == 1);
        RC_ASSERT(node.is_maximum == (tops.count(node.event) == 1));
        RC_ASSERT(node.tau_low < node.tau_high);
        RC_ASSERT(node.voxels == voxels[node.event]);
        total += node.voxels;
    }
    RC_ASSERT(total == grid.voxels());
    RC_ASSERT(simplified.nodes.back().parent == -1);
    RC_ASSERT(simplified.nodes.back().object_voxels == grid.voxels());
}

// A node's parent is the first kept event on the way down, and its object is what the full tree says just above that.
void simplification_keeps_objects_as_they_are() {
    const Grid grid = *arbitrary_grid(7, 200);
    const Volume volume = to_volume(grid);
    const Analysis analysis = isoatlas::analyse(volume);
    const BranchHierarchy hierarchy(volume, analysis);
    const auto count = static_cast<Index>(hierarchy.branches().size());
    const Index keep = *rc::gen::inRange<Index>(0, count + 2);
    const Simplified simplified = hierarchy.simplify(Selection{.keep = keep});
    RC_ASSERT(static_cast<Index>(simplified.kept.size()) <= std::max<Index>(1, keep));
    for (const SimplifiedNode& node : simplified.nodes) {
        EventId below = node.event, last = node.event;
        do {
            last = below;
            below = analysis.event(below).parent;
        } while (below.exists() &&
                 std::none_of(simplified.nodes.begin(), simplified.nodes.end(), [&](const auto& n) { return n.event == below; }));
        RC_ASSERT(!below.exists() == (node.parent < 0));
        if (below.exists()) RC_ASSERT(simplified.nodes[node.parent].event == below);
        RC_ASSERT(node.tau_high == analysis.event(node.event).value);
        RC_ASSERT(node.tau_low == (below.exists() ? analysis.event(below).value : -kInfinity));
        RC_ASSERT(node.object_voxels == analysis.event(last).object_voxels);
    }
    const Simplified all = hierarchy.simplify(Selection{});
    RC_ASSERT(static_cast<Index>(all.kept.size()) == count);
    RC_ASSERT(all.hidden == 0);
    RC_ASSERT(all.hidden_voxels == 0);
}

void simplification_curves_count_what_is_kept() {
    const Grid grid = arbitrary_whole_grid(7, 200);
    const Volume volume = to_volume(grid);
    const Analysis analysis = isoatlas::analyse(volume);
    const BranchHierarchy hierarchy(volume, analysis);
    for (const isoatlas::SelectionCurve& curve : hierarchy.curves()) {
        RC_ASSERT(std::is_sorted(curve.threshold.rbegin(), curve.threshold.rend()));
        RC_ASSERT(curve.kept.back() == static_cast<Index>(hierarchy.branches().size()));
        RC_ASSERT(curve.automatic_kept == static_cast<Index>(hierarchy.significant().size()));
        const auto i = *rc::gen::inRange<std::size_t>(0, curve.threshold.size());
        Selection selection;
        if (curve.size == "hypervolume") selection.min_hypervolume = curve.threshold[i];
        if (curve.size == "persistence") selection.min_persistence = curve.threshold[i];
        if (curve.size == "voxels") selection.min_voxels = curve.threshold[i];
        RC_ASSERT(static_cast<Index>(hierarchy.kept(selection).size()) == curve.kept[i]);
    }
}

// The table with a selection lists the branches that the selection keeps.
void simplification_is_what_the_table_of_objects_lists() {
    const Grid grid = *arbitrary_grid(7, 200);
    Volume volume = to_volume(grid);
    volume.info.geometry = arbitrary_geometry(grid);
    const Analysis analysis = isoatlas::analyse(volume);
    const BranchHierarchy hierarchy(volume, analysis);
    const BranchInfo& some = hierarchy.branches()[*rc::gen::inRange<std::size_t>(0, hierarchy.branches().size())];
    Selection selection;
    if (*rc::gen::arbitrary<bool>()) selection.min_measure = some.measure;
    if (*rc::gen::arbitrary<bool>()) selection.top_percent = *rc::gen::inRange(0, 101);
    std::set<EventId> listed, kept;
    for (const auto& entry : isoatlas::rank_objects(volume, analysis, {.top = 0, .selection = selection}).entries)
        listed.insert(entry.branch_top);
    for (const BranchId i : hierarchy.kept(selection)) kept.insert(hierarchy.branches()[i.index()].top);
    RC_ASSERT(listed == kept);
    for (const BranchId i : hierarchy.kept(selection))
        RC_ASSERT(i == BranchId(0) || hierarchy.branches()[i.index()].measure >= selection.min_measure);
}

/// Voxels of the object of a branch just before it merges.
std::set<Index> voxels_of(const Analysis& analysis, const BranchInfo& branch) {
    EventId bottom = branch.top;
    while (analysis.event(bottom).parent.exists() && analysis.event(analysis.event(bottom).parent).value > branch.merges)
        bottom = analysis.event(bottom).parent;
    std::vector<bool> inside(static_cast<std::size_t>(analysis.event_count()), false);
    for (EventId e(analysis.event_count() - 1); e.exists(); e = e.previous()) {
        const EventId parent = analysis.event(e).parent;
        inside[e.index()] = e == bottom || (parent.exists() && inside[parent.index()]);
    }
    std::set<Index> voxels;
    for (Index v = 0; v < analysis.extent().voxels(); ++v) {
        if (inside[analysis.zone(VoxelId(v)).index()]) voxels.insert(v);
    }
    return voxels;
}

constexpr double kNear = 1.1;  ///< a factor of the threshold: what is that near to it may change sides
constexpr double kAlike = 2;   ///< of the hypervolume of one object: the value at which it merges moves with the noise

struct Object {
    std::set<Index> voxels;
    double hypervolume;

    /// In the same place and of about the same size: most voxels of the smaller one are shared. Just above the value at which an object
    /// merges, noise decides what belongs to it.
    [[nodiscard]] bool is_like(const Object& other) const {
        const auto shared = std::ranges::count_if(voxels, [&](Index v) { return other.voxels.contains(v); });
        const double ratio = hypervolume / other.hypervolume;
        return 2 * static_cast<std::size_t>(shared) > std::min(voxels.size(), other.voxels.size()) && ratio < kAlike && ratio > 1 / kAlike;
    }
};

struct Bright {
    explicit Bright(const Volume& volume) : trees(isoatlas::analyse(volume)), hierarchy(volume, trees) {}
    Analysis trees;
    BranchHierarchy hierarchy;

    /// Of at least that hypervolume, without the main branch: the whole volume.
    [[nodiscard]] std::vector<Object> objects(double min) const {
        std::vector<Object> all;
        for (const BranchId i : hierarchy.kept({.min_hypervolume = min})) {
            const BranchInfo& branch = hierarchy.branches()[i.index()];
            if (i > BranchId(0)) all.push_back({voxels_of(trees, branch), branch.hypervolume});
        }
        return all;
    }
};

/// Every object of at least kNear thresholds is one of at least the threshold in the other volume too. Returns how many.
int expect_found(const Bright& from, const Bright& other, double threshold) {
    const std::vector<Object> wanted = from.objects(kNear * threshold), there = other.objects(threshold);
    for (const Object& object : wanted) {
        EXPECT_TRUE(std::ranges::any_of(there, [&](const Object& candidate) { return object.is_like(candidate); }))
            << object.voxels.size() << " voxels, hypervolume " << object.hypervolume;
    }
    return static_cast<int>(wanted.size());
}

// Objects far from the threshold are the same with and without 1 % noise.
TEST(Simplification, ChangesOnlyNearTheThresholdUnderNoise) {
    const Bright clean(isoatlas::make_phantom("random-field", {.size = 32, .seed = 3}));
    const Bright noisy(isoatlas::make_phantom("random-field", {.size = 32, .seed = 3, .noise = 0.01}));
    const double threshold = clean.hierarchy.branches()[8].hypervolume;
    EXPECT_GE(expect_found(clean, noisy, threshold), 3);
    EXPECT_GE(expect_found(noisy, clean, threshold), 3);
    EXPECT_GT(noisy.hierarchy.branches().size(), clean.hierarchy.branches().size());
}

/// Uniform noise of +- 1 % of the range, added to the samples in float32.
Volume with_noise(const Volume& volume, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> noisy;
    isoatlas::visit_samples(volume, [&](auto samples) {
        const auto [min, max] = std::ranges::minmax(samples);
        const double step = 0.01 * (static_cast<double>(max) - static_cast<double>(min)) / 0x1p31;
        for (const auto sample : samples)
            noisy.push_back(static_cast<float>(static_cast<double>(sample) + step * (static_cast<double>(random()) - 0x1p31)));
    });
    return isoatlas::make_volume(volume.info.extent, std::span<const float>(noisy), volume.info.geometry);
}

// The same of real volumes, at the automatic threshold.
TEST(Simplification, ChangesOnlyNearTheThresholdOnRealVolumes) {
    const std::filesystem::path data = std::filesystem::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no shared data beside the checkout";
    for (const char* name : {"fuel/fuel.nrrd", "neghip/neghip.nrrd"}) {
        SCOPED_TRACE(name);
        const Volume volume = isoatlas::load_volume((data / name).string());
        const Bright clean(volume);
        const double threshold = clean.hierarchy.curves()[0].automatic_threshold;
        const auto significant = static_cast<double>(clean.hierarchy.significant().size());
        for (const std::uint32_t seed : {7U, 8U, 9U}) {
            const Bright noisy(with_noise(volume, seed));
            EXPECT_GE(expect_found(clean, noisy, threshold), 1);
            EXPECT_GE(expect_found(noisy, clean, threshold), 1);
            EXPECT_NEAR(significant, static_cast<double>(noisy.hierarchy.significant().size()), 1);
        }
    }
}

RC_GTEST_PROP(Simplification, IsPruningOneByOne, ()) { simplification_is_pruning_one_by_one(); }
RC_GTEST_PROP(Simplification, KeepsObjectsAsTheyAre, ()) { simplification_keeps_objects_as_they_are(); }
RC_GTEST_PROP(Simplification, CurvesCountWhatIsKept, ()) { simplification_curves_count_what_is_kept(); }
RC_GTEST_PROP(Simplification, IsWhatTheTableOfObjectsLists, ()) { simplification_is_what_the_table_of_objects_lists(); }

}  // namespace
}  // namespace oracle

#include "server/branch_answers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "atlas/access.h"
#include "base/cancel.h"
#include "page/page_json.h"
#include "server/document.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kDefaultListed = 1000, kMaxBranchesListed = 20'000;
/// An isovalue slightly above that of the merge: the branch has nearly all its voxels, and rounding cannot reach the merge.
constexpr double kShareAboveMerge = 1.0 / 64;

/// The selection options of `isoatlas objects` as query parameters, in units of the file.
Selection selection_of(QueryParameters& words, const Calibration& scale) {
    const double slope = std::abs(scale.slope);
    Selection selection;
    selection.keep = words.whole("keep", 1, std::int64_t{1} << 40);
    selection.min_voxels = words.number("min-voxels", 0).value_or(0);
    selection.min_measure = words.number("min-volume", 0).value_or(0);
    selection.min_persistence = words.number("persistence", 0).value_or(0) / slope;
    selection.min_hypervolume = words.number("min-hypervolume", 0).value_or(0) / slope;
    return selection;
}

PageEntry entry_of(const Atlas& atlas, const BranchInfo& branch) {
    const Analysis& analysis = AtlasAccess::analysis(atlas);
    Event event = analysis.event(branch.top);
    const std::array<double, 3> top = event.position;  // contained wherever the branch is separate
    PageEntry entry;
    entry.id = atlas.info().extent.index(std::llround(top[0]), std::llround(top[1]), std::llround(top[2]));
    entry.tau = !branch.parent.exists() ? std::midpoint(atlas.range()[0], branch.appears)
                                        : branch.merges + (branch.appears - branch.merges) * kShareAboveMerge;
    while (event.zone.tau_low >= entry.tau) event = analysis.event(event.parent);
    entry.tau_low = std::max(event.zone.tau_low, atlas.range()[0]), entry.tau_high = event.zone.tau_high;
    entry.tunnels = event.b1, entry.cavities = event.b2;
    entry.voxels = branch.voxels, entry.measure = branch.measure;
    return entry;
}

}  // namespace

BranchesWanted branches_wanted(QueryParameters& words, const Calibration& calibration) {
    BranchesWanted wanted{.selection = selection_of(words, calibration)};
    wanted.top = words.whole("top", 1, kMaxBranchesListed).value_or(kDefaultListed);
    words.reject_unknown();
    return wanted;
}

PageEntry branch_entry(const Atlas& atlas, const BranchHierarchy& hierarchy, std::int64_t rank) {
    const std::span<const BranchInfo> all = hierarchy.branches();
    if (rank < 0 || rank >= std::ssize(all)) {
        throw Error(ErrorKind::not_found, {.where = "branch " + std::to_string(rank),
                                           .what = "no such object",
                                           .expected = "a rank from 0 to " + std::to_string(std::ssize(all) - 1)});
    }
    return entry_of(atlas, all[static_cast<std::size_t>(rank)]);
}

std::string branches_json(const Atlas& atlas, const BranchHierarchy& hierarchy, std::span<const std::int64_t> number_of_rank,
                          const BranchesWanted& wanted, const Context& context) {
    const Calibration scale = atlas.info().calibration;
    const std::span<const BranchInfo> all = hierarchy.branches();
    const std::vector<BranchId> kept = hierarchy.kept(wanted.selection);
    const std::span<const BranchId> listed = std::span(kept).first(std::min(kept.size(), static_cast<std::size_t>(wanted.top)));
    std::vector<PageEntry> entries;
    for (const BranchId branch : listed) {
        stop_if_cancelled(context);
        entries.push_back(entry_of(atlas, all[branch.index()]));
    }
    return document("branches", [&](JsonStream& json) {
        json.key("source").value(command_source(atlas, atlas.info().path)).key("all").value(all.size()).key("kept").value(kept.size());
        const auto put = [&](const char* name, auto&& value) {
            json.line().key(name).begin_array();
            for (std::size_t i = 0; i < listed.size(); ++i) json.value(value(all[listed[i].index()], entries[i]));
            json.end_array();
        };
        using Branch = const BranchInfo&;
        using Entry = const PageEntry&;
        put("rank", [&](Branch branch, Entry) { return &branch - all.data(); });
        put("number", [&](Branch branch, Entry) { return number_of_rank[static_cast<std::size_t>(&branch - all.data())]; });
        put("id", [](Branch branch, Entry) { return branch.id; });
        put("voxel", [](Branch, Entry entry) { return entry.id; });
        put("tau", [&](Branch, Entry entry) { return scale.reported(entry.tau); });
        put("low", [&](Branch, Entry entry) { return scale.reported_interval(entry.tau_low, entry.tau_high)[0]; });
        put("high", [&](Branch, Entry entry) { return scale.reported_interval(entry.tau_low, entry.tau_high)[1]; });
        put("tunnels", [](Branch, Entry entry) { return entry.tunnels; });
        put("cavities", [](Branch, Entry entry) { return entry.cavities; });
        put("appears", [&](Branch branch, Entry) { return scale.reported(branch.appears); });
        put("merges", [&](Branch branch, Entry) { return scale.reported(branch.merges); });
        put("parent", [](Branch branch, Entry) { return branch.parent.number(); });
        put("persistence", [&](Branch branch, Entry) { return scale.reported_difference(branch.persistence); });
        put("hypervolume", [&](Branch branch, Entry) { return scale.reported_difference(branch.hypervolume); });
        put("voxels", [](Branch branch, Entry) { return branch.voxels; });
        put("measure", [](Branch branch, Entry) { return branch.measure; });
        put("significant",
            [&](Branch branch, Entry) { return std::ranges::binary_search(hierarchy.significant(), BranchId(&branch - all.data())); });
    });
}

}  // namespace isoatlas

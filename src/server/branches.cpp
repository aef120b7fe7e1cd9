#include "server/branches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "atlas/access.h"
#include "isoatlas/shell_word.h"
#include "server/document.h"

namespace isoatlas::server {
namespace {

using output::JsonStream;

constexpr std::int64_t kDefaultListed = 1000;
/// An isovalue so little above that of the merge that the branch has nearly all its voxels, and so far that no rounding reaches it.
constexpr double kShareAboveMerge = 1.0 / 64;

/// The words of `isoatlas objects`, in units of the file.
Selection selection_of(Words& words, const Calibration& scale) {
    const double slope = std::abs(scale.slope);
    Selection selection;
    selection.keep = words.whole("keep", 1, std::int64_t{1} << 40);
    selection.least_voxels = words.number("min-voxels", 0).value_or(0);
    selection.least_measure = words.number("min-volume", 0).value_or(0);
    selection.least_persistence = words.number("persistence", 0).value_or(0) / slope;
    selection.least_hypervolume = words.number("min-hypervolume", 0).value_or(0) / slope;
    return selection;
}

template <class Of>
void put_column(JsonStream& json, const char* name, std::span<const std::int64_t> ranks, Of&& of) {
    json.line().key(name).begin_array();
    for (const std::int64_t rank : ranks) json.value(of(rank));
    json.end_array();
}

page::PageEntry entry_of(const Atlas& atlas, const BranchInfo& branch) {
    const std::array<double, 3> top = AtlasAccess::analysis(atlas).event(branch.top).position;  // in it wherever it is on its own
    page::PageEntry entry;
    entry.id = atlas.info().extent.index(std::llround(top[0]), std::llround(top[1]), std::llround(top[2]));
    entry.tau = branch.parent < 0 ? std::midpoint(atlas.range()[0], branch.appears)
                                  : branch.merges + (branch.appears - branch.merges) * kShareAboveMerge;
    entry.voxels = branch.voxels, entry.measure = branch.measure;
    return entry;
}

}  // namespace

const BranchHierarchy& Branches::hierarchy(const Atlas& atlas, const Context& context) const {
    return *hierarchy_.get([&] { return std::make_unique<BranchHierarchy>(atlas.hierarchy(context)); });
}

page::PageEntry Branches::entry(const Atlas& atlas, std::int64_t rank, const Context& context) const {
    const std::span<const BranchInfo> all = hierarchy(atlas, context).branches();
    if (rank < 0 || rank >= std::ssize(all)) {
        throw Error(ErrorKind::not_found, {.where = "branch " + std::to_string(rank),
                                           .what = "there is no such object",
                                           .expected = "a rank from 0 to " + std::to_string(std::ssize(all) - 1)});
    }
    return entry_of(atlas, all[static_cast<std::size_t>(rank)]);
}

std::string Branches::json(const Atlas& atlas, Words& words, const Context& context) const {
    const Calibration scale = atlas.info().calibration;
    const Selection selection = selection_of(words, scale);
    const std::int64_t top = words.whole("top", 1, kMostListed).value_or(kDefaultListed);
    words.refuse_others();
    const std::span<const BranchInfo> all = hierarchy(atlas, context).branches();
    const std::vector<std::int64_t>& essential = hierarchy(atlas, context).essential();
    const std::vector<std::int64_t> kept = hierarchy(atlas, context).kept(selection);
    const std::span<const std::int64_t> listed = std::span(kept).first(std::min(kept.size(), static_cast<std::size_t>(top)));
    const auto branch = [&](std::int64_t rank) -> const BranchInfo& { return all[static_cast<std::size_t>(rank)]; };
    const auto stands_out = [&](std::int64_t rank) { return std::ranges::binary_search(essential, rank); };
    return document("branches", [&](JsonStream& json) {
        json.key("source").value(shell_word(atlas.info().path)).key("all").value(all.size()).key("kept").value(kept.size());
        put_column(json, "rank", listed, [](std::int64_t rank) { return rank; });
        put_column(json, "id", listed, [&](std::int64_t rank) { return branch(rank).id; });
        put_column(json, "voxel", listed, [&](std::int64_t rank) { return entry_of(atlas, branch(rank)).id; });
        put_column(json, "tau", listed, [&](std::int64_t rank) { return scale.reported(entry_of(atlas, branch(rank)).tau); });
        put_column(json, "appears", listed, [&](std::int64_t rank) { return scale.reported(branch(rank).appears); });
        put_column(json, "merges", listed, [&](std::int64_t rank) { return scale.reported(branch(rank).merges); });
        put_column(json, "parent", listed, [&](std::int64_t rank) { return branch(rank).parent; });
        put_column(json, "persistence", listed, [&](std::int64_t rank) { return scale.reported_difference(branch(rank).persistence); });
        put_column(json, "hypervolume", listed, [&](std::int64_t rank) { return scale.reported_difference(branch(rank).hypervolume); });
        put_column(json, "voxels", listed, [&](std::int64_t rank) { return branch(rank).voxels; });
        put_column(json, "measure", listed, [&](std::int64_t rank) { return branch(rank).measure; });
        put_column(json, "standsOut", listed, stands_out);
    });
}

}  // namespace isoatlas::server

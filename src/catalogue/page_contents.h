// What a page shows, before it is written. Stored values.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "atlas/overview.h"
#include "catalogue/count_columns.h"
#include "catalogue/histogram.h"
#include "catalogue/turntable.h"
#include "isoatlas/atlas.h"
#include "isoatlas/cavities.h"
#include "isoatlas/page.h"
#include "isoatlas/simplify.h"

namespace isoatlas {

/// For isovalues in (closes, opens].
struct PageTunnel {
    double opens, closes;
};

/// An object of the volume, as long as it is on its own: for isovalues between appears and merges.
struct PageBranch {
    bool is_cavity = false;
    std::int64_t id = 0;
    std::int64_t rank = 0;           ///< among all of its side, from 0: BranchHierarchy::branches(), CavityTable::entries
    double appears = 0, merges = 0;  ///< merges of the main branch: -infinity
    std::int64_t parent = -1;        ///< position of the branch it merges into, or of the closest one on the page that goes on from there
    double hypervolume = 0;
    std::int64_t voxels = 0;  ///< just before it merges
    double measure = 0;
    std::int64_t joined = 0;                       ///< objects that merge into it, those that are not on the page included
    bool stands_out = false;                       ///< noise does not explain it, and it is not tiny beside the largest
    std::vector<CountColumn> shape{};              ///< what it is like over its isovalues; empty: not on the page
    std::vector<RecommendedIsovalue> isovalues{};  ///< others that show it well, without an entry
    std::int64_t top = -1;                         ///< bright: the event at which it begins
    std::vector<PageTunnel> tunnels{};             ///< that open in it, the longest: catalogue/longest_tunnels.h
    std::int64_t standing_tunnels = 0;             ///< how many of these noise does not explain
};

/// A branch at an isovalue that shows it.
struct PageEntry {
    std::int64_t branch = 0;
    std::int64_t id = 0;  ///< of the object (bright), of the contour around it (dark)
    double tau = 0, tau_low = 0, tau_high = 0;
    std::int64_t voxels = 0;
    double measure = 0;
    std::int64_t tunnels = 0, cavities = 0;  ///< dark: of its wall; bright objects inside it
    std::int64_t inside = -1;                ///< entry of the same side that contains it
    std::int64_t around = -1;                ///< dark: entry of the object that it is a cavity of
    std::optional<IsovalueReason> reason{};  ///< why this isovalue, where it is known
    Turntable picture{};
    Colour colour{};
};

struct PageContents {
    std::vector<PageBranch> branches;                                ///< bright ones by rank, then dark ones by rank
    std::vector<PageEntry> entries;                                  ///< in the same order
    std::int64_t objects = 0, cavities = 0;                          ///< in all
    std::int64_t significant_objects = 0, significant_cavities = 0;  ///< of these, what noise does not explain and is not tiny
    double noise = 0;
    AxisScale scale;
    SelectionCurve curve;  ///< of hypervolume, thinned
    std::vector<CountColumn> spectrum;
    Histogram histogram;
    bool exact_tunnels = false;  ///< the pairs of catalogue/longest_tunnels.h
};

/// Without pictures. found: of this atlas. Throws as write_page(). Cost: Atlas::histogram(), O(events).
[[nodiscard]] PageContents page_contents(const Atlas& atlas, const Overview& found, const PageOptions& options, const Context& context);
/// What an entry shows of a 3D volume. dark: of its id, which is that of a contour. Cost: Atlas::extract().
[[nodiscard]] Surface surface_of(const Atlas& atlas, bool is_cavity, const PageEntry& entry, const Context& context);
/// Cost: options.frames pictures for every entry.
void draw_pictures(PageContents& contents, const Atlas& atlas, const PageOptions& options, const Context& context);

}  // namespace isoatlas

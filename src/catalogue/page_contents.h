// Contents of a page, independent of its format. Stored values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "atlas/overview.h"
#include "catalogue/compare_smoothing.h"
#include "catalogue/count_columns.h"
#include "catalogue/histogram.h"
#include "catalogue/page_mesh.h"
#include "catalogue/store_sides.h"
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

/// A branch: an object for isovalues between appears and merges.
struct PageBranch {
    bool is_cavity = false;
    Polarity polarity = Polarity::high;  ///< of its stored values, too
    std::int64_t id = 0;
    std::int64_t number = 0;         ///< of its first entry in the table, from 1; 0: the table has none
    std::int64_t rank = 0;           ///< among all of its side, from 0: BranchHierarchy::branches(), CavityTable::entries
    double appears = 0, merges = 0;  ///< merges of the main branch: -infinity
    std::int64_t parent = -1;        ///< position of the branch it merges into, or of its closest ancestor on the page
    double hypervolume = 0;
    std::int64_t voxels = 0;  ///< just before it merges
    double measure = 0;
    std::int64_t joined = 0;                       ///< objects that merge into it, also those not on the page
    bool is_significant = false;                   ///< significant: above the noise level and not tiny compared with the largest
    std::vector<CountColumn> shape{};              ///< counts over its isovalues; empty: not on the page
    std::vector<RecommendedIsovalue> isovalues{};  ///< further recommended isovalues, without an entry
    EventId top = EventId::none();                 ///< objects: the event at which it begins
    std::vector<PageTunnel> tunnels{};             ///< the longest that open in it: catalogue/longest_tunnels.h
    std::int64_t significant_tunnels = 0;          ///< number of significant ones
};

/// A branch at one of its recommended isovalues.
struct PageEntry {
    std::int64_t branch = 0;
    std::int64_t number = 0;  ///< in the table of its side, from 1
    std::string name{};       ///< that a user gave it
    std::int64_t id = 0;      ///< of the object, or of the contour around the cavity
    double tau = 0, tau_low = 0, tau_high = 0;
    std::int64_t voxels = 0;
    double measure = 0;
    std::int64_t tunnels = 0, cavities = 0;  ///< cavity: of its wall; objects inside it
    std::int64_t inside = -1;                ///< entry of the same side that contains it
    std::int64_t around = -1;                ///< cavity: entry of the surrounding object
    std::optional<IsovalueReason> reason{};  ///< reason of the isovalue, if known
    std::int64_t card = 0;       ///< number of the line of its branch whose card it is on (isoatlas/cards.h); its own: it has one
    double overlap = 1;          ///< with that line
    bool is_background = false;  ///< the outline of the scanned field
    Turntable picture{};
    PageMesh mesh{};
    Colour colour{};
    bool is_enclosed = false;  ///< of pages of both polarities: of low values, a cavity of `around`, if that is on the page
    std::string border{};      ///< likewise: where it reaches the border
};

/// What a page of both polarities says of all objects of low values.
struct PageSide {
    std::int64_t objects = 0, significant_objects = 0;
    double noise = 0;
    SelectionCurve curve;
    std::vector<CountColumn> spectrum;
};

struct PageContents {
    std::vector<PageBranch> branches;                                ///< objects by rank, then cavities by rank
    std::vector<PageEntry> entries;                                  ///< in the same order
    std::int64_t objects = 0, cavities = 0;                          ///< in all
    std::int64_t significant_objects = 0, significant_cavities = 0;  ///< significant ones of these
    double noise = 0;
    AxisScale scale;
    SelectionCurve curve;  ///< of hypervolume, thinned
    std::vector<CountColumn> spectrum;
    Histogram histogram;
    std::vector<std::string> notes;          ///< of PageOptions
    std::optional<PageSmoothing> smoothing;  ///< of PageOptions
    std::optional<SmoothingComparison> comparison{};
    bool is_complete = true;        ///< false: with the first pictures, while the others are drawn
    bool exact_tunnels = false;     ///< the pairs of catalogue/longest_tunnels.h
    std::optional<PageSide> low{};  ///< of both polarities: all else is of high values, or of both (catalogue/joined_contents.h)
};

/// Without pictures. found: of this atlas. Throws as write_page(). Cost: Atlas::histogram(), O(events).
[[nodiscard]] PageContents page_contents(const Atlas& atlas, const Overview& found, const PageOptions& options, const Context& context);
/// The surface of an entry of a 3D volume. is_cavity: its id is that of a contour. Cost: Atlas::extract().
[[nodiscard]] Surface surface_of(const Atlas& atlas, bool is_cavity, const PageEntry& entry, const Context& context);
/// Pictures of the first kFirstCards entries, all objects of high values, also kept in draft. Cost and errors as draw_pictures().
void draw_first_pictures(PageContents& contents, const Atlas& atlas, const PageOptions& options, PageDraft::Data& draft,
                         const Context& context);
/// A picture of every entry that options.draft does not have, in their order. Returns what it has of coarse_surfaces(). drawn: as of
/// draw_cards(). Cost: a surface each, drawn options.frames times.
[[nodiscard]] std::vector<std::optional<CoarseSurface>> draw_pictures(PageContents& contents, const StoreSides& sides,
                                                                      const PageOptions& options,
                                                                      const std::function<void(std::size_t)>& drawn,
                                                                      const Context& context);
/// The surfaces of the entries for page_meshes(), in their order; none of a 2D volume. made: those that are there already. Cost and errors
/// as coarse_cards().
[[nodiscard]] std::vector<CoarseSurface> coarse_surfaces(const PageContents& contents, const StoreSides& sides,
                                                         std::vector<std::optional<CoarseSurface>> made, const Context& context);

}  // namespace isoatlas

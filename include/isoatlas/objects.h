// Objects: the ranked table of the objects of a volume: at which isovalues each exists, which isovalue shows it best, how large it is.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/selection.h"

namespace isoatlas {

/// Where an object touches the border of the volume.
struct BorderContact {
    std::uint8_t sides = 0;  ///< bits 0 to 5: low x, high x, low y, high y, low z, high z (2D: the first four)
    double part = -1;        ///< of the samples at the border that lie in it, 0 to 1; -1: not determined (objects of high values)
    [[nodiscard]] bool is_known() const { return part >= 0; }
    friend bool operator==(const BorderContact&, const BorderContact&) = default;
};
/// "-x +x -z": the sides; "": none.
[[nodiscard]] std::string sides_text(const BorderContact& border);

/// One entry of the table: a branch of the criticality tree and the isovalue that shows it best.
struct ObjectEntry {
    std::int64_t id;                 ///< index of the highest voxel of the object at best_tau, for SurfaceOptions::objects
    EventId event;                   ///< the event whose zone contains best_tau
    double appears, merges;          ///< stored values: the object is on its own for tau in (merges, appears]; merges = -infinity: never
    double best_tau;                 ///< stored value
    std::int64_t voxels;             ///< at best_tau
    double measure;                  ///< physical volume (area in 2D) at best_tau
    std::int64_t tunnels;            ///< b1 at best_tau
    std::int64_t cavities;           ///< b2 at best_tau
    double hypervolume;              ///< sum over the object just above `merges` of (value - merges); the rank
    std::array<double, 3> position;  ///< voxel coordinates of the highest voxel
    double tau_low, tau_high;        ///< for isovalues in (tau_low, tau_high] the object has the tunnels and cavities of best_tau
    std::int64_t inside;             ///< position in ObjectTable::entries of the closest entry that contains this one; -1: none
    EventId branch_top;              ///< the event at which its branch begins: a maximum; none: unknown (stores of early versions)
    bool outline;                    ///< best_tau shows everything that is not background
    bool main_branch;                ///< of the object that exists at every isovalue
    std::string note;                ///< "largest", "outline", "inside 3", ...
    BorderContact border{};          ///< at best_tau
};

/// Why an isovalue shows an object well (docs/theory/7-which-objects-matter.md#stable-isovalues). V(tau) is the object's volume.
enum class IsovalueReason : std::uint8_t {
    stable,   ///< -d ln V / d tau is locally least there: the boundary is steep, the body compact
    outline,  ///< the same at the low end of its range, or the lowest of several that holds 15 % of the volume: all but background
    outer,    ///< stable when its outer boundary is counted alone, with its significant cavities filled
    inner,    ///< stable for one of these cavities: its wall
    merge,   ///< no isovalue is stable: just above the value at which it merges; of the main branch: at which another large object joins it
    middle,  ///< no isovalue is stable: the middle of the range of the object that exists at every isovalue
};
[[nodiscard]] const char* name_of(IsovalueReason reason);  ///< "stable", "outline", ...
[[nodiscard]] const char* text_of(IsovalueReason reason);  ///< for users, without terms of topology

/// One isovalue of one object, and the reason. The rows of the table are some of these.
struct RecommendedIsovalue {
    std::int64_t branch_top;  ///< of the object: number of ObjectEntry::branch_top
    double tau;               ///< stored value
    double prominence;        ///< of -ln(-d ln V / d tau): at least ln 1.5, infinity for the most prominent; 0: none is stable. Where
                              ///< nearly all samples are low, the rate is along the bent axis of the page
    IsovalueReason reason;
    std::int64_t cavity =
        -1;  ///< inner, and in a CavityTable: the cavity (CavityEntry::id at tau, the id of the contour around it); else -1
    friend bool operator==(const RecommendedIsovalue&, const RecommendedIsovalue&) = default;
};

struct ObjectTable {
    std::vector<ObjectEntry> entries;  ///< by rank; the main branch has up to five, from the outside in, the box of the volume last
    /// Of all objects of the table, by their rank; of each those of rows first, then by descending prominence, outlines last; then outer
    /// and inner ones that can be distinguished from the former, of up to five cavities. Empty: a store of an early version.
    std::vector<RecommendedIsovalue> isovalues{};
    std::int64_t branches = 0;  ///< how many objects there are in all (maxima events)
    double noise = 0;           ///< estimated standard deviation of the noise, stored units
};

struct RankOptions {
    std::int64_t top = 24;                 ///< at most this many entries; 0: all that pass the gate
    bool gate = true;                      ///< drop what noise alone explains (docs/theory/7-which-objects-matter.md#the-noise-gate)
    std::optional<Selection> selection{};  ///< instead of the gate
};

/// Needs an analysis with zones. Ranking by hypervolume, isovalues by the stability of the volume (docs/theory/7-which-objects-matter.md).
/// Cost: that of rank_cavities(), as cavities are found too.
[[nodiscard]] ObjectTable rank_objects(const Volume& volume, const Analysis& analysis, const RankOptions& options = {},
                                       const Context& context = {});

/// How far noise of that standard deviation rises above its surroundings in a volume of so many voxels: what rises higher is not noise
/// (docs/theory/8-noise-and-stability.md#how-high-noise-rises). In units of `noise`.
[[nodiscard]] double noise_height(double noise, std::int64_t voxels);

/// Those of one object, given by the number of ObjectEntry::branch_top or CavityEntry::branch_minimum. isovalues: of a table.
[[nodiscard]] std::vector<RecommendedIsovalue> isovalues_of(std::span<const RecommendedIsovalue> isovalues, std::int64_t branch_top);
/// That of the entry's own isovalue; empty when it is unknown.
[[nodiscard]] std::optional<RecommendedIsovalue> isovalue_of(const ObjectTable& table, const ObjectEntry& entry);

inline constexpr double kBackgroundPart = 2.0 / 3, kBorderPart = 0.5, kShownInside = 0.6, kLeastBorderPart = 0.03;
/// Is a line background, what lies around the objects (docs/theory/9-low-values.md#background)? An outline of more than kBackgroundPart of
/// all voxels; of low values also that many around everything, reaching all sides; what reaches all sides with more than kBorderPart of the
/// border; an outline of which other lines show kShownInside; and what lies along the border: on sides of every axis, with at least
/// kLeastBorderPart of it and more than half the surface of a cube of its size. Pictures omit it. table: of first_entries(), an outline may
/// lack the lines inside it. Cost: O(1); of an outline of low values O(entries).
[[nodiscard]] bool is_background(const ObjectTable& table, std::size_t line, const Extent& extent);

/// The first entries alone (0: all): what rank_objects() gives with that many at most.
[[nodiscard]] ObjectTable first_entries(ObjectTable table, std::int64_t top);

}  // namespace isoatlas

// Contour spectrum: numbers of objects, contours, tunnels and cavities at every isovalue, and sizes of the surface.
//
// Counts follow from the trees and are exact for every isovalue at once: they change at events only. Sizes are measured on the surfaces of
// some isovalues.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/bounds.h"
#include "isoatlas/objects.h"
#include "isoatlas/selection.h"
#include "isoatlas/volume.h"

namespace isoatlas {

class Sink;

class Atlas;

struct LevelCounts {
    std::int64_t objects = 0, contours = 0;
    std::int64_t tunnels = 0, cavities = 0;  ///< b1 and b2 of all objects together; 2D: holes, and no cavities
    friend bool operator==(const LevelCounts&, const LevelCounts&) = default;
};

/// The isovalues (low, high] between neighbouring values of events, in which no count changes; low is -infinity for the last one.
struct SpectrumInterval {
    double low, high;  ///< stored values
    LevelCounts all;   ///< of all objects
    LevelCounts
        significant{};  ///< of the objects that contain a significant one (ObjectTable): as many objects as significant branches are there
};

/// The closed surface of an isovalue, as extract() makes it.
struct SpectrumSize {
    double tau;            ///< stored value
    Bounds voxels;         ///< High samples; of a store with many different samples not always known exactly
    std::int64_t cells;    ///< active, those towards the outside included
    std::int64_t facets;   ///< triangles (2D: segments)
    double area, measure;  ///< physical: of the surface; of what it encloses (2D: length, area)
};

/// An isovalue that shows an object well.
struct SpectrumAdvice {
    double tau;                            ///< stored value
    std::int64_t object;                   ///< id at tau
    std::optional<IsovalueReason> reason;  ///< empty: a store of an early version
    std::int64_t cavity = -1;              ///< as in RecommendedIsovalue
    std::string note;                      ///< of its row of the ObjectTable; empty: it has none
};

struct Spectrum {
    std::vector<SpectrumInterval> intervals;  ///< descending; above the first there is nothing
    std::vector<SpectrumSize> sizes;          ///< descending isovalues
    std::vector<SpectrumAdvice> advice;       ///< of every object of the ObjectTable, by rank: its rows, then its other isovalues
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;  ///< of AnalysisOptions
    bool selected = false;     ///< significant is what SpectrumOptions::selection keeps
};

struct SpectrumOptions {
    std::int64_t samples = 24;             ///< isovalues that are measured: the middles of so many equal parts of the range; 0: none
    std::optional<Selection> selection{};  ///< selects what is significant; none: what noise does not explain
};

/// analysis: of this volume, with zones. Cost: O(events) and rank_objects(), and for every measured isovalue that of extract().
/// Throws Error: usage (analysis without zones), cancelled.
[[nodiscard]] Spectrum spectrum(const Volume& volume, const Analysis& analysis, const SpectrumOptions& options = {},
                                const Context& context = {});
/// The same of a store: counts without reading a sample, sizes from the bricks that the isovalues divide.
/// Throws Error: input (damaged), cancelled.
[[nodiscard]] Spectrum spectrum(const Atlas& atlas, const SpectrumOptions& options = {}, const Context& context = {});

/// The counts at an isovalue: zeros above everything. Cost: O(log intervals).
[[nodiscard]] SpectrumInterval counts_at(const Spectrum& spectrum, double tau);

struct SpectrumOutput {
    std::int64_t max_intervals = 512;  ///< in JSON: of more, neighbouring ones are merged and have the range of each count; 0: any number
};

/// The format follows the name: .csv (a row for each interval, then the sizes in their own columns), .svg (a plot), .json
/// (docs/schema/spectrum). Values are reported values. Written to a temporary name and renamed. Throws Error: usage (unknown extension),
/// resource.
void write_spectrum(const std::string& path, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options = {});
void write_spectrum(Sink& sink, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options = {});
/// The same JSON document on a stream.
void write_spectrum_json(std::ostream& out, const VolumeInfo& info, const Spectrum& spectrum, const SpectrumOutput& options = {});

}  // namespace isoatlas

// Measures: how large objects are, what shape and what values they have; porosity, percolation, distribution of sizes.
// Definitions with sources: docs/measures.md.
//
// Lengths, areas and volumes are in the unit of the geometry (voxels where it names none and has steps of 1), values are reported values,
// isovalues stored ones. The same numbers for any number of threads: sums are of fixed blocks, in their order.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/atlas.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

class Sink;

/// Of the samples of an object; reported values.
struct ValueStatistics {
    double mean = 0;  ///< each sample with the volume of its box: the sum by the number unless the steps of the grid are uneven
    double min = 0, max = 0;
    double sum = 0;        ///< each sample once
    double deviation = 0;  ///< root of the mean squared difference from the mean
};

/// The ellipsoid (2D: ellipse) with the same second moments (docs/measures.md#principal-axes). Longest axis first.
struct PrincipalAxes {
    Mat3 direction{};  ///< rows: unit vectors, right-handed
    Vec3 length{};     ///< whole length of each axis of the ellipsoid; 2D: the third is 0
};

/// The smallest box along the principal axes that holds the surface. Not the smallest of all boxes.
struct OrientedBox {
    Vec3 centre{};
    Vec3 size{};  ///< along PrincipalAxes::direction; 2D: the third is 0
};

/// Distances between two parallel planes (2D: lines) that touch the object from both sides (docs/measures.md#feret-diameters). Exact for
/// the convex hull of the points of the surface. min and mean: not a number for an object whose surface is flat within rounding.
struct FeretDiameters {
    double max = 0, min = 0;
    double mean = 0;  ///< over all directions: mean breadth
    Vec3 max_direction{}, min_direction{};
};

/// How thick an object is, at the thinnest and at the median by area (docs/measures.md#wall-thickness). Not a number: not measured, or no
/// part of its surface is a wall.
struct ObjectThickness {
    double min = std::numeric_limits<double>::quiet_NaN(), median = std::numeric_limits<double>::quiet_NaN();
};

/// One object at one isovalue.
struct ObjectMeasures {
    std::int64_t id = -1;  ///< index of its highest voxel, as in Cut
    double tau = 0;        ///< stored value
    std::int64_t voxels = 0;
    double voxel_volume = 0;         ///< of the boxes of its voxels; 2D: area
    double volume = 0;               ///< that its surface encloses, without cavities; 2D: area, without holes
    double area = 0;                 ///< of its surface, with the walls of cavities; 2D: length of its curves
    double equivalent_diameter = 0;  ///< of the ball (2D: disk) of the same volume
    double sphericity = 0;           ///< area of that ball by `area`; 2D: circularity, 4 pi volume / area^2
    ValueStatistics values;
    Vec3 centroid{};  ///< of the boxes of its voxels
    PrincipalAxes axes;
    OrientedBox box;
    std::array<Vec3, 2> bounds{};  ///< lowest and highest coordinates of its surface
    FeretDiameters feret;
    ObjectThickness thickness;
    std::int64_t euler = 1, tunnels = 0, cavities = 0;  ///< euler = 1 - tunnels + cavities; 2D: tunnels are holes
    std::int64_t facets = 0;                            ///< triangles of its surface; 2D: segments
    bool touches_border = false;                        ///< the volume ends before it does: sizes are those of the part inside
};

struct MeasureOptions {
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;             ///< trilinear: tunnels of at most this height (difference of stored values) are left out
    std::vector<std::int64_t> objects{};  ///< voxel indices: the objects at tau that contain them; empty: all
    bool thickness = false;               ///< ObjectMeasures::thickness, too; 3D only. Cost: seven rays for each point of the surface
};

/// Of a store, which has the interpolant that it was built with.
struct AtlasMeasureOptions {
    std::vector<std::int64_t> objects{};  ///< as above
    std::int64_t max_triangles = 0;       ///< of SurfaceOptions
    bool thickness = false;               ///< as above
};

/// The objects at an isovalue, by descending voxels, then ascending id. Throws Error: not_found for a voxel of no object, usage (tau is not
/// finite), cancelled. Cost: that of extract(), one pass over the samples of the objects, and their convex hulls; memory: the surface, and
/// a bit a voxel.
[[nodiscard]] std::vector<ObjectMeasures> measure_objects(const Volume& volume, double tau, const MeasureOptions& options = {},
                                                          const Context& context = {});
/// The same of a store, with its interpolant. Reads the bricks that hold the objects, some slices at a time, and those of extract().
[[nodiscard]] std::vector<ObjectMeasures> measure_objects(const Atlas& atlas, double tau, const AtlasMeasureOptions& options = {},
                                                          const Context& context = {}, QueryCost* cost = nullptr);

struct LabelMeasureOptions {
    Interpolant interpolant = Interpolant::trilinear;
    bool thickness = false;  ///< as above
};
/// The labels of a label volume (isoatlas/labels.h), ascending, each as one object, also of several pieces: euler = pieces - tunnels +
/// cavities. id and tau are the label. Its surface lies half-way to the neighbours. Throws as list_labels(). Cost: for each label that of
/// extract() of its box.
[[nodiscard]] std::vector<ObjectMeasures> measure_labels(const Volume& volume, const LabelMeasureOptions& options = {},
                                                         const Context& context = {});

/// Diameters that at least 10, 25, 50, 75 and 90 % of the objects do not exceed; each is that of an object.
using SizeQuantiles = std::array<double, 5>;
inline constexpr SizeQuantiles kSizeFractions{0.1, 0.25, 0.5, 0.75, 0.9};

/// Of the equivalent diameters of objects (docs/measures.md#distribution-of-sizes).
struct SizeDistribution {
    std::int64_t objects = 0;
    double mean = 0, deviation = 0, min = 0, max = 0;
    SizeQuantiles by_number{};  ///< of objects
    SizeQuantiles by_volume{};  ///< of their volume: objects that hold at least 10, ... % of it
};
/// All zero without objects.
[[nodiscard]] SizeDistribution size_distribution(std::span<const ObjectMeasures> objects);

/// How many samples are below each of some isovalues (stored values, ascending, finite). By the number of samples that is the porosity of
/// a volume whose low values are pores. Throws Error: usage, cancelled. Cost: one pass over the samples; of a store, the bricks that an
/// isovalue divides.
[[nodiscard]] std::vector<std::int64_t> samples_below(const Volume& volume, std::span<const double> taus, const Context& context = {});
[[nodiscard]] std::vector<std::int64_t> samples_below(const Atlas& atlas, std::span<const double> taus, const Context& context = {});

/// The isovalues at which a phase connects both end faces of the volume, for each axis (docs/measures.md#percolation). Stored values.
struct Percolation {
    Vec3 high{};  ///< at tau <= high[axis], and at no other, one object holds samples of both end faces
    Vec3 low{};   ///< at tau > low[axis], and at no other, samples below tau are connected from face to face inside the volume
};

/// high[axis] from the trees. analysis: of this volume, with zones. Throws Error{usage}. Cost: O(events + samples of the end faces).
[[nodiscard]] Vec3 high_percolation(const Volume& volume, const Analysis& analysis, const Context& context = {});

/// Both sides; the low one is the high one of the reversed samples. Cost: two analyses, one after the other, and a copy of the samples.
[[nodiscard]] Percolation percolation(const Volume& volume, const AnalysisOptions& options = {}, const Context& context = {});

/// A table with one line for each object; the format follows the name: .csv. Written to a temporary name and renamed. Throws Error: usage
/// (unknown extension), resource. polarities: of each object, where they are of both (info: of either); the values are those of the file.
void write_measures(const std::string& path, const VolumeInfo& info, std::span<const ObjectMeasures> objects,
                    std::span<const Polarity> polarities = {});
void write_measures(Sink& sink, const VolumeInfo& info, std::span<const ObjectMeasures> objects, std::span<const Polarity> polarities = {});

}  // namespace isoatlas

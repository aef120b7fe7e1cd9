// The hits: points of the surface on the edges of the grid, with normals.
#pragma once

#include <type_traits>

#include "field/sample_grid.h"
#include "mesh/layout.h"
#include "mesh/physical_map.h"

namespace isoatlas {

/// Hits keep this distance (in edge lengths) from the voxels, so that points stay apart when tau equals a sample. A power of two.
/// A hit between a voxel and the padding lies this far outside the voxel.
inline constexpr double kHitMargin = 1.0 / 1024;

/// Where the hit lies between two samples a and b, 0..1.
inline double hit_fraction(double a, double b, double tau) {
    double t = (tau - a) / (b - a);
    if (!(t >= kHitMargin)) t = kHitMargin;
    if (t > 1 - kHitMargin) t = 1 - kHitMargin;
    return t;
}

/// Hits of which all is known but where they lie: computed many at once.
template <class Real>
struct HitBatch {
    std::size_t count = 0;
    std::array<double, kLanes> a, b;         ///< samples at the ends of the edge
    Lanes<double> voxel;                     ///< its first end
    Lanes<Real> slope, change;               ///< of the samples at the first end, and what it changes by towards the other one
    std::array<std::int8_t, kLanes> axis;    ///< of the edge
    std::array<std::int64_t, kLanes> point;  ///< where the hit is written
};

/// Writes points (and normals, unless empty) of the hits of row (y, z) of the lattice at their places.
template <class T>
class HitWriter {
public:
    HitWriter(const SampleGrid<T>& grid, double tau, const PhysicalMap& map, const MeshDomain& domain, Surface& surface);
    void write_row(std::int64_t y, std::int64_t z, const RowPlace& place) const;

private:
    /// What normals are computed in: differences of small samples are exact, or good enough, in float.
    using Real = std::conditional_t<(sizeof(T) < 4 || std::is_same_v<T, float>), float, double>;

    /// The samples around the voxels of one row, for central differences (one-sided at the border).
    struct Stencil {
        const T *row, *y_low, *y_high, *z_low, *z_high;  ///< at x = 0
        Real y_scale, z_scale;
    };
    [[nodiscard]] Stencil stencil(std::int64_t y, std::int64_t z) const;
    [[nodiscard]] std::array<Real, 3> slope(const Stencil& around, std::int64_t x) const;
    /// The hit between the voxels at x and other_x of two rows, the first of them at `voxel`.
    void add_inner(const Stencil& from, std::int64_t x, const Stencil& to, std::int64_t other_x, int axis, const Vec3& voxel,
                   std::int64_t point, HitBatch<Real>& batch) const;
    void write(HitBatch<Real>& batch) const;
    /// Asks for the samples of a row near the hits of word w.
    void prefetch_samples(const T* row, std::int64_t w, std::uint64_t hits) const;
    /// The hit between the voxel at `position` and the padding, on the side `sign` of an axis.
    void write_border(const Vec3& position, int axis, double sign, std::int64_t point) const;

    SampleGrid<T> grid_;
    double tau_;
    const PhysicalMap& map_;
    const MeshDomain& domain_;
    Surface& surface_;
};

}  // namespace isoatlas

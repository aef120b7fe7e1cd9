// The hits: points of the surface on the edges of the grid, with normals. PASS 3 of mesh/layout.h.
// In the literature: edge intersections with normals from central differences (Lorensen, Cline, Marching Cubes, 1987).
#pragma once

#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "field/sample_grid.h"
#include "mesh/bundle_samples.h"
#include "mesh/layout.h"
#include "mesh/physical_map.h"
#include "mesh/place_hits.h"

namespace isoatlas {

/// Hits of a row on edges along one axis.
struct HitLine {
    std::int64_t y, z;
    std::size_t axis;
    std::span<const std::int32_t> positions;  ///< ascending
    std::int64_t point;                       ///< of the first one; the others follow
};

/// Writes points (and normals, unless empty) of hits at their places, by bundles of rows (mesh/bundle_samples.h): those whose samples lie
/// near each other, 64 positions of each at a time.
template <class T>
class HitWriter {
public:
    HitWriter(const SampleGrid<T>& grid, double tau, const PhysicalMap& map, const MeshDomain& domain, Surface& surface);
    [[nodiscard]] std::int64_t bundles() const;
    /// The hits on all edges that begin in the rows of a bundle, and on those towards the first voxels of its rows.
    void write(std::int64_t bundle, const Layout& layout, const RowGroups& groups) const;
    /// The hits of some lines, of rows that lie less than kBundleSize behind (y, z); outside of the grid those in front of it.
    void write_lines(std::int64_t y, std::int64_t z, std::span<const HitLine> lines) const;
    /// The hits on edges that begin in a row outside, in front of the grid.
    void write_outside(std::int64_t y, std::int64_t z, const RowOffsets& place) const;

private:
    /// What normals are computed in: differences of small samples are exact, or good enough, in float.
    using Real = std::conditional_t<(sizeof(T) < 4 || std::is_same_v<T, float>), float, double>;

    /// A row on its way; y, z: in the bundle.
    struct Row {
        RowHits hits;
        std::array<std::int64_t, 3> next;  ///< point on its edges along each axis
        std::int32_t y, z;
        bool is_last_y, is_last_z;  ///< of the grid: what follows is padding

        /// Made in place: in a copy, vector loads would wait for the stores of their elements.
        Row(const RowHits& of, const RowOffsets& place, std::int64_t row_y, std::int64_t row_z, bool last_y, bool last_z)
            : hits(of),
              next{place.point, place.first_y(), place.first_z()},
              y(static_cast<std::int32_t>(row_y)),
              z(static_cast<std::int32_t>(row_z)),
              is_last_y(last_y),
              is_last_z(last_z) {}
    };
    struct Work {
        BundleSamples<T, Real> samples;
        Vec3 first;                     ///< voxel of the bundle
        std::array<HitBatch, 3> batch;  ///< by axis
        HitValues<Real> values;
    };
    void write_slice(std::vector<Row>& rows, Work& work) const;
    void write_word(std::int64_t w, Row& row, Work& work) const;
    /// y, z: of the line, in the bundle.
    void write_line(const HitLine& line, std::int64_t y, std::int64_t z, Work& work) const;
    /// Computes and writes the pending hits along an axis.
    void flush(std::size_t axis, Work& work) const;
    /// From differences of samples to normals.
    void normals_of(std::size_t axis, Work& work) const;
    /// The hits between voxels of a row, at positions of word w, and the padding behind them along an axis.
    void write_ends(std::int64_t w, std::uint64_t bits, std::size_t axis, Row& row, const Work& work) const;
    /// The hit between the voxel at `position` and the padding, on the side `sign` of an axis.
    void write_border(const Vec3& position, int axis, double sign, std::int64_t point) const;
    /// Positions of word w that are the first voxel of a row, or one of the last two: edges from there look beyond its ends.
    [[nodiscard]] std::uint64_t end_positions(std::int64_t w) const;
    [[nodiscard]] Vec3 position(std::int64_t x, std::int64_t y, std::int64_t z) const {
        return {static_cast<double>(x + grid_.origin[0]), static_cast<double>(y + grid_.origin[1]),
                static_cast<double>(z + grid_.origin[2])};
    }

    SampleGrid<T> grid_;
    double tau_;
    const PhysicalMap& map_;
    const MeshDomain& domain_;
    Surface& surface_;
    bool normals_;                                                        ///< are they written?
    std::array<std::array<std::array<float, 3>, 2>, 3> border_normal_{};  ///< by axis and side: before or behind the grid
};

}  // namespace isoatlas

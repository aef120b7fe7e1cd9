#include "mesh/place_hits.h"

#include "base/target_clones.h"

namespace isoatlas {
namespace {

template <class Real>
[[gnu::always_inline]] inline void place(const HitBatch& batch, std::size_t axis, double tau, const PhysicalMap& map, const Vec3& first,
                                         HitValues<Real>& values) {
    const std::size_t count = whole_lanes(batch.count);
    for (std::size_t i = 0; i < count; ++i)
        values.t[i] = hit_fraction(static_cast<double>(values.a[i]), static_cast<double>(values.b[i]), tau);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < count; ++i) values.place[k][i] = first[k] + static_cast<double>(batch.from[k][i]);
    }
    for (std::size_t i = 0; i < count; ++i) values.place[axis][i] += values.t[i];
    map.to_points(batch.count, values.place);
}

template <class Real>
[[gnu::always_inline]] inline void write_normals(const HitBatch& batch, const PhysicalMap& map, const std::array<Real, 3>& scales,
                                                 HitValues<Real>& values) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Real scale = scales[k];
        for (std::size_t i = 0; i < whole_lanes(batch.count); ++i) {
            const Real slope = values.slope[k][i] * scale, change = values.change[k][i] * scale - slope;
            values.slope[k][i] = slope + static_cast<Real>(values.t[i]) * change;
        }
    }
    map.to_normals(batch.count, values.slope, values.degenerate);
}

}  // namespace

ISOATLAS_TARGET_CLONES void place_hits(const HitBatch& batch, std::size_t axis, double tau, const PhysicalMap& map, const Vec3& first,
                                       HitValues<float>& values) {
    place(batch, axis, tau, map, first, values);
}
ISOATLAS_TARGET_CLONES void place_hits(const HitBatch& batch, std::size_t axis, double tau, const PhysicalMap& map, const Vec3& first,
                                       HitValues<double>& values) {
    place(batch, axis, tau, map, first, values);
}

ISOATLAS_TARGET_CLONES void compute_normals(const HitBatch& batch, const PhysicalMap& map, const std::array<float, 3>& scales,
                                            HitValues<float>& values) {
    write_normals(batch, map, scales, values);
}
ISOATLAS_TARGET_CLONES void compute_normals(const HitBatch& batch, const PhysicalMap& map, const std::array<double, 3>& scales,
                                            HitValues<double>& values) {
    write_normals(batch, map, scales, values);
}

}  // namespace isoatlas

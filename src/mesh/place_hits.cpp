#include "mesh/place_hits.h"

#include "base/wide.h"

namespace isoatlas {
namespace {

template <class Real>
[[gnu::always_inline]] inline void place(HitBatch<Real>& batch, double tau, const PhysicalMap& map, const Vec3& first, bool normals) {
    const std::size_t count = whole_lanes(batch.count);
    std::array<double, kLanes> t;
    for (std::size_t i = 0; i < count; ++i) t[i] = hit_fraction(batch.a[i], batch.b[i], tau);
    for (std::int32_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        for (std::size_t i = 0; i < count; ++i)
            batch.place[axis][i] = first[axis] + static_cast<double>(batch.from[axis][i]) + (batch.axis[i] == k ? t[i] : 0.0);
    }
    map.to_points(batch.count, batch.place);
    if (!normals) return;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < count; ++i) batch.slope[k][i] = batch.slope[k][i] + static_cast<Real>(t[i]) * batch.change[k][i];
    }
    map.to_normals(batch.count, batch.slope, batch.rare);
}

}  // namespace

ISOATLAS_WIDE void place_hits(HitBatch<float>& batch, double tau, const PhysicalMap& map, const Vec3& first, bool normals) {
    place(batch, tau, map, first, normals);
}

ISOATLAS_WIDE void place_hits(HitBatch<double>& batch, double tau, const PhysicalMap& map, const Vec3& first, bool normals) {
    place(batch, tau, map, first, normals);
}

}  // namespace isoatlas

#include "mesh/hits.h"

#include <bit>
#include <utility>

#include "base/prefetch.h"
#include "base/sample_types.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kSlicesAhead = 3;  // whose samples are asked for while a row is written: one more than its normals look at

template <class Visit>
void for_bits(std::int64_t w, std::uint64_t bits, Visit&& visit) {
    for (; bits != 0; bits &= bits - 1) visit(64 * w + std::countr_zero(bits));
}

}  // namespace

template <class T>
HitWriter<T>::HitWriter(const SampleGrid<T>& grid, double tau, const PhysicalMap& map, const MeshDomain& domain, Surface& surface)
    : grid_(grid), tau_(tau), map_(map), domain_(domain), surface_(surface) {}

template <class T>
typename HitWriter<T>::Stencil HitWriter<T>::stencil(std::int64_t y, std::int64_t z) const {
    const std::array<std::int64_t, 3>& size = grid_.extent.size;
    if (y < 0 || z < 0 || y >= size[1] || z >= size[2]) return {};
    const auto row = [this](std::int64_t row_y, std::int64_t row_z) { return grid_.samples + grid_.layout.at(0, row_y, row_z); };
    return {row(y, z),
            row(y - (y > 0), z),
            row(y + (y + 1 < size[1]), z),
            row(y, z - (z > 0)),
            row(y, z + (z + 1 < size[2])),
            static_cast<Real>(map_.inverse_distance(1)[y + grid_.origin[1]]),
            static_cast<Real>(map_.inverse_distance(2)[z + grid_.origin[2]])};
}

template <class T>
inline std::array<typename HitWriter<T>::Real, 3> HitWriter<T>::slope(const Stencil& around, std::int64_t x) const {
    const AxisLayout& along = grid_.layout.axis[0];
    const std::int64_t low = along(x - (x > 0)), here = along(x), high = along(x + (x + 1 < grid_.extent.size[0]));
    return {(static_cast<Real>(around.row[high]) - static_cast<Real>(around.row[low])) *
                static_cast<Real>(map_.inverse_distance(0)[x + grid_.origin[0]]),
            (static_cast<Real>(around.y_high[here]) - static_cast<Real>(around.y_low[here])) * around.y_scale,
            (static_cast<Real>(around.z_high[here]) - static_cast<Real>(around.z_low[here])) * around.z_scale};
}

template <class T>
inline void HitWriter<T>::add_inner(const Stencil& from, std::int64_t x, const Stencil& to, std::int64_t other_x, int axis,
                                    const Vec3& voxel, std::int64_t point, HitBatch<Real>& batch) const {
    const AxisLayout& along = grid_.layout.axis[0];
    const std::size_t i = batch.count++;
    batch.a[i] = static_cast<double>(from.row[along(x)]);
    batch.b[i] = static_cast<double>(to.row[along(other_x)]);
    for (std::size_t k = 0; k < 3; ++k) batch.voxel[k][i] = voxel[k];
    batch.axis[i] = static_cast<std::int8_t>(axis);
    batch.point[i] = point;
    if (!surface_.normals.empty()) {
        const std::array<Real, 3> s = slope(from, x), e = slope(to, other_x);
        for (std::size_t k = 0; k < 3; ++k) batch.slope[k][i] = s[k], batch.change[k][i] = e[k] - s[k];
    }
    if (batch.count == kLanes) write(batch);
}

template <class T>
void HitWriter<T>::write(HitBatch<Real>& batch) const {
    const std::size_t count = std::exchange(batch.count, 0);
    std::array<double, kLanes> t;
    for (std::size_t i = 0; i < count; ++i) t[i] = hit_fraction(batch.a[i], batch.b[i], tau_);
    for (std::size_t i = 0; i < count; ++i) batch.voxel[static_cast<std::size_t>(batch.axis[i])][i] += t[i];
    map_.to_points(count, batch.voxel);
    for (std::size_t i = 0; i < count; ++i) surface_.points[batch.point[i]] = {batch.voxel[0][i], batch.voxel[1][i], batch.voxel[2][i]};
    if (surface_.normals.empty()) return;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < count; ++i) batch.slope[k][i] = batch.slope[k][i] + static_cast<Real>(t[i]) * batch.change[k][i];
    }
    std::array<bool, kLanes> rare;
    map_.to_normals(count, batch.slope, rare);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [x, y, z] = batch.slope;
        surface_.normals[batch.point[i]] =
            rare[i] ? map_.rare_normal({static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])}, batch.axis[i],
                                       batch.a[i] > batch.b[i] ? 1 : -1)
                    : std::array{static_cast<float>(x[i]), static_cast<float>(y[i]), static_cast<float>(z[i])};
    }
}

template <class T>
void HitWriter<T>::write_border(const Vec3& position, int axis, double sign, std::int64_t point) const {
    Vec3 outside = position;
    outside[axis] += sign * kHitMargin;
    surface_.points[point] = map_.point(outside);
    if (!surface_.normals.empty()) surface_.normals[point] = map_.normal(Vec3{0, 0, 0}, axis, sign);
}

template <class T>
inline void HitWriter<T>::prefetch_samples(const T* row, std::int64_t w, std::uint64_t hits) const {
    constexpr int kStretch = 16;
    for (int i = 0; i < 64; i += kStretch) {
        const std::int64_t x = 64 * w + i;
        if ((hits >> i & 0xffff) != 0 && x < grid_.extent.size[0]) prefetch(row + grid_.layout.axis[0](x));
    }
}

template <class T>
void HitWriter<T>::write_row(std::int64_t y, std::int64_t z, const RowPlace& place) const {
    const RowHits hits(domain_, y, z);
    const std::array<std::int64_t, 3>& size = grid_.extent.size;
    const Stencil here = stencil(y, z), next_y = stencil(y + 1, z), next_z = stencil(y, z + 1);
    const auto fy = static_cast<double>(y + grid_.origin[1]), fz = static_cast<double>(z + grid_.origin[2]);
    const std::int64_t before = grid_.origin[0] - 1;  // position p is voxel p - 1
    std::int64_t x_point = place.point, y_point = place.first_y(), z_point = place.first_z();
    HitBatch<Real> batch;
    const T* ahead = z + kSlicesAhead < size[2] && here.row != nullptr ? stencil(y, z + kSlicesAhead).row : nullptr;
    hits.busy.for_each([&](std::int64_t w) {
        if (ahead != nullptr) prefetch_samples(ahead, w, hits.x(w) | hits.y(w) | hits.z(w));
        for_bits(w, hits.x(w), [&](std::int64_t p) {  // between the voxels p - 1 and p
            const auto fx = static_cast<double>(p + before);
            if (p == 0)
                write_border({fx + 1, fy, fz}, 0, -1, x_point++);
            else if (p == size[0])
                write_border({fx, fy, fz}, 0, 1, x_point++);
            else
                add_inner(here, p - 1, here, p, 0, {fx, fy, fz}, x_point++, batch);
        });
        for_bits(w, hits.y(w), [&](std::int64_t p) {
            const auto fx = static_cast<double>(p + before);
            if (here.row == nullptr)
                write_border({fx, fy + 1, fz}, 1, -1, y_point++);
            else if (next_y.row == nullptr)
                write_border({fx, fy, fz}, 1, 1, y_point++);
            else
                add_inner(here, p - 1, next_y, p - 1, 1, {fx, fy, fz}, y_point++, batch);
        });
        for_bits(w, hits.z(w), [&](std::int64_t p) {
            const auto fx = static_cast<double>(p + before);
            if (here.row == nullptr)
                write_border({fx, fy, fz + 1}, 2, -1, z_point++);
            else if (next_z.row == nullptr)
                write_border({fx, fy, fz}, 2, 1, z_point++);
            else
                add_inner(here, p - 1, next_z, p - 1, 2, {fx, fy, fz}, z_point++, batch);
        });
    });
    write(batch);
}

#define ISOATLAS_INSTANTIATE(T) template class HitWriter<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas

#include "mesh/hits.h"

#include <bit>

namespace isoatlas {
namespace {

template <class Visit>
void for_bits(std::int64_t w, std::uint64_t bits, Visit&& visit) {
    for (; bits != 0; bits &= bits - 1) visit(64 * w + std::countr_zero(bits));
}

}  // namespace

template <class T>
HitWriter<T>::HitWriter(const GridView<T>& grid, double tau, const PhysicalMap& map, const MeshDomain& domain, Surface& surface)
    : grid_(grid), tau_(tau), map_(map), domain_(domain), surface_(surface) {}

template <class T>
typename HitWriter<T>::Stencil HitWriter<T>::stencil(std::int64_t y, std::int64_t z) const {
    const std::array<std::int64_t, 3>& size = grid_.extent.size;
    if (y < 0 || z < 0 || y >= size[1] || z >= size[2]) return {};
    return {grid_.row(y, z),
            grid_.row(y - (y > 0), z),
            grid_.row(y + (y + 1 < size[1]), z),
            grid_.row(y, z - (z > 0)),
            grid_.row(y, z + (z + 1 < size[2])),
            static_cast<Real>(map_.inverse_distance(1)[y + grid_.origin[1]]),
            static_cast<Real>(map_.inverse_distance(2)[z + grid_.origin[2]])};
}

template <class T>
inline std::array<typename HitWriter<T>::Real, 3> HitWriter<T>::slope(const Stencil& around, std::int64_t x) const {
    const std::int64_t low = x - (x > 0), high = x + (x + 1 < grid_.extent.size[0]);
    return {(static_cast<Real>(around.row[high]) - static_cast<Real>(around.row[low])) *
                static_cast<Real>(map_.inverse_distance(0)[x + grid_.origin[0]]),
            (static_cast<Real>(around.y_high[x]) - static_cast<Real>(around.y_low[x])) * around.y_scale,
            (static_cast<Real>(around.z_high[x]) - static_cast<Real>(around.z_low[x])) * around.z_scale};
}

template <class T>
inline void HitWriter<T>::write_inner(const Stencil& from, std::int64_t x, const Stencil& to, std::int64_t other_x, int axis,
                                      const Vec3& start, std::int64_t point) const {
    const auto a = static_cast<double>(from.row[x]), b = static_cast<double>(to.row[other_x]);
    const double t = hit_fraction(a, b, tau_);
    Vec3 position = start;
    position[axis] += t;
    surface_.points[point] = map_.point(position);
    if (surface_.normals.empty()) return;
    const std::array<Real, 3> s = slope(from, x), e = slope(to, other_x);
    const auto u = static_cast<Real>(t);
    const std::array<Real, 3> mean{s[0] + u * (e[0] - s[0]), s[1] + u * (e[1] - s[1]), s[2] + u * (e[2] - s[2])};
    surface_.normals[point] = map_.normal(mean, axis, a > b ? 1 : -1);
}

template <class T>
void HitWriter<T>::write_border(const Vec3& position, int axis, double sign, std::int64_t point) const {
    Vec3 outside = position;
    outside[axis] += sign * kHitMargin;
    surface_.points[point] = map_.point(outside);
    if (!surface_.normals.empty()) surface_.normals[point] = map_.normal(Vec3{0, 0, 0}, axis, sign);
}

template <class T>
void HitWriter<T>::write_row(std::int64_t y, std::int64_t z, const RowPlace& place) const {
    const RowHits hits(domain_, y, z);
    const std::array<std::int64_t, 3>& size = grid_.extent.size;
    const Stencil here = stencil(y, z), next_y = stencil(y + 1, z), next_z = stencil(y, z + 1);
    const auto fy = static_cast<double>(y + grid_.origin[1]), fz = static_cast<double>(z + grid_.origin[2]);
    const std::int64_t before = grid_.origin[0] - 1;  // position p is voxel p - 1
    std::int64_t x_point = place.point, y_point = place.first_y(), z_point = place.first_z();
    hits.busy.for_each([&](std::int64_t w) {
        for_bits(w, hits.x(w), [&](std::int64_t p) {  // between the voxels p - 1 and p
            const auto fx = static_cast<double>(p + before);
            if (p == 0)
                write_border({fx + 1, fy, fz}, 0, -1, x_point++);
            else if (p == size[0])
                write_border({fx, fy, fz}, 0, 1, x_point++);
            else
                write_inner(here, p - 1, here, p, 0, {fx, fy, fz}, x_point++);
        });
        for_bits(w, hits.y(w), [&](std::int64_t p) {
            const auto fx = static_cast<double>(p + before);
            if (here.row == nullptr)
                write_border({fx, fy + 1, fz}, 1, -1, y_point++);
            else if (next_y.row == nullptr)
                write_border({fx, fy, fz}, 1, 1, y_point++);
            else
                write_inner(here, p - 1, next_y, p - 1, 1, {fx, fy, fz}, y_point++);
        });
        for_bits(w, hits.z(w), [&](std::int64_t p) {
            const auto fx = static_cast<double>(p + before);
            if (here.row == nullptr)
                write_border({fx, fy, fz + 1}, 2, -1, z_point++);
            else if (next_z.row == nullptr)
                write_border({fx, fy, fz}, 2, 1, z_point++);
            else
                write_inner(here, p - 1, next_z, p - 1, 2, {fx, fy, fz}, z_point++);
        });
    });
}

template class HitWriter<std::uint8_t>;
template class HitWriter<std::int8_t>;
template class HitWriter<std::uint16_t>;
template class HitWriter<std::int16_t>;
template class HitWriter<std::uint32_t>;
template class HitWriter<std::int32_t>;
template class HitWriter<float>;
template class HitWriter<double>;

}  // namespace isoatlas

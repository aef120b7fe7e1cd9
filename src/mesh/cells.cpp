#include "mesh/cells.h"

#include <algorithm>
#include <cmath>

#include "base/sample_types.h"
#include "critical/body_saddle.h"
#include "critical/tunnels.h"
#include "mesh/vector_cells.h"

namespace isoatlas {
namespace {

/// Twice the vector area of a closed polygon of points; zero normal means zero area.
Vec3 polygon_area(const Surface& surface, const CellLoops& loops, int loop, const std::int64_t* point) {
    const int n = loops.size(loop);
    const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
    const Vec3& origin = surface.points[point[hits[0]]];
    Vec3 area{};
    for (int i = 1; i + 1 < n; ++i) {
        const Vec3 &p = surface.points[point[hits[i]]], &q = surface.points[point[hits[i + 1]]];
        const Vec3 a{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]}, b{q[0] - origin[0], q[1] - origin[1], q[2] - origin[2]};
        area[0] += a[1] * b[2] - a[2] * b[1];
        area[1] += a[2] * b[0] - a[0] * b[2];
        area[2] += a[0] * b[1] - a[1] * b[0];
    }
    return area;
}

/// The articulation point of a loop: mean of its hits, in place and in normal.
void write_articulation_point(const CellLoops& loops, int loop, const std::int64_t* point, bool flip, std::int64_t target,
                              Surface& surface) {
    const int n = loops.size(loop);
    const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
    Vec3 position{}, normal{};
    for (int i = 0; i < n; ++i) {
        for (int axis = 0; axis < 3; ++axis) position[axis] += surface.points[point[hits[i]]][axis];
    }
    for (int axis = 0; axis < 3; ++axis) surface.points[target][axis] = position[axis] / n;
    if (!surface.contour.empty()) surface.contour[target] = surface.contour[point[hits[0]]];
    if (surface.normals.empty()) return;
    for (int i = 0; i < n; ++i) {
        for (int axis = 0; axis < 3; ++axis) normal[axis] += static_cast<double>(surface.normals[point[hits[i]]][axis]);
    }
    double length = std::hypot(normal[0], normal[1], normal[2]);
    if (!(length > 1e-6)) {  // the normals cancel: that of the loop itself
        normal = polygon_area(surface, loops, loop, point);
        length = std::hypot(normal[0], normal[1], normal[2]) * (flip ? -1 : 1);
        if (length == 0) {
            surface.normals[target] = surface.normals[point[hits[0]]];
            return;
        }
    }
    for (int axis = 0; axis < 3; ++axis) surface.normals[target][axis] = static_cast<float>(normal[axis] / length);
}

/// The first hits of the rows around a row of cells.
HitCounters first_hits(const MeshDomain& domain, const Layout& layout, std::int64_t y, std::int64_t z) {
    const RowOffsets& r00 = layout[domain.row_number(y, z)];
    const RowOffsets& r10 = layout[domain.row_number(y + 1, z)];
    const RowOffsets& r01 = layout[domain.row_number(y, z + 1)];
    const RowOffsets& r11 = layout[domain.row_number(y + 1, z + 1)];
    return {r00.point, r10.point, r01.point, r11.point, r00.first_y(), r01.first_y(), r00.first_z(), r10.first_z()};
}

}  // namespace

template <class T>
bool CellWriter<T>::has_tunnels(std::int64_t y, std::int64_t z) const {
    return tunnels_.finds_any() && y >= 0 && z >= 0 && y + 1 < extent_.size[1] && z + 1 < extent_.size[2];
}

template <class T>
auto CellWriter<T>::state_of(std::int64_t p, std::int64_t y, std::int64_t z, int pattern, bool has_tunnels) const -> State {
    const CellCaseTables& cases = cell_cases();
    State state{pattern, 0, cases.first_case[pattern], std::nullopt};
    if (const int split = cases.split_faces[pattern]; split != 0) {
        state.joined = joiner_.joined_mask({p - 1, y, z}, pattern, split);
        state.number = cases.case_of(pattern, state.joined);
    }
    if (has_tunnels && p > 0 && p < extent_.size[0]) state.tunnel = tunnels_({p - 1, y, z}, pattern, state.joined);
    return state;
}

template <class T>
auto CellWriter<T>::state_again(std::int64_t p, std::int64_t y, std::int64_t z, int pattern, std::uint8_t found) const -> State {
    State state{pattern, found & (kHasTunnel - 1), 0, std::nullopt};
    state.number = cell_cases().case_of(pattern, state.joined);
    if ((found & kHasTunnel) != 0) state.tunnel = tunnels_({p - 1, y, z}, pattern, state.joined);
    return state;
}

template <class T>
auto CellWriter<T>::size_of(const State& state) const -> Size {
    if (!state.tunnel) return {triangles_[state.number].triangles, triangles_[state.number].articulation_points};
    const TunnelCell cell = tunnel_cell(state.pattern, state.joined, *state.tunnel, style_);
    return {cell.triangles, cell.points()};
}

template <class T>
void CellWriter<T>::count_row(std::int64_t y, std::int64_t z, RowOffsets& place, std::vector<std::uint8_t>& found) const {
    const bool tunnels = has_tunnels(y, z);
    const auto count_rest = [&](std::int64_t p, int pattern) {
        const State state = state_of(p, y, z, pattern, tunnels);
        found.push_back(static_cast<std::uint8_t>(state.joined | (state.tunnel ? kHasTunnel : 0)));
        const Size size = size_of(state);
        place.triangle += size.triangles;
        place.articulation_points += static_cast<std::uint32_t>(size.points);
    };
    count_plain_cells(cell_row(domain_.high, y, z), domain_.cells, plain_, place, count_rest);
}

// The slope of the interpolant itself: inside a tunnel it has little to do with differences between voxels.
template <class T>
std::array<float, 3> CellWriter<T>::normal_at(const std::array<double, 8>& value, const Index3& voxel, const Vec3& position) const {
    const Vec3 corner{static_cast<double>(voxel[0]), static_cast<double>(voxel[1]), static_cast<double>(voxel[2])};
    const Vec3 origin = map_.point(corner);
    std::array<double, 8> above = value;  // what all samples have in common must not cost digits
    for (double& v : above) v -= value[0];
    Vec3 slope{};
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 low = position, high = position, next = corner;
        low[axis] = 0, high[axis] = 1, next[axis] += 1;
        const Vec3 step = map_.point(next);
        slope[axis] = (interpolate(above, high) - interpolate(above, low)) /
                      std::hypot(step[0] - origin[0], step[1] - origin[1], step[2] - origin[2]);
    }
    return map_.normal(slope, 0, 1);
}

template <class T>
void CellWriter<T>::write_points(const State& state, const TunnelCell& cell, const Index3& voxel, std::int64_t next, std::int64_t* point,
                                 Surface& surface) const {
    const std::array<double, 8> value = tunnels_.values(voxel);
    const Index3 corner = voxel + origin_;
    const std::array<Vec3, 6> ring = ring_points(cell, *state.tunnel, state.pattern, state.joined, value, joiner_.tau);
    for (int i = 0; i < cell.ring_points; ++i) {
        const std::int64_t target = point[12 + i] = next++;
        Vec3 position = ring[i];
        if (!surface.normals.empty()) surface.normals[target] = normal_at(value, corner, position);
        for (int axis = 0; axis < 3; ++axis) position[axis] += static_cast<double>(corner[axis]);
        surface.points[target] = map_.point(position);
        if (!surface.contour.empty()) surface.contour[target] = surface.contour[point[cell.hit]];
    }
    for (int articulation = 0; articulation < cell.articulation_points; ++articulation) {
        const std::int64_t target = point[12 + cell.ring_points + articulation] = next++;
        write_articulation_point(cell_cases().loops[state.number], cell.articulation_loop[articulation], point, flip_, target, surface);
    }
}

template <class T>
void CellWriter<T>::write_row(std::int64_t y, std::int64_t z, const Layout& layout, const std::uint8_t*& found, Surface& surface) const {
    const std::int64_t row = domain_.row_number(y, z);
    const RowOffsets& place = layout[row];
    if (layout[row + 1].triangle == place.triangle) return;
    std::int64_t articulation_point = place.first_articulation_point();
    const auto write_rest = [&](std::int64_t p, int pattern, const HitCounters& before, const HitCounters& after,
                                std::array<std::int64_t, 3>*& triangle) {
        std::array<std::int64_t, 20> point;
        std::ranges::copy(points_of(before, after), point.begin());
        write_cell(state_again(p, y, z, pattern, *found++), {p - 1, y, z}, point.data(), articulation_point, triangle, surface);
    };
    std::array<std::int64_t, 3>* const triangles = surface.triangles.data();
    CellRow<4> cells = cell_row(domain_.high, y, z);
    cells.candidates = words_of(domain_.high, place.cell_words, cells.candidates);
    write_plain_cells(cells, domain_.cells, plain_, first_hits(domain_, layout, y, z), triangles + place.triangle,
                      triangles + layout[row + 1].triangle, write_rest);
}

template <class T>
void CellWriter<T>::write_cell(const State& state, const Index3& voxel, std::int64_t* point, std::int64_t& next_point,
                               std::array<std::int64_t, 3>*& triangle, Surface& surface) const {
    const int second = flip_ ? 2 : 1, third = flip_ ? 1 : 2;
    const auto write_triangles = [&](const std::uint8_t* vertex, int count) {
        for (int i = 0; i < count; ++i, vertex += 3) *triangle++ = {point[vertex[0]], point[vertex[second]], point[vertex[third]]};
    };
    if (state.tunnel) {
        const TunnelCell cell = tunnel_cell(state.pattern, state.joined, *state.tunnel, style_);
        write_points(state, cell, voxel, next_point, point, surface);
        next_point += cell.points();
        write_triangles(cell.corner.data(), cell.triangles);
        return;
    }
    const CellTriangles& cell = triangles_[state.number];
    for (int articulation = 0; articulation < cell.articulation_points; ++articulation) {
        point[12 + articulation] = next_point;
        write_articulation_point(cell_cases().loops[state.number], cell.articulation_loop[articulation], point, flip_, next_point++,
                                 surface);
    }
    write_triangles(cell.corner.data(), cell.triangles);
}

#define ISOATLAS_INSTANTIATE(T) template class CellWriter<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas

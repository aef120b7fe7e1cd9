#include "mesh/cells.h"

#include <cmath>

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
void write_fan_point(const CellLoops& loops, int loop, const std::int64_t* point, bool flip, std::int64_t target, Surface& surface) {
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

}  // namespace

template <class T>
void CellWriter<T>::count_row(std::int64_t y, std::int64_t z, RowPlace& place) const {
    const CellCaseTables& cases = cell_cases();
    const std::int64_t corner = extent_.index(-1, y, z);
    for_active_cells(cell_row(domain_.high, y, z), domain_.high.words(), domain_.cells, [&](std::int64_t p, int pattern) {
        const CellTriangles& cell = triangles_[case_of(cases, corner + p, pattern)];
        place.triangle += cell.triangles;
        place.fans += cell.fans;
    });
}

template <class T>
void CellWriter<T>::write_row(std::int64_t y, std::int64_t z, const Layout& layout, Surface& surface) const {
    const std::int64_t row = domain_.row_number(y, z);
    const RowPlace& place = layout[row];
    if (layout[row + 1].triangle == place.triangle) return;
    const CellCaseTables& cases = cell_cases();
    const std::int64_t corner = extent_.index(-1, y, z);
    HitCursor cursor(domain_, layout, y, z);
    std::array<std::int64_t, 3>* triangle = surface.triangles.data() + place.triangle;
    std::int64_t fan_point = place.first_fan();
    const int second = flip_ ? 2 : 1, third = flip_ ? 1 : 2;
    for_active_cells(cell_row(domain_.high, y, z), domain_.high.words(), domain_.cells, [&](std::int64_t p, int pattern) {
        const int number = case_of(cases, corner + p, pattern);
        const CellTriangles& cell = triangles_[number];
        std::int64_t point[16];
        cursor.points_of(cases.hit_edges[pattern], point);
        for (int fan = 0; fan < cell.fans; ++fan) {
            point[12 + fan] = fan_point;
            write_fan_point(cases.loops[number], cell.fan_loop[fan], point, flip_, fan_point++, surface);
        }
        const std::uint8_t* vertex = cell.corner.data();
        for (int i = 0; i < cell.triangles; ++i, vertex += 3) {
            *triangle++ = {point[vertex[0]], point[vertex[second]], point[vertex[third]]};
        }
    });
}

template class CellWriter<std::uint8_t>;
template class CellWriter<std::int8_t>;
template class CellWriter<std::uint16_t>;
template class CellWriter<std::int16_t>;
template class CellWriter<std::uint32_t>;
template class CellWriter<std::int32_t>;
template class CellWriter<float>;
template class CellWriter<double>;

}  // namespace isoatlas

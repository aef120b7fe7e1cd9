#include "persistence/descending_disk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include "base/check.h"
#include "base/sample_types.h"
#include "critical/cell_paths.h"

namespace isoatlas {

template <class T>
struct DescendingDisks<T>::Cell {
    CellElements elements;
    CellBodies bodies;
    unsigned types;  ///< bit f: face f is of type H

    [[nodiscard]] std::array<int, 2> highs(int f) const {
        const int first = elements.bd_high >> f & 1 ? 1 : 0;
        return {kFaceCorners[f][first], kFaceCorners[f][first + 2]};
    }
    [[nodiscard]] std::int64_t number() const { return elements.voxel[0]; }
    [[nodiscard]] std::int64_t face_number(int f) const { return 3 * elements.voxel[kFaceCorners[f][0]] + f / 2; }
    [[nodiscard]] Edge edge_of_face(int f, int corner) const {
        const double s = elements.face_value[f];
        std::int64_t second = -1;
        for (const int k : kFaceCorners[f]) {
            if (k != highs(f)[0] && k != highs(f)[1] && elements.value[k] == s) second = std::max(second, 2 * elements.voxel[k] + 1);
        }
        return {s, second, face_number(f), 4 * face_number(f) + 1, 4 * elements.voxel[corner]};
    }
    [[nodiscard]] Edge edge_of_body(int corner) const {
        return {bodies.opening->value, -2, number(), 4 * number() + 2, 4 * elements.voxel[corner]};
    }
};

template <class T>
bool DescendingDisks<T>::is_above(std::int64_t voxel, std::int64_t other) const {
    return std::tuple(grid_.samples[voxel], voxel) > std::tuple(grid_.samples[other], other);
}

/// Neighbours above, two for each axis (the one before, the one behind); -1: below or outside.
template <class T>
std::array<std::int64_t, 6> DescendingDisks<T>::ups(std::int64_t voxel) const {
    std::array<std::int64_t, 6> above;
    above.fill(-1);
    const Index3 at = grid_.extent.voxel(voxel);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t before = voxel - steps_.axis[axis], behind = voxel + steps_.axis[axis];
        if (at[axis] > 0 && is_above(before, voxel)) above[2 * axis] = before;
        if (at[axis] + 1 < grid_.extent.size[axis] && is_above(behind, voxel)) above[2 * axis + 1] = behind;
    }
    return above;
}

template <class T>
typename DescendingDisks<T>::Cell DescendingDisks<T>::cell_at(std::int64_t corner) const {
    Cell cell{};
    for (int k = 0; k < 8; ++k) {
        cell.elements.voxel[k] = steps_.cell_corner(corner, k);
        cell.elements.value[k] = static_cast<double>(grid_.samples[cell.elements.voxel[k]]);
    }
    find_ambiguous_faces(cell.elements);
    cell.types = default_face_types(cell.elements);
    if (std::isfinite(tunnel_height_)) cell.bodies = bodies_of_cell(cell.elements, cell.types, tunnel_height_);
    cell.types ^= cell.bodies.exceptional;
    return cell;
}

/// The cells that share a face, and the face in each.
template <class T>
std::vector<typename DescendingDisks<T>::Cell> DescendingDisks<T>::cells_at(std::int64_t face, std::array<int, 2>& side) const {
    const auto orientation = static_cast<int>(face % 3);
    const auto normal = static_cast<std::size_t>(kFaceAxes[orientation].normal);
    const std::int64_t z = grid_.extent.voxel(face / 3)[normal];
    std::vector<Cell> cells;
    if (z > 0) side[cells.size()] = 2 * orientation + 1, cells.push_back(cell_at(face / 3 - steps_.axis[normal]));
    if (z + 1 < grid_.extent.size[normal]) side[cells.size()] = 2 * orientation, cells.push_back(cell_at(face / 3));
    return cells;
}

template <class T>
void DescendingDisks<T>::put_grid_edge(std::int64_t v, std::int64_t w, Chain& chain) const {
    if (is_above(v, w)) std::swap(v, w);
    chain.push({static_cast<double>(grid_.samples[v]) + 0.0, 2 * v, 0, 4 * v, 4 * w});
}

/// From one neighbour above u to another on a different axis: around the face of the three.
template <class T>
void DescendingDisks<T>::put_around_face(std::int64_t u, std::size_t from, std::size_t to, Chain& chain) const {
    const auto neighbour = [&](std::size_t direction) { return u + (direction % 2 == 0 ? -1 : 1) * steps_.axis[direction / 2]; };
    const std::int64_t v = neighbour(from), w = neighbour(to), opposite = v + w - u;
    if (is_above(opposite, u)) {
        put_grid_edge(v, opposite, chain);
        put_grid_edge(opposite, w, chain);
        return;
    }
    const std::int64_t corner = std::min({u, v, w, opposite});
    const auto orientation = static_cast<std::int64_t>(from / 2 + to / 2) - 1;  // axes 0 1, 0 2, 1 2
    const bool bd_high = corner == u || corner == opposite;
    const std::int64_t face = 3 * corner + orientation;
    const auto value = [&](int i) { return static_cast<double>(grid_.samples[steps_.face_voxel(face, i)]); };
    const double s = disambiguation_value(value(0), value(1), value(2), value(3), bd_high ? Diagonal::bd : Diagonal::ac);
    std::int64_t second = -1;
    for (const std::int64_t low : {u, opposite}) {
        if (static_cast<double>(grid_.samples[low]) == s) second = std::max(second, 2 * low + 1);
    }
    for (const std::int64_t high : {v, w}) chain.push({s + 0.0, second, face, 4 * face + 1, 4 * high});
}

/// Elements of a cell one after the other (critical/cell_paths.h).
template <class T>
void DescendingDisks<T>::put_path(const Cell& cell, const std::vector<int>& path, Chain& chain) const {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const int p = path[i], q = path[i + 1];
        if (p < 8 && q < 8) {
            put_grid_edge(cell.elements.voxel[p], cell.elements.voxel[q], chain);
        } else {
            chain.push(cell.edge_of_face(std::max(p, q) - 8, std::min(p, q)));
        }
    }
}

template <class T>
void DescendingDisks<T>::put_face_edges(const Cell& cell, int f, Chain& chain) const {
    for (const int corner : cell.highs(f)) chain.push(cell.edge_of_face(f, corner));
}

/// The loop around the tunnel of Lows of a cell.
template <class T>
void DescendingDisks<T>::put_ring(const Cell& cell, Chain& chain) const {
    const int f = cell.bodies.closing->face;
    put_face_edges(cell, f, chain);
    put_path(cell, path_above_face(cell.elements, f, cell.highs(f)[0], cell.highs(f)[1]), chain);
}

/// How the Highs of a face are joined above it in a cell; false: they are not.
template <class T>
bool DescendingDisks<T>::put_join(const Cell& cell, int f, Chain& chain) const {
    if ((cell.types >> f & 1) == 0) return false;
    const auto [a, c] = cell.highs(f);
    if (const auto& body = cell.bodies.opening; body && body->face == f) {  // through the interior
        std::vector<int> from_a = path_above_face(cell.elements, f, a, body->region_a);
        const bool turned = from_a.empty();
        if (turned) from_a = path_above_face(cell.elements, f, a, body->region_b);
        const std::vector<int> to_c = path_above_face(cell.elements, f, turned ? body->region_a : body->region_b, c);
        ISOATLAS_CHECK(!from_a.empty() && !to_c.empty());
        put_path(cell, from_a, chain);
        put_path(cell, to_c, chain);
        for (const int corner : {body->region_a, body->region_b}) chain.push(cell.edge_of_body(corner));
        return true;
    }
    // While a tunnel of Lows is open no face is of type H (tests/unit/critical/bodies_test.cpp), so any way is as good.
    const std::vector<int> path = path_above_face(cell.elements, f, a, c);
    ISOATLAS_CHECK(!path.empty());
    put_path(cell, path, chain);
    return true;
}

template <class T>
void DescendingDisks<T>::add(ElementCode death, Chain& chain) const {
    if (death.kind() == CodeKind::vertex) {
        const std::int64_t u = death.index();
        const std::size_t first = death.axis() == 0 ? 2 : 0, second = death.axis() == 2 ? 2 : 4;  // directions of the axes above
        for (const std::size_t i : {0, 1}) {
            for (const std::size_t j : {0, 1}) put_around_face(u, first + i, second + j, chain);
        }
    } else if (death.kind() == CodeKind::face) {
        std::array<int, 2> side{};
        const std::vector<Cell> cells = cells_at(death.index(), side);
        bool joined = cells.size() == 2;
        for (std::size_t i = 0; i < cells.size(); ++i) joined = put_join(cells[i], side[i], chain) && joined;
        ISOATLAS_CHECK(joined);
    } else {
        const Cell cell = cell_at(death.cell());
        ISOATLAS_CHECK(cell.bodies.closing.has_value());
        put_ring(cell, chain);
    }
}

template <class T>
bool DescendingDisks<T>::replace_vertex_edge(const Edge& edge, Chain& chain) const {
    const std::int64_t u = edge.low / 4;
    const std::array<std::int64_t, 6> up = ups(u);
    const auto direction = static_cast<std::size_t>(std::ranges::find(up, edge.high / 4) - up.begin());
    std::array<std::size_t, 3> first;  // upward directions, one for each axis that has one; axes that have one alone before the others
    std::size_t count = 0;
    for (const bool two : {false, true}) {
        for (std::size_t d = 0; d < 6; d += 2) {
            const bool before = up[d] >= 0, behind = up[d + 1] >= 0;
            if ((before || behind) && (before && behind) == two) first[count++] = before ? d : d + 1;
        }
    }
    const std::size_t pushed = first[0];
    if (direction == pushed) return false;
    if (direction / 2 != pushed / 2) {
        put_around_face(u, pushed, direction, chain);
        return false;
    }
    if (count == 1) return true;
    put_around_face(u, pushed, first[1], chain);
    put_around_face(u, first[1], direction, chain);
    return false;
}

template <class T>
bool DescendingDisks<T>::replace_face_edge(const Edge& edge, Chain& chain) const {
    std::array<int, 2> side{};
    const std::vector<Cell> cells = cells_at(edge.low / 4, side);
    if (cells.empty()) {                         // a volume of one slice
        const std::int64_t face = edge.low / 4;  // a and b are the first corners of the diagonals
        const bool is_first = edge.high / 4 == steps_.face_voxel(face, 0) || edge.high / 4 == steps_.face_voxel(face, 1);
        return !is_first;
    }
    if (edge.high / 4 == cells[0].elements.voxel[cells[0].highs(side[0])[0]]) return false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (put_join(cells[i], side[i], chain)) return false;
    }
    return true;
}

template <class T>
bool DescendingDisks<T>::is_opened_by_body(const Edge& edge) const {
    const Cell cell = cell_at(edge.low / 4);
    return edge.high / 4 != cell.elements.voxel[cell.bodies.opening->region_a];
}

template <class T>
std::optional<ElementPlace> DescendingDisks<T>::next(Chain& chain) const {
    while (!chain.empty()) {
        const Edge edge = chain.top();
        bool odd = false;
        for (; !chain.empty() && chain.top() == edge; chain.pop()) odd = !odd;
        if (!odd) continue;
        const int kind = static_cast<int>(edge.low & 3);
        const bool is_opened = kind == 0   ? replace_vertex_edge(edge, chain)
                               : kind == 1 ? replace_face_edge(edge, chain)
                                           : is_opened_by_body(edge);
        if (is_opened) return edge.low;
    }
    return std::nullopt;
}

#define ISOATLAS_INSTANTIATE(T) template class DescendingDisks<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas

#include "mesh/tunnel_cell.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "critical/body_saddle.h"
#include "mesh/place_hits.h"

namespace isoatlas {
namespace {

/// Corners of a face, counter-clockwise seen from outside the cell.
std::array<int, 4> turning_left(int f) {
    std::array<int, 4> corner = kFaceCorners[f];
    const bool axes_turn_left = f / 2 != 1;  // xy and yz, seen from the end of the normal axis; xz turns right
    if (axes_turn_left != ((f & 1) == 1)) std::swap(corner[1], corner[3]);
    return corner;
}

/// Which triangles span the annulus, corner by corner.
class RingWriter {
public:
    RingWriter(int pattern, int joined, const OpenTunnel& tunnel, TunnelCell& cell)
        : pattern_(pattern), joined_(joined), tunnel_(tunnel), cell_(cell) {
        for (int k = 0; k < 8; ++k) {
            if (!in_ring(k)) continue;
            ISOATLAS_CHECK(cell.ring_points < cell.ring_corner.size());
            point_[k] = 12 + cell.ring_points;
            cell.ring_corner[cell.ring_points++] = static_cast<std::uint8_t>(k);
        }
    }

    void add_face(int f) {
        const std::array<int, 4> corner = turning_left(f);
        const auto at = [&](int i) { return corner[i & 3]; };
        const auto hit = [&](int i) { return edge_between(at(i), at(i + 1)); };
        const int here = static_cast<int>(std::ranges::count_if(corner, [&](int k) { return in_ring(k); }));
        if (here == 0) return;
        if (here == 4) return add_polygon({point_[at(0)], point_[at(1)], point_[at(2)], point_[at(3)]}, 4);
        if (face_is_split(pattern_, f)) {
            const bool ring_joined = ((joined_ >> f & 1) != 0) != tunnel_.joins_highs;
            for (int i = 0; i < 4; ++i) {
                if (!in_ring(at(i))) continue;
                if (ring_joined) return add_polygon({point_[at(i)], hit(i), hit(i + 1), point_[at(i + 2)], hit(i + 2), hit(i + 3)}, 6);
                add_polygon({point_[at(i)], hit(i), hit(i + 3)}, 3);
            }
            return;
        }
        int first = 0;  // of the chain of ring corners
        while (!in_ring(at(first)) || in_ring(at(first + 3))) ++first;
        std::array<int, 6> polygon{};
        int size = 0;
        for (; size < here; ++size) polygon[size] = point_[at(first + size)];
        polygon[size++] = hit(first + here - 1);
        polygon[size++] = hit(first + 3);
        add_polygon(polygon, size);
    }

    void add_triangle(int a, int b, int c) {
        ISOATLAS_CHECK(3 * cell_.triangles < static_cast<int>(cell_.corner.size()));
        std::uint8_t* corner = cell_.corner.data() + 3 * cell_.triangles++;
        corner[0] = static_cast<std::uint8_t>(a);
        corner[1] = static_cast<std::uint8_t>(b);
        corner[2] = static_cast<std::uint8_t>(c);
    }

private:
    [[nodiscard]] bool in_ring(int k) const { return tunnel_.ring >> k & 1; }

    /// A polygon that turns left seen from outside; the ring is outside, and Low when the tunnel joins Highs.
    void add_polygon(const std::array<int, 6>& polygon, int size) {
        for (int i = 1; i + 1 < size; ++i) {
            const int second = polygon[tunnel_.joins_highs ? i : i + 1], third = polygon[tunnel_.joins_highs ? i + 1 : i];
            add_triangle(polygon[0], second, third);
        }
    }

    int pattern_, joined_;
    const OpenTunnel& tunnel_;
    TunnelCell& cell_;
    std::array<int, 8> point_{};
};

/// Does a loop of the cell bound the annulus?
bool bounds_tunnel(const CellLoops& loops, int loop, int pattern, const OpenTunnel& tunnel) {
    const std::array<int, 2>& ends = kEdgeCorners[loops.edge[loops.begin[loop]]];
    const bool first_is_high = pattern >> ends[0] & 1;
    const int joined_end = ends[first_is_high == tunnel.joins_highs ? 0 : 1], ring_end = ends[first_is_high == tunnel.joins_highs ? 1 : 0];
    return ((tunnel.a | tunnel.b) >> joined_end & 1) != 0 && (tunnel.ring >> ring_end & 1) != 0;
}

/// Does a point lie in the corner that a loop of three hits cuts off?
bool is_cut_off(const Vec3& point, const CellLoops& loops, int loop, const std::array<double, 8>& value, double tau) {
    const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
    int corner = 0;
    while (std::any_of(hits, hits + 3, [&](int e) { return kEdgeCorners[e][0] != corner && kEdgeCorners[e][1] != corner; })) ++corner;
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        sum += std::abs(point[axis] - (corner >> axis & 1)) / hit_fraction(value[corner], value[corner ^ 1 << axis], tau);
    }
    return sum <= 1;
}

}  // namespace

TunnelCell tunnel_cell(int pattern, int joined, const OpenTunnel& tunnel, SurfaceStyle style) {
    TunnelCell cell;
    RingWriter ring(pattern, joined, tunnel, cell);
    for (int f = 0; f < 6; ++f) ring.add_face(f);
    const CellLoops& loops = cell_loops(pattern, joined);
    int bounds = 0;
    for (int loop = 0; loop < loops.count; ++loop) {
        const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
        if (bounds_tunnel(loops, loop, pattern, tunnel)) {
            ++bounds;
            cell.hit = hits[0];
            continue;
        }
        ISOATLAS_CHECK(loops.size(loop) == 3);  // only in case 13.5
        if (style == SurfaceStyle::compact) {
            ring.add_triangle(hits[0], hits[1], hits[2]);
            continue;
        }
        const int point = 12 + cell.ring_points + cell.articulation_points;
        cell.articulation_loop[cell.articulation_points++] = static_cast<std::uint8_t>(loop);
        for (int i = 0; i < 3; ++i) ring.add_triangle(point, hits[i], hits[(i + 1) % 3]);
    }
    ISOATLAS_CHECK(bounds == 2);
    return cell;
}

std::array<Vec3, 6> ring_points(const TunnelCell& cell, const OpenTunnel& tunnel, int pattern, int joined,
                                const std::array<double, 8>& value, double tau) {
    Vec3 centre;
    for (int axis = 0; axis < 3; ++axis) centre[axis] = std::clamp(tunnel.body[axis], 0.05, 0.95);
    const CellLoops& loops = cell_loops(pattern, joined);
    for (int loop = 0; loop < loops.count; ++loop) {
        const bool beside = loops.size(loop) == 3 && !bounds_tunnel(loops, loop, pattern, tunnel);
        if (beside && is_cut_off(centre, loops, loop, value, tau)) centre = {0.5, 0.5, 0.5};
    }
    std::array<double, 8> above = value;  // what all samples have in common must not cost digits
    for (double& v : above) v -= tau;
    std::array<Vec3, 6> points{};
    for (int i = 0; i < cell.ring_points; ++i) {
        const int k = cell.ring_corner[i];
        const auto along = [&](double r) {
            Vec3 point;
            for (int axis = 0; axis < 3; ++axis) point[axis] = centre[axis] + r * ((k >> axis & 1) - centre[axis]);
            return point;
        };
        double inside = 0, outside = 1;
        for (int step = 0; step < 30; ++step) {
            const double r = (inside + outside) / 2;
            const bool is_high = interpolate(above, along(r)) >= 0;
            (is_high == tunnel.joins_highs ? inside : outside) = r;
        }
        points[i] = along(std::clamp(outside, 0.03, 0.97));
    }
    return points;
}

}  // namespace isoatlas

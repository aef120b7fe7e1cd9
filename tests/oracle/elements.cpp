// Elements and their total order (docs/theory/1-elements-and-order.md#the-total-order), written from the text.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "oracle/oracle.h"
#include "oracle/rational.h"

namespace oracle {

bool Grid::contains(const std::array<Index, 3>& p) const {
    return p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && p[0] < size[0] && p[1] < size[1] && p[2] < size[2];
}

Index Grid::neighbour(Index v, int d) const {
    std::array<Index, 3> p = voxel(v);
    p[d / 2] += d % 2 == 0 ? -1 : 1;
    return contains(p) ? index(p[0], p[1], p[2]) : -1;
}

namespace {

constexpr int kAxis1[3] = {0, 0, 1}, kAxis2[3] = {1, 2, 2};  // xy, xz, yz

std::tuple<double, double, double> key(const Element& e) { return {e.value, e.tie[0], e.tie[1]}; }

/// The greatest double at most (ac - bd) / (a + c - b - d); of four equal corners: their value.
double bilinear_saddle(double a, double b, double c, double d) {
    if (a == b && b == c && c == d) return a + 0.0;
    const Rational p(a), q(b), r(c), s(d);
    return greatest_double_at_most((p * r - q * s) / (p + r - q - s));
}

Element make_vertex(const Grid& grid, Index v) {
    const std::array<Index, 3> p = grid.voxel(v);
    Element e;
    e.value = grid.value[v] + 0.0;  // -0 is reported as 0
    e.tie = {static_cast<double>(v), 0};
    e.position = {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
    return e;
}

/// The face with corner a and an orientation; false when it is not in the grid or not ambiguous.
bool make_face(const Grid& grid, const std::vector<Element>& vertex, Index a, int orientation, Element& e) {
    const int axis1 = kAxis1[orientation], axis2 = kAxis2[orientation];
    const Index b = grid.neighbour(a, 2 * axis1 + 1), d = grid.neighbour(a, 2 * axis2 + 1);
    if (b < 0 || d < 0) return false;
    const Index c = grid.neighbour(b, 2 * axis2 + 1);
    const auto above = [&vertex](Index p, Index q) { return key(vertex[p]) > key(vertex[q]); };
    const bool ac_high = above(a, b) && above(a, d) && above(c, b) && above(c, d);
    const bool bd_high = above(b, a) && above(b, c) && above(d, a) && above(d, c);
    if (!ac_high && !bd_high) return false;
    e.type = Type::face;
    e.corner = {a, b, c, d};
    e.high = ac_high ? std::array<Index, 2>{a, c} : std::array<Index, 2>{b, d};
    e.low = ac_high ? std::array<Index, 2>{b, d} : std::array<Index, 2>{a, c};
    const Index highest_low = above(e.low[0], e.low[1]) ? e.low[0] : e.low[1];
    e.value = bilinear_saddle(grid.value[a], grid.value[b], grid.value[c], grid.value[d]);
    e.tie = {e.value > grid.value[highest_low] ? -1.0 : static_cast<double>(highest_low) + 0.5, static_cast<double>(3 * a + orientation)};
    e.position = vertex[a].position;
    e.position[axis1] += 0.5;
    e.position[axis2] += 0.5;
    return true;
}

/// The element of a face of a cell.
Index face_of_cell(const Elements& elements, Index cell, int face) {
    const int orientation = face / 2, normal = 2 - orientation;
    const Index corner = face % 2 == 0 ? cell : elements.grid.neighbour(cell, 2 * normal + 1);
    return elements.face_at[3 * corner + orientation];
}

Element make_body(const Elements& elements, const Body& body) {
    Element e;
    e.type = Type::body;
    e.value = body.value + 0.0;
    e.tie = {body.joins_highs ? -2.0 : kInfinity, static_cast<double>(body.cell)};
    e.position = elements.all[body.cell].position;
    for (double& x : e.position) x += 0.5;
    e.cell = body.cell;
    e.face = face_of_cell(elements, body.cell, body.face);
    e.joins_highs = body.joins_highs;
    const Element& face = elements.all[e.face];
    e.ring = body.joins_highs ? face.low : face.high;
    const Index cut = elements.rank_of[e.face] + (body.joins_highs ? 1 : 0);  // where F does not join them yet
    for (const Index corner : body.joins_highs ? face.high : face.low) {
        for (const Index v : elements.region(body.cell, corner, cut)) e.tunnel.push_back(v);
    }
    return e;
}

}  // namespace

bool Elements::is_open(Index body, Index cut) const {
    const Element& e = all[body];
    return is_high(body, cut) == e.joins_highs && is_high(e.face, cut) != e.joins_highs;
}

std::vector<Index> Elements::region(Index cell, Index corner, Index cut) const {
    const std::array<Index, 3> base = grid.voxel(cell);
    const auto is_corner = [&](Index v) {
        const std::array<Index, 3> p = grid.voxel(v);
        for (int axis = 0; axis < 3; ++axis) {
            if (p[axis] != base[axis] && p[axis] != base[axis] + 1) return false;
        }
        return true;
    };
    std::vector<Index> found{corner};
    const auto add = [&](Index v) {
        if (v >= 0 && is_corner(v) && is_high(v, cut) == is_high(corner, cut) && std::find(found.begin(), found.end(), v) == found.end())
            found.push_back(v);
    };
    for (std::size_t next = 0; next < found.size(); ++next) {
        const Index v = found[next];
        for (int d = 0; d < grid.directions(); ++d) add(grid.neighbour(v, d));
        for (int f = 0; f < 6; ++f) {
            const Index face = face_of_cell(*this, cell, f);
            if (face < 0 || is_high(face, cut) != is_high(corner, cut)) continue;
            const std::array<Index, 4>& corners = all[face].corner;
            if (std::find(corners.begin(), corners.end(), v) == corners.end()) continue;
            for (const Index w : corners) add(w);
        }
    }
    return found;
}

std::vector<std::pair<Index, Index>> Elements::edges_at_tunnel(Index body, Index cut) const {
    const Element& e = all[body];
    std::vector<std::pair<Index, Index>> edges;
    if (is_high(e.ring[0], cut) == e.joins_highs) return edges;
    for (const Index around : region(e.cell, e.ring[0], cut)) {
        for (int d = 0; d < grid.directions(); ++d) {
            const Index v = grid.neighbour(around, d);
            if (std::find(e.tunnel.begin(), e.tunnel.end(), v) == e.tunnel.end() || is_high(v, cut) != e.joins_highs) continue;
            edges.emplace_back(e.joins_highs ? v : around, e.joins_highs ? around : v);
        }
    }
    return edges;
}

Elements::Elements(Grid g, const std::vector<Body>& bodies) : grid(std::move(g)) {
    const Index voxels = grid.voxels();
    for (Index v = 0; v < voxels; ++v) all.push_back(make_vertex(grid, v));
    face_at.assign(static_cast<std::size_t>(3 * voxels), -1);
    std::vector<Element> faces;
    for (Index v = 0; v < voxels; ++v) {
        for (int orientation = 0; orientation < (grid.rank == 2 ? 1 : 3); ++orientation) {
            Element face;
            if (!make_face(grid, all, v, orientation, face)) continue;
            face_at[3 * v + orientation] = voxels + static_cast<Index>(faces.size());
            faces.push_back(face);
        }
    }
    all.insert(all.end(), faces.begin(), faces.end());
    sort();
    for (const Body& body : bodies) all.push_back(make_body(*this, body));  // what it joins: with the ranks of vertices and faces
    sort();
}

void Elements::sort() {
    by_rank.resize(all.size());
    for (Index e = 0; e < count(); ++e) by_rank[e] = e;
    std::sort(by_rank.begin(), by_rank.end(), [this](Index p, Index q) { return key(all[p]) < key(all[q]); });
    rank_of.resize(all.size());
    for (Index r = 0; r < count(); ++r) rank_of[by_rank[r]] = r;
}

Index Elements::cut_at(double tau) const {
    Index cut = 0;
    while (cut < count() && all[by_rank[cut]].value < tau) ++cut;
    return cut;
}

}  // namespace oracle

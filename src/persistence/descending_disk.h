// Descending disk of an element that fills a hole, followed upwards to the elements that opened it.
//
// A (1,2) element that fills a hole adds a disk to the Highs; its rim is a loop of edges of the graph G
// (docs/theory/1-elements-and-order.md#objects-low-components-contours) just above the element.
// An edge is homologous, by its lower end, to:
//   vertex       0 for one of its upward edges (the vertex can be pushed along it). Another one spans a face with the first: the path
//                around that face, over the opposite corner or the face point. At a (2,1) vertex the second upward edge is what it opens.
//   face point   0 for one of its two edges to Highs; the other: the path that joins them above it in a cell where it is of type H; in no
//                such cell: what the face point opens.
//   body point   B1 is what it opens.
// All of these chains lie above the lower end of the edge, so the lowest edge can always be replaced, mod 2, until only what was opened is
// left: the boundary of the disk in the Morse complex. Source: Forman 1998, for the gradient; docs/decisions/0018.
//
// In the literature: the descending manifold of a critical 2-cell and the boundary operator of the Morse complex mod 2 (Forman, Morse
// theory for cell complexes, 1998; Robins, Wood, Sheppard 2011).
#pragma once

#include <vector>

#include "critical/bodies.h"
#include "critical/faces.h"

namespace isoatlas {

/// An element by where it is: 4 * voxel, 4 * face number + 1, or 4 * cell + 2 (body points).
using ElementPlace = std::int64_t;
[[nodiscard]] constexpr ElementPlace place_of(ElementCode code) {
    if (code.kind() == CodeKind::vertex) return 4 * code.index();
    return code.is_body() ? 4 * code.cell() + 2 : 4 * code.index() + 1;
}

template <class T>
class DescendingDisks {
public:
    /// tunnel_height: of tunnel_height_of (critical/bodies.h).
    DescendingDisks(const GridView<T>& grid, double tunnel_height) : grid_(grid), steps_(grid.extent), tunnel_height_(tunnel_height) {}

    /// Places of the (2,1) elements that the disk of a (1,2) element ends at an odd number of times, ascending; those that merge objects
    /// too. Cost: O(e log e) for a disk that meets e edges.
    [[nodiscard]] std::vector<ElementPlace> boundary(ElementCode death) const;

private:
    struct Edge;
    struct Chain;
    struct Cell;

    [[nodiscard]] bool is_above(std::int64_t voxel, std::int64_t other) const;
    [[nodiscard]] std::array<std::int64_t, 6> ups(std::int64_t voxel) const;
    [[nodiscard]] Cell cell_at(std::int64_t corner) const;
    [[nodiscard]] std::vector<Cell> cells_at(std::int64_t face, std::array<int, 2>& side) const;

    void put_grid_edge(std::int64_t v, std::int64_t w, Chain& chain) const;
    void put_around_face(std::int64_t u, std::size_t from, std::size_t to, Chain& chain) const;
    void put_path(const Cell& cell, const std::vector<int>& path, Chain& chain) const;
    void put_face_edges(const Cell& cell, int f, Chain& chain) const;
    void put_ring(const Cell& cell, Chain& chain) const;
    bool put_join(const Cell& cell, int f, Chain& chain) const;
    void start(ElementCode death, Chain& chain) const;
    void replace_vertex_edge(const Edge& edge, Chain& chain) const;
    void replace_face_edge(const Edge& edge, Chain& chain) const;
    void replace_body_edge(const Edge& edge, Chain& chain) const;

    GridView<T> grid_;
    GridSteps steps_;
    double tunnel_height_;
};

}  // namespace isoatlas

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
// left: the boundary of the disk in the Morse complex. It comes out in ascending order, so a trace may stop at the element that it needs.
// Source: Forman 1998, for the gradient; docs/decisions/0018, 0047.
//
// In the literature: the descending manifold of a critical 2-cell and the boundary operator of the Morse complex mod 2 (Forman, Morse
// theory for cell complexes, 1998; Robins, Wood, Sheppard 2011).
#pragma once

#include <compare>
#include <functional>
#include <optional>
#include <queue>
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

    /// An edge of G, from its lower end; value, second, third: the key of that (field/order.h).
    struct Edge {
        double value;
        std::int64_t second, third;
        ElementPlace low, high;
        auto operator<=>(const Edge&) const = default;
    };
    /// The boundary of one disk, or of the sum mod 2 of several, as far as it has been followed: edges mod 2, the lowest one first.
    using Chain = std::priority_queue<Edge, std::vector<Edge>, std::greater<>>;

    /// Adds the disk of a (1,2) element.
    void add(ElementCode death, Chain& chain) const;
    /// The place of the lowest (2,1) element, among those that merge objects too, that the disks end at an odd number of times above all
    /// that were returned; nullopt: none is left. Where a disk was added since, one that was returned may come once more: it ends there an
    /// even number of times. Cost: O(e log e) for a disk that meets e edges below that element.
    [[nodiscard]] std::optional<ElementPlace> next(Chain& chain) const;

private:
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
    // Return whether the edge is what its lower end opened; else they replace it.
    [[nodiscard]] bool replace_vertex_edge(const Edge& edge, Chain& chain) const;
    [[nodiscard]] bool replace_face_edge(const Edge& edge, Chain& chain) const;
    [[nodiscard]] bool is_opened_by_body(const Edge& edge) const;

    GridView<T> grid_;
    GridSteps steps_;
    double tunnel_height_;
};

}  // namespace isoatlas

// Contours of a surface, the connected components of its mesh, and whether another mesh has the same ones: the same number, one to one, of
// the same genus, nested alike.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/deviation.h"
#include "isoatlas/context.h"

namespace isoatlas {

struct MeshContour {
    std::int64_t first_point = -1;  ///< its lowest point
    std::int64_t points = 0, triangles = 0;
    std::int64_t chi = 0;                                                      ///< Euler number
    std::int64_t rims = 0;                                                     ///< closed lines of edges with one triangle; 0: it is closed
    [[nodiscard]] std::int64_t genus() const { return (2 - chi - rims) / 2; }  ///< of an orientable manifold
};

struct MeshContours {
    std::vector<MeshContour> list;         ///< in order of their lowest points
    BigVector<std::int64_t> contour_of{};  ///< of each point; -1: no triangle uses it
    [[nodiscard]] bool all_closed() const;
    [[nodiscard]] std::int64_t genus() const;  ///< of all together
};
/// Cost: a sort of the edges.
[[nodiscard]] MeshContours find_contours(const MeshView& mesh, const Context& context = {});

/// For each contour, ascending: the closed contours that enclose it. Of closed, disjoint contours exact: the parity of the crossings of a
/// ray, decided with exact predicates as if it started a little beside the point. Cost: a ray a contour.
[[nodiscard]] std::vector<std::vector<std::int64_t>> find_enclosing(const MeshView& mesh, const MeshContours& contours,
                                                                    const Context& context = {});

/// Of a surface and another mesh, which should be the same but for its triangles.
struct ContourMatch {
    MeshContours surface, mesh;
    std::vector<std::int64_t> partner{};  ///< of each contour of the surface, that of the mesh; -1: none
    std::string unmatched{};              ///< the first contour without a partner; empty: one to one
    std::string other_genus{};            ///< the first pair of different Euler number or rims; empty: all are alike
    std::string other_nesting{};  ///< the first pair that is not enclosed by the same contours; empty: all are, or a contour is open
    [[nodiscard]] bool is_same() const { return unmatched.empty() && other_genus.empty() && other_nesting.empty(); }
};
/// Partners are the contours that each other's points lie on, or where none does, lie nearest to for the most part. Genus and nesting are
/// compared when all have partners. The same for any number of threads. Throws Error: cancelled. Cost: a microsecond a point.
[[nodiscard]] ContourMatch match_contours(const MeshView& surface, const MeshView& mesh, const Context& context = {});

}  // namespace isoatlas

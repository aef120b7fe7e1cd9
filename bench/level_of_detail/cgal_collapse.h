// Edge collapse by CGAL, which may not be there.
#pragma once

#include <isoatlas/surface.h>

namespace bench {

struct Collapsed {
    isoatlas::Surface surface{};
    double seconds = 0;
};

/// Costs and places of Lindstrom and Turk; no normal turns by much; the result within `error` of the mesh (polyhedral envelope), where that
/// is above 0; down to `triangles` at most. Throws std::runtime_error (no CGAL, not a manifold).
[[nodiscard]] Collapsed collapse_with_cgal(const isoatlas::Mesh& mesh, double error, std::int64_t triangles);

}  // namespace bench

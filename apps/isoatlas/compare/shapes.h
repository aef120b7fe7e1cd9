// Small bodies as triangles: what marks edges and points in a picture.
#pragma once

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

/// Adds to a surface without normals.
class Shapes {
public:
    /// A rod with pointed ends, seen from anywhere. radius: physical.
    void add_rod(const Vec3& from, const Vec3& to, double radius);
    /// An octahedron.
    void add_ball(const Vec3& middle, double radius);
    /// A rectangle that faces along the normal, with that normal, as wide along each direction as a box of these sides, about. Physical.
    void add_tile(const Vec3& middle, const Vec3& normal, const Vec3& sides);
    [[nodiscard]] Surface& surface() { return surface_; }

private:
    Surface surface_;
};

/// The triangles of a surface by their numbers, ascending, and those that are not among them, with the points that they use.
struct SplitSurface {
    Surface rest, part;
};
[[nodiscard]] SplitSurface split(const Surface& surface, const std::vector<std::int64_t>& part);

/// Gives every point the mean normal of its triangles, weighted by area.
void add_normals(Surface& surface);

}  // namespace isoatlas::cli

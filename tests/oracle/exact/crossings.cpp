#include "oracle/exact/crossings.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
using Corners = std::array<std::int64_t, 3>;

class Mesh {
public:
    Mesh(MeshPoints points, MeshTriangles triangles) : triangles_(triangles) {
        for (const auto& p : points) points_.emplace_back(p[0], p[1], p[2]);
    }

    [[nodiscard]] bool is_flat(std::size_t triangle) const {
        const Corners& t = triangles_[triangle];
        return CGAL::collinear(points_[t[0]], points_[t[1]], points_[t[2]]);
    }

    /// Do two triangles meet in more than the points they share?
    [[nodiscard]] bool cross(std::size_t triangle, std::size_t other) const {
        Corners p = triangles_[triangle], q = triangles_[other];
        const std::int64_t shared = put_shared_first(p, q);
        if (shared == 0) return CGAL::do_intersect(triangle_of(p), triangle_of(q));
        if (shared == 1)  // else they would leave each other through the side across from the shared point
            return CGAL::do_intersect(triangle_of(p), Segment(points_[q[1]], points_[q[2]])) ||
                   CGAL::do_intersect(triangle_of(q), Segment(points_[p[1]], points_[p[2]]));
        if (shared == 2)  // folded onto each other
            return CGAL::coplanar(points_[p[0]], points_[p[1]], points_[p[2]], points_[q[2]]) &&
                   CGAL::coplanar_orientation(points_[p[0]], points_[p[1]], points_[p[2]], points_[q[2]]) == CGAL::POSITIVE;
        return true;
    }

    [[nodiscard]] std::string text(std::size_t triangle) const {
        std::ostringstream out;
        out.precision(17);
        out << "triangle " << triangle << ":";
        for (const std::int64_t p : triangles_[triangle]) out << " " << p << " (" << points_[p] << ")";
        return out.str();
    }

    [[nodiscard]] Box box(std::size_t triangle) const {
        const Corners& t = triangles_[triangle];
        return {points_[t[0]].bbox() + points_[t[1]].bbox() + points_[t[2]].bbox(), triangle};
    }

private:
    [[nodiscard]] Triangle triangle_of(const Corners& p) const { return {points_[p[0]], points_[p[1]], points_[p[2]]}; }

    /// How many points two triangles share; these become the first ones of both, in the same order.
    static std::int64_t put_shared_first(Corners& p, Corners& q) {
        const auto is_shared = [&q](std::int64_t point) { return std::find(q.begin(), q.end(), point) != q.end(); };
        const std::int64_t shared = std::stable_partition(p.begin(), p.end(), is_shared) - p.begin();
        for (std::int64_t i = 0; i < shared; ++i) std::iter_swap(q.begin() + i, std::find(q.begin() + i, q.end(), p[i]));
        return shared;
    }

    MeshTriangles triangles_;
    std::vector<Point> points_;
};

}  // namespace

Crossings find_crossings(MeshPoints points, MeshTriangles triangles) {
    const Mesh mesh(points, triangles);
    Crossings found;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (mesh.is_flat(i))
            ++found.flat;
        else
            boxes.push_back(mesh.box(i));
    }
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        ++found.pairs;
        if (!mesh.cross(a.info(), b.info())) return;
        if (found.crossings++ == 0) found.first = mesh.text(a.info()) + " and " + mesh.text(b.info());
    });
    return found;
}

}  // namespace oracle

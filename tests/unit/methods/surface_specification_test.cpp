// What the paper of each method says of its surfaces, on any small volume with ties.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>
#include <set>

#include "isoatlas/surface_defects.h"
#include "isoatlas/surface_methods.h"
#include "oracle/mesh_checks.h"
#include "unit/methods/generic_tau.h"

namespace oracle {
namespace {

using isoatlas::Surface;
using isoatlas::SurfaceMethod;
using isoatlas::SurfaceReport;
using isoatlas::Vec3;

Surface extract_by(SurfaceMethod method, const isoatlas::Volume& volume, double tau) {
    return isoatlas::make_extractor(method, volume)->extract(tau).surface;
}
SurfaceReport report_of(const Surface& surface) { return isoatlas::inspect(surface.points, surface.triangles); }
std::size_t components(const Surface& surface) { return report_of(surface).component_chi.size(); }

Grid arbitrary_3d() {
    Grid grid = *arbitrary_grid(5, 60);
    grid.rank = 3;
    return grid;
}

RC_GTEST_PROP(SurfaceSpecification, OnlyConnectedContoursAndMarchingCubesHaveHoles, ()) {
    const Grid grid = arbitrary_3d();
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    if (const std::optional<double> generic = generic_tau(grid)) {
        const double tau = *generic;
        for (const isoatlas::SurfaceMethodInfo& info : isoatlas::surface_methods()) {
            if (info.method == SurfaceMethod::marching_cubes || info.method == SurfaceMethod::connected_contours) continue;
            const Surface surface = extract_by(info.method, volume, tau);
            if (report_of(surface).misoriented_edges != 0) RC_FAIL(std::string(info.name) + ": triangles are not turned alike");
            if (std::ssize(isoatlas::find_defects(surface, volume.info).hole_edges) != 0) RC_FAIL(std::string(info.name) + ": holes");
        }
    }
}

RC_GTEST_PROP(SurfaceSpecification, TetrahedraMakeManifolds, ()) {
    const Grid grid = arbitrary_3d();
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    if (const std::optional<double> generic = generic_tau(grid)) {
        const double tau = *generic;
        for (const SurfaceMethod method : {SurfaceMethod::five_tetrahedra, SurfaceMethod::six_tetrahedra})
            RC_ASSERT(report_of(extract_by(method, volume, tau)).is_manifold());
    }
}

RC_GTEST_PROP(SurfaceSpecification, TheProductMakesManifoldsAtSamplesToo, ()) {
    const Grid grid = arbitrary_3d();
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    for (const double tau : interesting_values(elements_of(grid, isoatlas::Interpolant::trilinear))) {
        for (const SurfaceMethod method : {SurfaceMethod::spider_web, SurfaceMethod::trilinear}) {
            const Surface surface = extract_by(method, volume, tau);
            RC_ASSERT(report_of(surface).is_manifold());
            RC_ASSERT(std::ssize(isoatlas::find_defects(surface, volume.info).hole_edges) == 0);
        }
    }
}

/// The two points of an edge lie on edges of one square of samples, which alternates: two Highs at the ends of a diagonal, two Lows.
bool lies_in_ambiguous_face(const Grid& grid, double tau, const Vec3& p, const Vec3& q) {
    for (std::size_t normal = 0; normal < 3; ++normal) {
        if (p[normal] != q[normal] || p[normal] != std::floor(p[normal])) continue;
        std::array<Index, 3> from{};
        for (std::size_t axis = 0; axis < 3; ++axis) from[axis] = static_cast<Index>(std::floor(std::min(p[axis], q[axis])));
        const std::size_t u = (normal + 1) % 3, v = (normal + 2) % 3;
        const auto is_high = [&](Index i, Index j) {
            std::array<Index, 3> at = from;
            at[u] += i, at[v] += j;
            return grid.contains(at) && grid.value[grid.index(at[0], at[1], at[2])] >= tau;
        };
        if (is_high(0, 0) == is_high(1, 1) && is_high(0, 1) == is_high(1, 0) && is_high(0, 0) != is_high(0, 1)) return true;
    }
    return false;
}

std::vector<std::array<Index, 2>> edges_with_one_triangle(const Surface& surface) {
    std::map<std::array<Index, 2>, int> count;
    for (const auto& t : surface.triangles) {
        for (std::size_t i = 0; i < 3; ++i) ++count[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
    }
    std::vector<std::array<Index, 2>> edges;
    for (const auto& [edge, triangles] : count) {
        if (triangles == 1) edges.push_back(edge);
    }
    return edges;
}

bool lies_in_an_end(const Grid& grid, const Vec3& p, const Vec3& q) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (p[axis] == q[axis] && (p[axis] == 0 || p[axis] == static_cast<double>(grid.size[axis] - 1))) return true;
    }
    return false;
}

RC_GTEST_PROP(SurfaceSpecification, MarchingCubesHasHolesOnAmbiguousFacesAlone, ()) {
    const Grid grid = arbitrary_3d();
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    if (const std::optional<double> generic = generic_tau(grid)) {
        const double tau = *generic;
        const Surface surface = extract_by(SurfaceMethod::marching_cubes, volume, tau);
        Index holes = 0;
        for (const auto& [from, to] : edges_with_one_triangle(surface)) {
            const Vec3 &p = surface.points[from], &q = surface.points[to];
            if (lies_in_an_end(grid, p, q)) continue;
            RC_ASSERT(lies_in_ambiguous_face(grid, tau, p, q));
            ++holes;
        }
        RC_ASSERT(std::ssize(isoatlas::find_defects(surface, volume.info).hole_edges) <=
                  holes);  // fewer: points very near an end of the volume
    }
}

/// Their rules know no direction.
RC_GTEST_PROP(SurfaceSpecification, AMirroredVolumeHasTheSameObjectsButForTetrahedra, ()) {
    const Grid grid = arbitrary_3d();
    const auto all = turns(3);
    const auto& [order, mirror] = all[*rc::gen::inRange<std::size_t>(0, all.size())];
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    const isoatlas::Volume mirrored = to_volume(rotated(grid, order, mirror), isoatlas::ValueType::f64);
    if (const std::optional<double> generic = generic_tau(grid)) {
        const double tau = *generic;
        for (const SurfaceMethod method : {SurfaceMethod::marching_cubes, SurfaceMethod::asymptotic_decider,
                                           SurfaceMethod::marching_cubes_33, SurfaceMethod::spider_web, SurfaceMethod::trilinear})
            RC_ASSERT(components(extract_by(method, volume, tau)) == components(extract_by(method, mirrored, tau)));
    }
}

/// Value at any place, by the weights of the eight samples around it.
double trilinear_value(const Grid& grid, const Vec3& at) {
    std::array<Index, 3> from{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        from[axis] = std::clamp<Index>(static_cast<Index>(std::floor(at[axis])), 0, std::max<Index>(0, grid.size[axis] - 2));
    double sum = 0;
    for (Index corner = 0; corner < 8; ++corner) {
        std::array<Index, 3> sample = from;
        double weight = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double part = at[axis] - static_cast<double>(from[axis]);
            sample[axis] += corner >> axis & 1;
            weight *= (corner >> axis & 1) != 0 ? part : 1 - part;
        }
        if (grid.contains(sample)) sum += weight * grid.value[grid.index(sample[0], sample[1], sample[2])];
    }
    return sum;
}

/// Every small cube with a High and a Low corner is a point, and no other.
RC_GTEST_PROP(SurfaceSpecification, DividingCubesMakesAPointOfEveryMixedCube, ()) {
    const Grid grid = arbitrary_3d();
    constexpr Index kDivisions = 4;  // binary: values at corners are the same here and there, but for rounding
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    if (const std::optional<double> generic = generic_tau(grid)) {
        const double tau = *generic;
        const auto found = isoatlas::make_extractor(SurfaceMethod::dividing_cubes, volume, {.divisions = kDivisions})->extract(tau).points;
        std::set<Vec3> points(found.points.begin(), found.points.end());
        RC_ASSERT(points.size() == found.points.size());
        for (Index z = 0; z < kDivisions * (grid.size[2] - 1); ++z) {
            for (Index y = 0; y < kDivisions * (grid.size[1] - 1); ++y) {
                for (Index x = 0; x < kDivisions * (grid.size[0] - 1); ++x) {
                    double lowest = kInfinity, highest = -kInfinity;
                    for (Index corner = 0; corner < 8; ++corner) {
                        const Vec3 at{static_cast<double>(x + (corner & 1)) / kDivisions,
                                      static_cast<double>(y + (corner >> 1 & 1)) / kDivisions,
                                      static_cast<double>(z + (corner >> 2)) / kDivisions};
                        const double value = trilinear_value(grid, at) - tau;
                        lowest = std::min(lowest, value), highest = std::max(highest, value);
                    }
                    const Vec3 middle{(static_cast<double>(x) + 0.5) / kDivisions, (static_cast<double>(y) + 0.5) / kDivisions,
                                      (static_cast<double>(z) + 0.5) / kDivisions};
                    constexpr double kRounding = 1e-9;
                    const bool is_point = points.contains(middle);
                    if (lowest < -kRounding && highest > kRounding) RC_ASSERT(is_point);
                    if (lowest > kRounding || highest < -kRounding) RC_ASSERT(!is_point);
                }
            }
        }
    }
}

/// Each triangle has an edge in a slice, and its third corner in the slice beside it.
RC_GTEST_PROP(SurfaceSpecification, ConnectedContoursAreStripsBetweenNeighbouringSlices, ()) {
    const Grid grid = arbitrary_3d();
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    if (const std::optional<double> generic = generic_tau(grid)) {
        const double tau = *generic;
        const Surface surface = extract_by(SurfaceMethod::connected_contours, volume, tau);
        for (const Vec3& point : surface.points) RC_ASSERT(point[2] == std::floor(point[2]));
        for (const auto& t : surface.triangles) {
            std::array<double, 3> slice{surface.points[t[0]][2], surface.points[t[1]][2], surface.points[t[2]][2]};
            std::ranges::sort(slice);
            RC_ASSERT(slice[2] - slice[0] == 1);
        }
    }
}

}  // namespace
}  // namespace oracle

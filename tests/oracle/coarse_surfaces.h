// Exact surfaces that are to get fewer triangles: of random small volumes, and of shapes that decimators break; and what must hold then.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "geometry/crossings.h"
#include "isoatlas/level_of_detail.h"
#include "isoatlas/surface.h"
#include "isoatlas/verify.h"
#include "oracle/contour_gap.h"
#include "oracle/mesh_checks.h"

namespace oracle {

using isoatlas::Boundary;
using isoatlas::DistanceUnit;
using isoatlas::SimplificationOptions;
using isoatlas::Surface;

struct CoarseCase {
    isoatlas::Volume volume;
    Surface exact;
    SimplificationOptions options;

    CoarseCase() {
        Grid grid = *arbitrary_grid(9, 400);
        grid.rank = 3;
        const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
        volume = to_volume(grid, arbitrary_type(grid));
        volume.info.geometry = arbitrary_geometry(grid);
        isoatlas::ExtractOptions how;
        how.interpolant = interpolant;
        how.surface.style = *rc::gen::element(isoatlas::SurfaceStyle::compact, isoatlas::SurfaceStyle::full);
        how.surface.boundary = *rc::gen::element(Boundary::closed, Boundary::open);
        exact = isoatlas::extract(volume, arbitrary_tau(elements_of(grid, interpolant)), how);
        options.max_distance = *rc::gen::element(0.05, 0.5, 2.0, kInfinity);
        options.unit = *rc::gen::element(DistanceUnit::voxel, DistanceUnit::physical);
        options.triangles = *rc::gen::element(0, 0, 40);
    }
    [[nodiscard]] isoatlas::SimplifiedSurface simplified(const isoatlas::Context& context = {}) const {
        return isoatlas::simplify_surface(exact, volume.info.geometry, volume.info.extent, options, context);
    }
};

/// Volumes of several blocks, of shapes that decimators break.
struct Shape {
    const char* name;
    isoatlas::Extent extent;
    double (*sample)(double x, double y, double z);
    double tau;
};

inline double hashed(double x, double y, double z) {
    std::uint64_t bits = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U ^ static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fU ^
                         static_cast<std::uint64_t>(z) * 0x165667b19e3779f9U;
    bits = (bits ^ bits >> 31) * 0xbf58476d1ce4e5b9U;
    return static_cast<double>((bits ^ bits >> 29) >> 11) * 0x1p-53;
}

inline const Shape kShapes[] = {
    {"the tube of the dissertation's condition",
     {3, {5, 5, 9}},
     [](double x, double y, double z) { return 10 - 5 * (std::abs(x - 2) + std::abs(y - 2)) - 0.01 * z; },
     7},
    {"a tube of one voxel through many blocks",
     {3, {140, 9, 9}},
     [](double x, double y, double z) {
         const double u = y - 4 - 2 * std::sin(x / 9), v = z - 4 - 2 * std::cos(x / 9);
         return 1.2 - std::sqrt(u * u + v * v);
     },
     0.5},
    {"sheets one voxel apart",
     {3, {34, 20, 9}},
     [](double x, double y, double z) { return std::sin(3.14159 * (z + 0.3 * std::sin(x / 7) + 0.3 * std::cos(y / 5))); },
     0.1},
    {"nested shells a voxel thin",
     {3, {34, 24, 24}},
     [](double x, double y, double z) {
         const double r = std::sqrt((x - 17) * (x - 17) + (y - 17.3) * (y - 17.3) + (z - 16.8) * (z - 16.8));
         return std::sin(3.14159 * r / 1.3);
     },
     0.2},
    {"noise", {3, {34, 20, 8}}, [](double x, double y, double z) { return hashed(x, y, z); }, 0.6},
    {"a smooth surface",
     {3, {40, 40, 30}},
     [](double x, double y, double z) { return std::sin(x / 6) * std::cos(y / 7) + std::sin(z / 5) * std::cos(x / 9); },
     0.3},
};

inline isoatlas::Volume volume_of(const Shape& shape) {
    std::vector<float> samples;
    for (std::int64_t i = 0; i < shape.extent.voxels(); ++i) {
        const auto p = shape.extent.voxel(i);
        samples.push_back(
            static_cast<float>(shape.sample(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]))));
    }
    isoatlas::Volume volume = isoatlas::make_volume<float>(shape.extent, samples);
    volume.info.geometry.spacing = {0.7, 1.1, 2.5};
    volume.info.geometry.origin = {-100, 37, 5};
    const double c = std::cos(0.4), s = std::sin(0.4);
    volume.info.geometry.direction = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
    return volume;
}

/// Of a point in voxels: does it lie on an edge of the grid?
inline bool is_hit(const isoatlas::Vec3& p) {
    return std::ranges::count_if(p, [](double x) { return x == std::round(x); }) >= 2;
}

/// The Euler number of each contour, by the ids of the points.
inline std::map<std::int64_t, std::int64_t> euler_numbers(const Surface& surface) {
    std::map<std::int64_t, std::int64_t> numbers;
    std::vector<std::array<std::int64_t, 2>> edges;
    for (const std::int64_t contour : surface.contour) ++numbers[contour];
    for (const auto& t : surface.triangles) {
        ++numbers[surface.contour[static_cast<std::size_t>(t[0])]];
        for (std::size_t k = 0; k < 3; ++k) edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
    }
    std::ranges::sort(edges);
    edges.erase(std::ranges::unique(edges).begin(), edges.end());
    for (const auto& [a, b] : edges) --numbers[surface.contour[static_cast<std::size_t>(a)]];
    return numbers;
}

/// The contours that enclose each contour of a closed surface, by the ids of the points.
inline std::map<std::int64_t, std::set<std::int64_t>> enclosing_contours(const Surface& surface) {
    const isoatlas::MeshView mesh{surface.points, surface.triangles};
    const isoatlas::MeshContours contours = isoatlas::find_contours(mesh);
    const auto id_of = [&](std::int64_t i) {
        return surface.contour[static_cast<std::size_t>(contours.list[static_cast<std::size_t>(i)].first_point)];
    };
    const std::vector<std::vector<std::int64_t>> enclosing = isoatlas::find_enclosing(mesh, contours);
    std::map<std::int64_t, std::set<std::int64_t>> ids;
    for (std::size_t i = 0; i < enclosing.size(); ++i) {
        std::set<std::int64_t>& of_contour = ids[id_of(static_cast<std::int64_t>(i))];
        for (const std::int64_t outer : enclosing[i]) of_contour.insert(id_of(outer));
    }
    return ids;
}

/// The first check of a closed surface by itself that does not hold; crossings, which take longest, where they are wanted.
inline std::string mesh_failure(const Surface& surface, bool crossings) {
    isoatlas::Mesh mesh;
    mesh.points = surface.points, mesh.triangles = surface.triangles;
    for (const isoatlas::CheckResult& check : verify_mesh(mesh)) {
        if (!check.holds) return check.name + ": " + check.detail;
    }
    if (crossings && isoatlas::count_crossings(surface.points, surface.triangles).pairs > 0) return "triangles cross";
    return {};
}

/// Of an exact surface and a coarser version of it: the greatest distance allowed, where 0 is one of rounding.
struct Allowed {
    double distance = 0;
    DistanceUnit unit = DistanceUnit::voxel;
};

inline isoatlas::SimplifiedReport coarse_report(const Surface& coarse, const Surface& exact, const isoatlas::VolumeInfo& info,
                                                const Allowed& allowed) {
    isoatlas::Mesh mesh;
    mesh.points = coarse.points, mesh.triangles = coarse.triangles;
    mesh.space = exact.space, mesh.unit = exact.unit;
    isoatlas::SimplifiedOptions how;
    how.max_distance = allowed.distance == 0 ? 1e-9 : allowed.distance * (1 + 1e-5);
    how.in_voxels = allowed.unit == DistanceUnit::voxel;
    return verify_simplified(mesh, exact, info, how);
}

inline std::string text(const isoatlas::SimplifiedReport& report, const isoatlas::CheckResult& check) {
    std::ostringstream out;
    out << check.name << ": " << check.detail << "; " << report.exact_triangles << " triangles; to exact, back: " << report.to_exact.upper
        << ", " << report.from_exact.upper << "; in voxels " << report.to_exact_in_voxels.upper << ", "
        << report.from_exact_in_voxels.upper;
    return out.str();
}

/// The Euler numbers of its components, ascending.
inline std::vector<std::int64_t> component_numbers(const Surface& surface) {
    std::vector<std::int64_t> chi = inspect(surface.points, surface.triangles).component_chi;
    std::ranges::sort(chi);
    return chi;
}

/// Whether nearness tells which contours belong together: where no point has moved half as far as two contours of the exact surface are
/// apart, each lies in a neighbourhood of its own.
inline bool are_told_by_nearness(const isoatlas::SimplifiedReport& report, const Surface& exact) {
    return 2 * std::max(report.to_exact.upper, report.from_exact.upper) < least_gap(exact);
}

/// The first thing that does not hold; empty: all does. Points with ids of contours pair them, and nearness where it can.
inline std::string coarse_failure(const Surface& coarse, const Surface& exact, const isoatlas::VolumeInfo& info, const Allowed& allowed) {
    if (component_numbers(coarse) != component_numbers(exact)) return "components have other Euler numbers";
    if (!coarse.contour.empty() && euler_numbers(coarse) != euler_numbers(exact)) return "the contours have other Euler numbers";
    if (!coarse.contour.empty() && exact.closed && enclosing_contours(coarse) != enclosing_contours(exact))
        return "the contours are nested otherwise";
    const isoatlas::SimplifiedReport report = coarse_report(coarse, exact, info, allowed);
    for (const isoatlas::CheckResult& check : report.checks) {
        if (!check.holds && (check.name != "contours_are_one_to_one" || are_told_by_nearness(report, exact))) return text(report, check);
    }
    return {};
}

}  // namespace oracle

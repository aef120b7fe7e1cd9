#include "isoatlas/surface_methods.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancel.h"
#include "field/volume_view.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "methods/surfaces/contour_stack.h"
#include "methods/surfaces/loops.h"
#include "methods/surfaces/tetrahedra.h"

namespace isoatlas {
namespace {

constexpr std::array<SurfaceMethodInfo, 7> kMethods{{
    {SurfaceMethod::connected_contours, "connected-contours", "Connected contours of slices", "3.1",
     "Fuchs, Kedem, Uselton, Optimal surface reconstruction from planar contours, 1977"},
    {SurfaceMethod::marching_cubes, "marching-cubes", "Marching Cubes of 1987", "3.2", "Lorensen, Cline, Marching Cubes, 1987"},
    {SurfaceMethod::asymptotic_decider, "asymptotic-decider", "Asymptotic decider", "3.2", "Nielson, Hamann, The asymptotic decider, 1991"},
    {SurfaceMethod::five_tetrahedra, "five-tetrahedra", "Five tetrahedra a cell", "3.5",
     "Doi, Koide, An efficient method of triangulating equi-valued surfaces by using tetrahedral cells, 1991"},
    {SurfaceMethod::six_tetrahedra, "six-tetrahedra", "Six tetrahedra a cell", "3.5", "Kuhn, Some combinatorial lemmas in topology, 1960"},
    {SurfaceMethod::spider_web, "spider-web", "Spider Web", "3.4",
     "Karron, The Spider Web algorithm for surface construction in noisy volume data, 1992"},
    {SurfaceMethod::trilinear, "trilinear", "Spider Web, trilinear interiors", "", "isoatlas"},
}};

template <class T>
void add_cell(SurfaceMethod method, const Index3& cell, EdgePoints<T>& points) {
    switch (method) {
        case SurfaceMethod::marching_cubes: return add_loops(cell, FaceRule::fewer_are_separate, points);
        case SurfaceMethod::asymptotic_decider: return add_loops(cell, FaceRule::asymptotic_decider, points);
        default:
            for (const Tetrahedron& corners : tetrahedra_of(cell, method == SurfaceMethod::five_tetrahedra))
                add_tetrahedron(cell, corners, points);
    }
}

template <class T>
void add_cells(SurfaceMethod method, const VolumeInfo& info, std::span<const T> samples, double tau, const Context& context,
               Surface& surface) {
    EdgePoints<T> points(info, samples, tau, surface);
    const Index3 cells = info.extent.size - 1;
    for (std::int64_t z = 0; z < cells[2]; ++z) {
        stop_if_cancelled(context);
        for (std::int64_t y = 0; y < cells[1]; ++y) {
            for (std::int64_t x = 0; x < cells[0]; ++x) add_cell(method, {x, y, z}, points);
        }
    }
}

/// Triangles are counter-clockwise seen from the Lows in physical space, too.
void turn(Surface& surface) {
    for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
}

/// Where points lie along the axes of a grid, in the unit of its spacing.
class AxisPositions {
public:
    explicit AxisPositions(const VolumeInfo& info) : info_(info) {
        const Mat3& m = info.geometry.direction;
        for (std::size_t axis = 0; axis < 3; ++axis) {  // rows of cofactors: the inverse is their transpose over the determinant
            const std::size_t p = (axis + 1) % 3, q = (axis + 2) % 3;
            for (std::size_t row = 0; row < 3; ++row) {
                const std::size_t r = (row + 1) % 3, t = (row + 2) % 3;
                inverse_[axis][row] = m[r][p] * m[t][q] - m[r][q] * m[t][p];
            }
        }
        determinant_ = m[0][0] * inverse_[0][0] + m[1][0] * inverse_[0][1] + m[2][0] * inverse_[0][2];
    }
    /// In which ends of the volume a point lies, a bit each.
    [[nodiscard]] unsigned ends_of(const Vec3& point) const {
        constexpr double kNear = 1e-6;  // of a step: points were mapped to physical space and back
        unsigned ends = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double at = 0;
            for (std::size_t row = 0; row < 3; ++row) at += inverse_[axis][row] * (point[row] - info_.geometry.origin[row]) / determinant_;
            const std::vector<double>& coordinates = info_.geometry.coordinates[axis];
            const std::int64_t count = info_.extent.size[axis];
            const double first = coordinates.empty() ? 0 : coordinates.front();
            const double last =
                coordinates.size() < 2 ? first + info_.geometry.spacing[axis] * static_cast<double>(count - 1) : coordinates.back();
            const double near = kNear * std::abs(last - first) / static_cast<double>(std::max<std::int64_t>(1, count - 1));
            if (std::abs(at - first) <= near) ends |= 1U << (2 * axis);
            if (std::abs(at - last) <= near) ends |= 2U << (2 * axis);
        }
        return ends;
    }

private:
    const VolumeInfo& info_;
    Mat3 inverse_{};
    double determinant_;
};

}  // namespace

std::span<const SurfaceMethodInfo> surface_methods() { return kMethods; }

const SurfaceMethodInfo& info_of(SurfaceMethod method) { return kMethods[static_cast<std::size_t>(method)]; }

Surface extract_by(SurfaceMethod method, const Volume& volume, double tau, const Context& context) {
    const EnvironmentScope scope(context);
    require_surface(volume, tau);
    if (method == SurfaceMethod::spider_web || method == SurfaceMethod::trilinear) {
        const Interpolant interpolant = method == SurfaceMethod::trilinear ? Interpolant::trilinear : Interpolant::faces;
        ExtractOptions options{.interpolant = interpolant};
        options.surface.boundary = Boundary::open;
        options.surface.normals = options.surface.ids = false;
        return extract(volume, tau, options, context);
    }
    Surface surface;
    surface.tau = tau, surface.reported_tau = volume.info.calibration.reported(tau);
    surface.space = volume.info.geometry.space, surface.unit = volume.info.geometry.unit;
    surface.closed = false;
    if (method == SurfaceMethod::connected_contours)
        connect_contours(volume, tau, context, surface);
    else
        visit_samples(VolumeView(volume), [&](auto samples) { add_cells(method, volume.info, samples, tau, context, surface); });
    if (handedness(volume.info.geometry) < 0) turn(surface);
    return surface;
}

std::int64_t count_hole_edges(const Surface& surface, const VolumeInfo& info) {
    const AxisPositions positions(info);
    std::vector<std::array<std::int64_t, 2>> edges;
    for (const auto& t : surface.triangles) {
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
    }
    std::ranges::sort(edges);
    std::int64_t holes = 0;
    for (std::size_t i = 0; i < edges.size();) {
        const std::size_t begin = i;
        while (i < edges.size() && edges[i] == edges[begin]) ++i;
        if (i - begin == 1)
            holes += (positions.ends_of(surface.points[edges[begin][0]]) & positions.ends_of(surface.points[edges[begin][1]])) == 0;
    }
    return holes;
}

}  // namespace isoatlas

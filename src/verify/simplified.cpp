// verify_simplified: a mesh against the exact surface.
#include <algorithm>
#include <array>
#include <charconv>

#include "field/voxel_positions.h"
#include "formats/common/volume_file.h"
#include "geometry/contours.h"
#include "geometry/crossings.h"
#include "geometry/deviation.h"
#include "isoatlas/environment.h"
#include "verify/checks.h"

namespace isoatlas {
namespace {

std::string digits(double value) {
    std::array<char, 32> buffer{};
    constexpr int kDigits = 5;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, kDigits).ptr};
}

MeshView view(const BigVector<Vec3>& points, const BigVector<TriangleCorners>& triangles) { return {points, triangles}; }

/// The points of the mesh in the space of the exact surface.
BigVector<Vec3> points_in_space(const Mesh& mesh, const Surface& exact, PointSpace assumed) {
    BigVector<Vec3> points = mesh.points;
    std::string space = mesh.space;
    if (!is_anatomical(space)) space = assumed == PointSpace::lps ? "LPS" : assumed == PointSpace::ras ? "RAS" : exact.space;
    if (!is_anatomical(exact.space) || !is_anatomical(space)) return points;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (space[axis] == exact.space[axis]) continue;
        for (Vec3& point : points) point[axis] = -point[axis];
    }
    return points;
}

/// In one space. Where that is mirrored, triangles of the mesh run the other way round, on which nothing here depends.
struct Compared {
    MeshView mesh, exact;
};

/// The length of a step between samples, where it is the same along all axes and these are perpendicular.
std::optional<double> uniform_spacing(const VolumeInfo& info) {
    const Geometry& geometry = info.geometry;
    const Vec3& s = geometry.spacing;
    if (is_rectilinear(geometry) || s[0] != s[1] || s[1] != s[2] || skew_of(geometry, 3) < 1) return std::nullopt;
    return s[0];
}

DistanceBounds bounds(const OneSidedDistance& distance, double unit) { return {distance.lower * unit, distance.upper * unit}; }

class Distances {
public:
    Distances(const Compared& compared, const VolumeInfo& info, const SimplifiedOptions& options, const Context& context)
        : compared_(compared), info_(info), options_(options), context_(context) {}

    void measure(SimplifiedReport& report) const {
        const std::optional<double> spacing = uniform_spacing(info_);
        const double limit = options_.max_distance.value_or(0), unit = spacing.value_or(0);
        if (spacing) {
            const Deviation found =
                measure_deviation(compared_.mesh, compared_.exact,
                                  {.tolerance = options_.tolerance * unit, .limit = options_.in_voxels ? limit * unit : limit}, context_);
            report.to_exact = bounds(found.first_to_second, 1), report.from_exact = bounds(found.second_to_first, 1);
            report.to_exact_in_voxels = bounds(found.first_to_second, 1 / unit);
            report.from_exact_in_voxels = bounds(found.second_to_first, 1 / unit);
            return;
        }
        const Deviation found =
            measure_deviation(compared_.mesh, compared_.exact,
                              {.tolerance = options_.tolerance * smallest_spacing(), .limit = options_.in_voxels ? 0 : limit}, context_);
        report.to_exact = bounds(found.first_to_second, 1), report.from_exact = bounds(found.second_to_first, 1);
        const BigVector<Vec3> mesh = in_voxels(compared_.mesh.points), exact = in_voxels(compared_.exact.points);
        const Deviation steps = measure_deviation({mesh, compared_.mesh.triangles}, {exact, compared_.exact.triangles},
                                                  {.tolerance = options_.tolerance, .limit = options_.in_voxels ? limit : 0}, context_);
        report.to_exact_in_voxels = bounds(steps.first_to_second, 1), report.from_exact_in_voxels = bounds(steps.second_to_first, 1);
    }

private:
    [[nodiscard]] double smallest_spacing() const { return std::ranges::min(with_smallest_steps(info_.geometry).spacing); }
    [[nodiscard]] BigVector<Vec3> in_voxels(std::span<const Vec3> points) const {
        const Geometry even = with_smallest_steps(info_.geometry);
        const VoxelPositions positions(even);
        BigVector<Vec3> result(points.size());
        std::ranges::transform(points, result.begin(), [&](const Vec3& point) { return positions.of(point); });
        return result;
    }

    const Compared& compared_;
    const VolumeInfo& info_;
    const SimplifiedOptions& options_;
    const Context& context_;
};

bool holds(const std::vector<CheckResult>& checks, const std::string& name) {
    return std::ranges::any_of(checks, [&](const CheckResult& check) { return check.name == name && check.holds; });
}

CheckResult does_not_cross_itself(const Compared& compared, const Context& context) {
    const Crossings found = count_crossings(compared.mesh.points, compared.mesh.triangles, context);
    std::string detail = std::to_string(found.pairs) + " pairs of triangles cross";
    if (found.first) detail += ", first " + std::to_string((*found.first)[0]) + " and " + std::to_string((*found.first)[1]);
    return {"surface_does_not_cross_itself", found.pairs == 0, detail};
}

std::string or_else(const std::string& difference, const std::string& same) { return difference.empty() ? same : difference; }

void compare_contours(SimplifiedReport& report, const Compared& compared, const Context& context) {
    const ContourMatch match = match_contours(compared.exact, compared.mesh, context);
    report.exact_contours = static_cast<std::int64_t>(match.surface.list.size());
    report.contours = static_cast<std::int64_t>(match.mesh.list.size());
    report.exact_genus = match.surface.genus();
    if (holds(report.checks, "surface_is_manifold")) report.genus = match.mesh.genus();
    const bool one_to_one = match.unmatched.empty();
    const std::string contours =
        std::to_string(report.contours) + " contours, of the exact surface " + std::to_string(report.exact_contours);
    report.checks.push_back({"contours_are_one_to_one", one_to_one, one_to_one ? contours : contours + "; " + match.unmatched});
    if (!one_to_one) return;  // nothing else can be compared
    report.checks.push_back({"contours_have_same_genus", match.other_genus.empty(),
                             or_else(match.other_genus, "genus " + std::to_string(report.exact_genus) + " in all")});
    if (!(match.surface.all_closed() && match.mesh.all_closed())) return;
    report.checks.push_back(
        {"contours_are_nested_alike", match.other_nesting.empty(), or_else(match.other_nesting, "each inside the same others")});
}

CheckResult is_within(const SimplifiedReport& report, double limit, bool in_voxels, const std::string& unit) {
    const DistanceBounds &there = in_voxels ? report.to_exact_in_voxels : report.to_exact,
                         &back = in_voxels ? report.from_exact_in_voxels : report.from_exact;
    const double lower = std::max(there.lower, back.lower), upper = std::max(there.upper, back.upper);
    const std::string unit_text = in_voxels ? " voxels" : unit.empty() ? "" : " " + unit;
    std::string detail = digits(upper) + unit_text + ", at most " + digits(limit) + unit_text + " allowed";
    if (upper > limit && lower <= limit) detail += "; it differs from that by less than can be told";
    return {"distance_is_within", upper <= limit, detail};
}

void check_options(const Mesh& mesh, const Surface& exact, const SimplifiedOptions& options) {
    if (options.max_distance && !(*options.max_distance > 0))
        throw Error(ErrorKind::usage,
                    {.what = "the greatest distance allowed is " + digits(*options.max_distance), .expected = "a number above 0"});
    if (!(options.tolerance > 0))
        throw Error(ErrorKind::usage,
                    {.what = "the tolerance of distances is " + digits(options.tolerance), .expected = "a number above 0"});
    if (mesh.unit.empty() || exact.unit.empty() || mesh.unit == exact.unit) return;
    throw Error(ErrorKind::input, {.what = "the mesh is in " + mesh.unit + ", the volume in " + exact.unit,
                                   .expected = "one unit of length",
                                   .next = "convert the mesh to " + exact.unit + " with the program that made it"});
}

}  // namespace

SimplifiedReport verify_simplified(const Mesh& mesh, const Surface& exact, const VolumeInfo& info, const SimplifiedOptions& options,
                                   const Context& context) {
    const EnvironmentScope scope(context);
    check_options(mesh, exact, options);
    SimplifiedReport report;
    report.exact_triangles = static_cast<std::int64_t>(exact.triangles.size());
    report.checks = verify_mesh(mesh);
    if (!exact.closed)
        std::erase_if(report.checks,
                      [](const CheckResult& check) { return check.name == "surface_is_closed" || check.name == "euler_numbers_are_even"; });
    if (!holds(report.checks, "indices_are_valid") || !holds(report.checks, "points_are_finite")) return report;
    const BigVector<Vec3> points = points_in_space(mesh, exact, options.space);
    const Compared compared{view(points, mesh.triangles), view(exact.points, exact.triangles)};
    constexpr int kPhases = 3;
    context.report("find crossings", 0, kPhases, 0);
    report.checks.push_back(does_not_cross_itself(compared, context));
    context.report("match contours", 1, kPhases, 0);
    compare_contours(report, compared, context);
    context.report("measure distances", 2, kPhases, 0);
    report.is_measured = true;
    Distances(compared, info, options, context).measure(report);
    if (options.max_distance) report.checks.push_back(is_within(report, *options.max_distance, options.in_voxels, exact.unit));
    return report;
}

}  // namespace isoatlas

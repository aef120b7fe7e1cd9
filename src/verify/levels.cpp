// verify_levels: levels of detail against the store that they are of.
#include <algorithm>
#include <array>

#include "isoatlas/environment.h"
#include "isoatlas/verify.h"

namespace isoatlas {
namespace {

using Corners = std::array<Vec3, 3>;

/// Triangles by the positions of their corners, from the least one on; sorted.
std::vector<Corners> corners_of(const Surface& surface) {
    std::vector<Corners> triangles;
    triangles.reserve(surface.triangles.size());
    for (const auto& triangle : surface.triangles) {
        Corners corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = surface.points[static_cast<std::size_t>(triangle[i])];
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        triangles.push_back(corners);
    }
    std::ranges::sort(triangles);
    return triangles;
}

std::string name_of(const LevelsKey& key) {
    return (key.is_contour ? "contour " : "object v") + std::to_string(key.voxel) + " at " + std::to_string(key.tau);
}

/// The first violation, or what was looked at.
struct Found {
    std::string violation;
    std::int64_t triangles = 0, levels = 0;
};

void check_level(const SimplifiedSurface& level, const Surface& exact, const VolumeInfo& info, const Context& context, Found& found) {
    constexpr double kRounding = 1 + 1e-9;
    const Mesh mesh{level.surface.points, level.surface.triangles, {}, {}, level.surface.space};
    SimplifiedOptions options{.in_voxels = true};
    if (level.distance > 0) options.max_distance = level.distance * kRounding;
    const SimplifiedReport report = verify_simplified(mesh, exact, info, options, context);
    for (const CheckResult& check : report.checks) {
        if (!check.holds && found.violation.empty())
            found.violation = check.name + ": " + check.detail + " (" + std::to_string(mesh.triangles.size()) + " triangles)";
    }
    found.triangles += static_cast<std::int64_t>(mesh.triangles.size());
    ++found.levels;
}

void check_surface(const Levels& levels, std::int64_t i, const Atlas& atlas, const Context& context, Found& same, Found& coarser) {
    constexpr std::array<std::int64_t, 3> kParts{4, 16, 64};  // triangles of the exact surface to those of a level
    const PreparedLevels& of = levels.surfaces()[static_cast<std::size_t>(i)];
    SurfaceOptions options;
    (of.key.is_contour ? options.contours : options.objects) = {of.key.voxel};
    const Surface exact = atlas.extract(of.key.tau, options, context);
    if (same.violation.empty() && corners_of(levels.within(i, 0).surface) != corners_of(exact))
        same.violation = name_of(of.key) + ": its finest level is not the surface of the store";
    same.triangles += static_cast<std::int64_t>(exact.triangles.size()), ++same.levels;
    double last = -1;
    for (const std::int64_t part : kParts) {
        const SimplifiedSurface level = levels.at_most(i, of.triangles / part);
        if (level.distance == last) continue;  // the coarsest, once more
        last = level.distance;
        check_level(level, exact, atlas.info(), context, coarser);
        if (!coarser.violation.empty()) {
            coarser.violation = name_of(of.key) + ": " + coarser.violation;
            return;
        }
    }
}

CheckResult result_of(const char* name, const Found& found, const char* what) {
    const std::string looked = std::to_string(found.triangles) + " triangles of " + std::to_string(found.levels) + " " + what;
    return {name, found.violation.empty(), found.violation.empty() ? looked : found.violation};
}

}  // namespace

std::vector<CheckResult> verify_levels(const Levels& levels, const Atlas& atlas, const Context& context) {
    const EnvironmentScope scope(context);
    Found same, coarser;
    try {
        for (std::size_t i = 0; i < levels.surfaces().size(); ++i)
            check_surface(levels, static_cast<std::int64_t>(i), atlas, context, same, coarser);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input && error.kind() != ErrorKind::not_found) throw;
        return {{"levels_can_be_read", false, error.text().where + ": " + error.text().what}};
    }
    return {result_of("levels_hold_exact_surfaces", same, "surfaces"), result_of("levels_keep_topology", coarser, "levels")};
}

}  // namespace isoatlas

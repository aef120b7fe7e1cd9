#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

#include "field/require_isovalue.h"
#include "field/slab_work.h"
#include "geometry/seen_lengths.h"
#include "geometry/vectors.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "mesh/count_cells.h"
#include "mesh/extract_level.h"
#include "mesh/keep_contours.h"
#include "mesh/select_cells.h"
#include "mesh/thin_points.h"
#include "octree_front/front_level.h"
#include "octree_front/front_mesh.h"
#include "octree_front/front_phases.h"
#include "octree_front/leaf_deviation.h"

namespace isoatlas {
namespace {

/// How far the exact surface may be from what leaves draw. A distance is in voxels; seen from a viewpoint, it is physical.
class LeafLimit {
public:
    LeafLimit(const TauLevel& level, const FrontOptions& options)
        : space_{level.info().geometry, level.window ? level.window->origin : Index3{}}, options_(options) {
        if (options.from) seen_.emplace(*options.from);
    }
    [[nodiscard]] bool is_limited() const { return seen_ || std::isfinite(options_.deviation); }
    /// Where distances are measured; null: among voxels.
    [[nodiscard]] const PhysicalLeaves* space() const { return seen_ ? &space_ : nullptr; }
    /// A distance as it is limited: in pixels, or in voxels.
    [[nodiscard]] double measured(const FrontLeaf& leaf, double distance) const {
        if (!seen_) return distance;
        const Index3 first = leaf.position() - 1;
        const auto point = [&](double x, double y, double z) {  // of the leaf, each from 0 to 1
            const auto width = static_cast<double>(leaf.width());
            return space_.point({static_cast<double>(first[0]) + x * width, static_cast<double>(first[1]) + y * width,
                                 static_cast<double>(first[2]) + z * width});
        };
        const Vec3 centre = point(0.5, 0.5, 0.5);
        double radius = 0;
        for (int corner = 0; corner < 8; ++corner)
            radius = std::max(radius, norm(minus(point(corner & 1, corner >> 1 & 1, corner >> 2), centre)));
        return seen_->pixels(distance, centre, radius);
    }
    [[nodiscard]] bool allows(const FrontLeaf& leaf, double distance) const {
        return measured(leaf, distance) <= (seen_ ? options_.pixels : options_.deviation);
    }

private:
    PhysicalLeaves space_;
    const FrontOptions& options_;
    std::optional<SeenLengths> seen_;
};

void find_all_fans(const FrontLeaves& leaves, std::vector<RowFans>& fans, const Context& context) {
    fans.resize(static_cast<std::size_t>(leaves.rows()));
    for_each_slab_of(1, context, kFrontPhases["leaves"], leaves.rows(),
                     [&](const Slab& slab) { find_fans(leaves, slab.z_begin, fans[static_cast<std::size_t>(slab.z_begin)]); });
}

/// Finds the fans of the leaves, and divides those that are too far from the exact surface until there is none. Returns the greatest
/// distance as it is limited; infinity if it is not.
double fit(const TauLevel& level, const LeafLimit& limit, FrontLeaves& leaves, std::vector<RowFans>& fans, const Context& context) {
    const auto rows = static_cast<std::size_t>(leaves.rows());
    std::vector<std::vector<double>> distance(rows);
    for (;;) {
        find_all_fans(leaves, fans, context);
        if (!limit.is_limited()) return std::numeric_limits<double>::infinity();
        for_each_slab_of(1, context, kFrontPhases["leaves"], leaves.rows(), [&](const Slab& slab) {
            const auto row = static_cast<std::size_t>(slab.z_begin);
            distance[row].clear();
            visit_grid(level.volume, [&]<class T>(const SampleGrid<T>& grid) {
                const LeafDeviation<T> deviation(grid, level.tau, leaves.blocks(), limit.space());
                std::size_t fan = 0, begin = 0;
                for (const FrontLeaf& leaf : leaves.leaves(slab.z_begin)) {
                    distance[row].push_back(0);
                    if (leaf.level == 0) continue;
                    const std::span<const EdgeHit> loop = std::span(fans[row].hits).subspan(begin, fans[row].end[fan] - begin);
                    distance[row].back() = deviation(leaf, loop, fans[row].centre[fan]);
                    begin = fans[row].end[fan++];
                }
            });
        });
        const std::int64_t divided = leaves.divide(
            [&](std::int64_t row, std::size_t i) {
                const FrontLeaf& leaf = leaves.leaves(row)[i];
                return leaf.level > 0 && !limit.allows(leaf, distance[static_cast<std::size_t>(row)][i]);
            },
            context);
        if (divided > 0) continue;
        double worst = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            const std::vector<FrontLeaf>& of_row = leaves.leaves(static_cast<std::int64_t>(row));
            for (std::size_t i = 0; i < of_row.size(); ++i) worst = std::max(worst, limit.measured(of_row[i], distance[row][i]));
        }
        return worst;
    }
}

/// Does a block touch the cells between these samples, those to the padding included?
bool touches(const FrontLeaf& leaf, const SampleBox& box) {
    const Index3 first = leaf.position();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (first[axis] + leaf.width() <= box.begin[axis] || first[axis] > box.end[axis]) return false;
    }
    return true;
}

std::int64_t number_of(const FrontLeaves& leaves) {
    std::int64_t number = 0;
    for (std::int64_t row = 0; row < leaves.rows(); ++row) number += static_cast<std::int64_t>(leaves.leaves(row).size());
    return number;
}

/// About how many triangles leaves make.
std::int64_t estimated_triangles(const FrontLeaves& leaves) {
    std::int64_t triangles = 0;
    for (std::int64_t row = 0; row < leaves.rows(); ++row) {
        for (const FrontLeaf& leaf : leaves.leaves(row)) triangles += leaf.level == 0 ? 2 : 5;
    }
    return triangles;
}

/// The largest leaves that the options allow; smaller ones, as long as they make at most so many triangles as wanted.
std::unique_ptr<FrontLeaves> choose_leaves(const CoalescibleBlocks& blocks, const FrontOptions& options, const Context& context) {
    std::unique_ptr<FrontLeaves> chosen;
    for (int largest = options.max_level; largest >= 0; --largest) {
        auto leaves = std::make_unique<FrontLeaves>(
            blocks,
            [&](const FrontLeaf& leaf) {
                return leaf.level <= largest &&
                       std::ranges::none_of(options.exact, [&](const SampleBox& box) { return touches(leaf, box); });
            },
            context);
        if (chosen && estimated_triangles(*leaves) > options.triangles) break;
        chosen = std::move(leaves);
        if (estimated_triangles(*chosen) >= options.triangles) break;
    }
    return chosen;
}

/// The exact surface, or points of it, where the options ask for it in place of a front. Returns whether they do.
bool extract_instead(const TauLevel& level, const FrontOptions& options, const ExtractOptions& how, const ChosenComponents& components,
                     const Context& context, FrontSurface& front, std::int64_t* cells) {
    Surface& surface = front.surface;
    const auto has_few = [&](std::int64_t triangles) { return options.exact_triangles > 0 && triangles <= options.exact_triangles; };
    const std::int64_t most = how.surface.max_triangles;  // beyond it a front may be what is left
    const auto has_too_many = [&](std::int64_t triangles) {
        return options.exact_above > 0 && triangles > options.exact_above && (most == 0 || triangles <= most);
    };
    bool has_few_of_all = false;
    const auto wanted = [&](std::int64_t triangles) {
        has_few_of_all = has_few(triangles);
        if (has_few_of_all) return ExtractionParts::all;
        return !has_too_many(triangles) ? ExtractionParts::none : options.points > 0 ? ExtractionParts::hits : ExtractionParts::all;
    };
    const ExtractionParts made = extract_parts(wanted, level, how, components, context, surface, cells);
    if (made == ExtractionParts::none) return false;
    if (made == ExtractionParts::all) return has_few_of_all || has_too_many(std::ssize(surface.triangles));  // of the chosen components
    constexpr std::int64_t kTrianglesOfPoint = 2;  // of a closed surface, by Euler's formula
    const BigVector<float> areas = areas_of_hits(components.contours, level.info().geometry, context, surface);
    if (!has_too_many(kTrianglesOfPoint * (std::ssize(areas) - std::ranges::count(areas, 0.0F)))) return false;
    front.spacing = std::sqrt(thin_points(areas, options.points, context, surface));
    return true;
}

}  // namespace

void require_front(const VolumeInfo& info, const FrontOptions& options, const SurfaceOptions& surface) {
    if (info.extent.rank == 2)
        throw Error(ErrorKind::unsupported, {.what = "a front of a 2D image", .expected = "a 3D volume", .next = "extract its curves"});
    const auto require = [](bool holds, const char* what, const char* expected) {
        if (!holds) throw Error(ErrorKind::usage, {.what = what, .expected = expected});
    };
    require(options.max_level >= 0 && options.max_level <= CoalescibleBlocks::kMaxLevel, "the greatest level of a front", "0 to 5");
    require(surface.boundary == Boundary::closed, "a front that is open at the border of the volume", "a closed one");
    require(options.triangles >= 0, "the triangles of a front", "0 or more");
    require(options.exact_triangles >= 0 && options.exact_above >= 0, "the triangles of an exact surface", "0 or more");
    require(options.points >= 0, "the points in place of a surface", "0 or more");
    require(options.points == 0 || surface.normals, "points in place of a surface without normals", "normals");
    require(options.deviation > 0, "the deviation of a front", "more than 0 voxels");
    require(options.pixels > 0, "the pixels of a front", "more than 0");
    require(!options.from || std::isinf(options.deviation), "a front with a deviation that is seen from somewhere", "one of them");
    if (options.from) require_viewpoint(*options.from);
    for (const SampleBox& box : options.exact) require(is_inside(box, info.extent), "a region of interest", "samples of the volume");
}

FrontSurface extract_front_level(const TauLevel& level, const FrontOptions& options, const ExtractOptions& how, const Context& context,
                                 std::int64_t* cells) {
    const ChosenComponents components = choose_components(level, how, context);
    FrontSurface front;
    if ((options.exact_triangles > 0 || options.exact_above > 0) && extract_instead(level, options, how, components, context, front, cells))
        return front;
    front.surface = {};
    const CoalescibleBlocks blocks(level.high, std::max(options.max_level, 1), context);
    const std::unique_ptr<FrontLeaves> leaves = choose_leaves(blocks, options, context);
    if (components.contours.empty()) require_triangles(number_of(*leaves), how.surface, "at least ");  // a leaf has one or more
    std::vector<RowFans> fans;
    const double measured = fit(level, {level, options}, *leaves, fans, context);

    front.leaves.assign(static_cast<std::size_t>(options.max_level) + 1, 0);
    (options.from ? front.pixels : front.deviation) = measured;
    for (std::int64_t row = 0; row < leaves->rows(); ++row) {
        for (const FrontLeaf& leaf : leaves->leaves(row)) ++front.leaves[static_cast<std::size_t>(leaf.level)];
    }
    Surface& surface = front.surface;
    describe(surface, level.info(), level.tau, how.interpolant, how.tunnel_height);
    visit_grid(level.volume, [&]<class T>(const SampleGrid<T>& grid) {
        FrontMesh<T>(level, grid, *leaves, how, context, components.get()).write(fans, surface);
    });
    if (cells != nullptr) {
        *cells = components.contours.empty() ? count_cells(level, how.surface.boundary, context)
                                             : count_cells(level, how.surface.boundary, *components.all, components.contours, context);
    }
    if (!components.contours.empty()) keep_contours(components.contours, context, surface);
    require_triangles(static_cast<std::int64_t>(surface.triangles.size()), how.surface);
    if (how.surface.ids)
        write_ids(*components.all, context, surface);
    else
        surface.contour.clear();
    return front;
}

FrontSurface extract_front(const Volume& volume, double tau, const FrontOptions& options, const ExtractOptions& how,
                           const Context& context) {
    const EnvironmentScope scope(context);
    require_isovalue(tau);
    require_front(volume.info, options, how.surface);
    const HighBits high = classify(volume, tau, context);
    return extract_front_level({volume, tau, high}, options, how, context);
}

}  // namespace isoatlas

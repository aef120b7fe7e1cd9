#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

#include "field/require_isovalue.h"
#include "field/slab_work.h"
#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "mesh/count_cells.h"
#include "mesh/extract_level.h"
#include "mesh/select_cells.h"
#include "octree_front/front_level.h"
#include "octree_front/front_mesh.h"
#include "octree_front/front_phases.h"
#include "octree_front/leaf_deviation.h"

namespace isoatlas {
namespace {

/// How far the exact surface may be from what a leaf draws.
double allowed(const FrontOptions& options, const FrontLeaf& leaf) {
    if (!options.eye) return options.deviation;
    const Index3 first = leaf.position() - 1;
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto low = static_cast<double>(first[axis]), high = low + static_cast<double>(leaf.width());
        const double away = std::max({low - options.eye->position[axis], options.eye->position[axis] - high, 0.0});
        squared += away * away;
    }
    return options.eye->slope * std::sqrt(squared);
}

void find_all_fans(const FrontLeaves& leaves, std::vector<RowFans>& fans, const Context& context) {
    fans.resize(static_cast<std::size_t>(leaves.rows()));
    for_each_slab_of(1, context, kFrontPhases["leaves"], leaves.rows(),
                     [&](const Slab& slab) { find_fans(leaves, slab.z_begin, fans[static_cast<std::size_t>(slab.z_begin)]); });
}

/// Finds the fans of the leaves, and divides those that are too far from the exact surface until there is none. Returns the greatest
/// distance; infinity if no limit is asked for.
double fit(const TauLevel& level, const FrontOptions& options, FrontLeaves& leaves, std::vector<RowFans>& fans, const Context& context) {
    const auto rows = static_cast<std::size_t>(leaves.rows());
    std::vector<std::vector<double>> distance(rows);
    const bool is_limited = options.eye || std::isfinite(options.deviation);
    for (;;) {
        find_all_fans(leaves, fans, context);
        if (!is_limited) return std::numeric_limits<double>::infinity();
        for_each_slab_of(1, context, kFrontPhases["leaves"], leaves.rows(), [&](const Slab& slab) {
            const auto row = static_cast<std::size_t>(slab.z_begin);
            distance[row].clear();
            visit_grid(level.volume, [&]<class T>(const SampleGrid<T>& grid) {
                const LeafDeviation<T> deviation(grid, level.tau, leaves.blocks());
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
                return leaf.level > 0 && distance[static_cast<std::size_t>(row)][i] > allowed(options, leaf);
            },
            context);
        if (divided > 0) continue;
        double worst = 0;
        for (const std::vector<double>& of_row : distance) {
            for (const double one : of_row) worst = std::max(worst, one);
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
    require(options.deviation > 0, "the deviation of a front", "more than 0 voxels");
    require(!options.eye || (options.eye->slope > 0 && std::isfinite(options.eye->slope)), "the slope of an eye", "a number above 0");
    require(!options.eye || std::ranges::all_of(options.eye->position, [](double x) { return std::isfinite(x); }), "the place of an eye",
            "three numbers");
    for (const SampleBox& box : options.exact) require(is_inside(box, info.extent), "a region of interest", "samples of the volume");
}

FrontSurface extract_front_level(const TauLevel& level, const FrontOptions& options, const ExtractOptions& how, const Context& context,
                                 std::int64_t* cells) {
    std::optional<Components> components;
    if (needs_representatives(how.surface))
        components = find_components(level, tunnel_height_of(how.interpolant, how.tunnel_height), context);
    IdArray<ContourNumber, std::uint8_t> chosen;
    if (components) chosen = chosen_contours(level, *components, how.surface);

    const CoalescibleBlocks blocks(level.high, std::max(options.max_level, 1), context);
    const std::unique_ptr<FrontLeaves> leaves = choose_leaves(blocks, options, context);
    if (chosen.empty()) require_triangles(number_of(*leaves), how.surface, "at least ");  // a leaf has one or more
    std::vector<RowFans> fans;
    const double deviation = fit(level, options, *leaves, fans, context);

    FrontSurface front{{}, std::vector<std::int64_t>(static_cast<std::size_t>(options.max_level) + 1, 0), deviation};
    for (std::int64_t row = 0; row < leaves->rows(); ++row) {
        for (const FrontLeaf& leaf : leaves->leaves(row)) ++front.leaves[static_cast<std::size_t>(leaf.level)];
    }
    Surface& surface = front.surface;
    describe(surface, level.info(), level.tau, how.interpolant, how.tunnel_height);
    visit_grid(level.volume, [&]<class T>(const SampleGrid<T>& grid) {
        FrontMesh<T>(level, grid, *leaves, how, context, components ? &*components : nullptr).write(fans, surface);
    });
    if (cells != nullptr) {
        *cells = chosen.empty() ? count_cells(level, how.surface.boundary, context)
                                : count_cells(level, how.surface.boundary, *components, chosen, context);
    }
    if (!chosen.empty()) keep_contours(chosen, surface);
    require_triangles(static_cast<std::int64_t>(surface.triangles.size()), how.surface);
    if (how.surface.ids)
        write_ids(*components, context, surface);
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

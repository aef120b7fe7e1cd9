#include "octree_front/front_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/sample_types.h"
#include "field/slab_work.h"
#include "mesh/extract_level.h"
#include "mesh/select_cells.h"
#include "octree_front/front_phases.h"

namespace isoatlas {
namespace {

constexpr EdgeHit kNoHit{{0, 0, 0}, -1};

/// Bit e: edge e of a cell is hit.
unsigned hit_edges(const FrontLeaf& cell) { return cell_cases().hit_edges[static_cast<std::size_t>(cell.pattern)]; }

/// The mean of points, in place and in normal.
void write_mean(std::span<const std::int64_t> points, std::int64_t target, Surface& surface) {
    Vec3 position{}, normal{};
    for (const std::int64_t point : points) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            position[axis] += surface.points[point][axis];
            if (!surface.normals.empty()) normal[axis] += static_cast<double>(surface.normals[point][axis]);
        }
    }
    for (double& x : position) x /= static_cast<double>(points.size());
    surface.points[target] = position;
    if (!surface.contour.empty()) surface.contour[target] = surface.contour[points.front()];
    if (surface.normals.empty()) return;
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    surface.normals[target] = surface.normals[points.front()];
    for (std::size_t axis = 0; length > 1e-6 && axis < 3; ++axis) surface.normals[target][axis] = static_cast<float>(normal[axis] / length);
}

}  // namespace

void find_fans(const FrontLeaves& leaves, std::int64_t row, RowFans& fans) {
    fans = {};
    const auto is_fan = [](const FrontLeaf& leaf) { return leaf.level > 0; };
    const auto number = static_cast<std::size_t>(std::ranges::count_if(leaves.leaves(row), is_fan));
    fans.centre.reserve(number), fans.end.reserve(number), fans.hits.reserve(5 * number);
    if (number > 0) leaves.prefetch_samples(row);
    for (const FrontLeaf& leaf : leaves.leaves(row)) {
        if (leaf.level == 0) continue;
        const std::size_t begin = fans.hits.size();
        add_loop(leaves, leaf, fans.hits);
        const std::span<const EdgeHit> loop = std::span(fans.hits).subspan(begin);
        const std::optional<EdgeHit> inside = hit_inside(leaves.blocks(), leaf, loop);
        const bool is_triangle = !inside && loop.size() == 3;
        fans.centre.push_back(inside.value_or(kNoHit));
        fans.triangles += is_triangle ? 1 : static_cast<std::int64_t>(loop.size());
        fans.points += !inside && !is_triangle;
        fans.end.push_back(fans.hits.size());
    }
}

template <class T>
FrontMesh<T>::FrontMesh(const TauLevel& level, const SampleGrid<T>& grid, const FrontLeaves& leaves, const ExtractOptions& how,
                        const Context& context, const Components* components)
    : level_(level),
      grid_{grid.samples, grid.extent, grid.layout, level.window ? level.window->origin : Index3{}},
      leaves_(leaves),
      context_(context),
      hits_(leaves),
      domain_(level.high, Boundary::closed),
      map_(level.info().geometry, level.window ? level.window->whole : level.info().extent),
      flip_(is_mirrored(level.info())),
      cells_(grid_, level.tau, domain_, map_, how, flip_),
      options_(how.surface),
      components_(components) {}

template <class T>
auto FrontMesh<T>::state_of(const FrontLeaf& leaf) const -> typename CellWriter<T>::State {
    const Index3& cell = leaf.block;
    return cells_.state_of(cell[0], cell[1] - 1, cell[2] - 1, leaf.pattern, cells_.has_tunnels(cell[1] - 1, cell[2] - 1));
}

template <class T>
void FrontMesh<T>::count_row(std::int64_t row, const RowFans& fans) {
    auto& [points, triangles] = first_[static_cast<std::size_t>(row)];
    points = fans.points, triangles = fans.triangles;
    thread_local std::vector<EdgeHit> hits;
    hits.assign(fans.hits.begin(), fans.hits.end());
    std::ranges::copy_if(fans.centre, std::back_inserter(hits), [](const EdgeHit& centre) { return centre.axis >= 0; });
    for (const FrontLeaf& leaf : leaves_.leaves(row)) {
        if (leaf.level > 0) continue;
        const auto size = cells_.size_of(state_of(leaf));
        points += size.points, triangles += size.triangles;
        for (unsigned edges = hit_edges(leaf); edges != 0; edges &= edges - 1)
            hits.push_back(hit_on_edge(leaves_.blocks(), leaf, std::countr_zero(edges)));
    }
    hits_.keep(row, hits);
}

template <class T>
void FrontMesh<T>::write(const std::vector<RowFans>& fans, Surface& surface) {
    first_.assign(fans.size(), {0, 0});
    for_each_slab_of(1, context_, kFrontPhases["points"], leaves_.rows(),
                     [&](const Slab& slab) { count_row(slab.z_begin, fans[static_cast<std::size_t>(slab.z_begin)]); });
    std::int64_t point = hits_.number(), triangle = 0;
    for (auto& [points, triangles] : first_) {
        point += std::exchange(points, point);
        triangle += std::exchange(triangles, triangle);
    }
    if (!selects_components(options_)) require_triangles(triangle, options_);
    resize_for_overwrite(surface.points, static_cast<std::size_t>(point));
    resize_for_overwrite(surface.normals, static_cast<std::size_t>(options_.normals ? point : 0));
    resize_for_overwrite(surface.contour, static_cast<std::size_t>(components_ != nullptr ? point : 0));
    resize_for_overwrite(surface.triangles, static_cast<std::size_t>(triangle));

    const HitWriter<T> writer(grid_, level_.tau, map_, domain_, surface);
    for_each_slab_of(1, context_, kFrontPhases["points"], leaves_.rows(), [&](const Slab& slab) {
        hits_.for_bundles(slab.z_begin, [&](std::int64_t y, std::int64_t z, const std::vector<HitLine>& lines) {
            writer.write_lines(y, z, lines);
            if (components_ == nullptr) return;
            for (const HitLine& line : lines) write_contours(*components_, level_.high, line, surface);
        });
    });
    for_each_slab_of(1, context_, kFrontPhases["triangles"], leaves_.rows(),
                     [&](const Slab& slab) { write_row(slab.z_begin, fans[static_cast<std::size_t>(slab.z_begin)], surface); });
}

template <class T>
void FrontMesh<T>::write_row(std::int64_t row, const RowFans& fans, Surface& surface) const {
    std::int64_t next_point = first_[static_cast<std::size_t>(row)][0];
    std::array<std::int64_t, 3>* triangle = surface.triangles.data() + first_[static_cast<std::size_t>(row)][1];
    std::size_t fan = 0, begin = 0;
    for (const FrontLeaf& leaf : leaves_.leaves(row)) {
        if (leaf.level > 0) {
            write_fan(std::span(fans.hits).subspan(begin, fans.end[fan] - begin), fans.centre[fan], next_point, triangle, surface);
            begin = fans.end[fan++];
            continue;
        }
        const typename CellWriter<T>::State state = state_of(leaf);
        std::array<std::int64_t, 20> point{};
        for (unsigned edges = hit_edges(leaf); edges != 0; edges &= edges - 1) {
            const int edge = std::countr_zero(edges);
            point[static_cast<std::size_t>(edge)] = hits_.point_of(hit_on_edge(leaves_.blocks(), leaf, edge));
        }
        cells_.write_cell(state, leaf.block - 1, point.data(), next_point, triangle, surface);
    }
}

template <class T>
void FrontMesh<T>::write_fan(std::span<const EdgeHit> loop, const EdgeHit& centre, std::int64_t& next_point,
                             std::array<std::int64_t, 3>*& triangle, Surface& surface) const {
    thread_local std::vector<std::int64_t> points;
    points.clear();
    for (const EdgeHit& hit : loop) points.push_back(hits_.point_of(hit));
    const std::size_t second = flip_ ? 2 : 1, third = flip_ ? 1 : 2;
    const auto add = [&](const std::array<std::int64_t, 3>& corners) { *triangle++ = {corners[0], corners[second], corners[third]}; };
    if (centre.axis < 0 && points.size() == 3) return add({points[0], points[1], points[2]});
    std::int64_t middle;
    if (centre.axis >= 0) {
        middle = hits_.point_of(centre);
    } else {
        middle = next_point++;
        write_mean(points, middle, surface);
    }
    for (std::size_t i = 0; i < points.size(); ++i) add({middle, points[i], points[(i + 1) % points.size()]});
}

#define ISOATLAS_INSTANTIATE(T) template class FrontMesh<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas

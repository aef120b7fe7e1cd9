#include "octree_front/front_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sample_types.h"
#include "field/slab_work.h"
#include "mesh/extract_level.h"
#include "mesh/select_cells.h"
#include "octree_front/front_phases.h"

namespace isoatlas {
namespace {

constexpr EdgeHit kNoHit{{0, 0, 0}, -1};

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
    std::vector<EdgeHit> loop;
    for (const FrontLeaf& leaf : leaves.leaves(row)) {
        if (leaf.level == 0) continue;
        find_loop(leaves, leaf, loop);
        const std::optional<EdgeHit> inside = hit_inside(leaves.blocks(), leaf, loop);
        const bool is_triangle = !inside && loop.size() == 3;
        fans.centre.push_back(inside.value_or(kNoHit));
        fans.triangles += is_triangle ? 1 : static_cast<std::int64_t>(loop.size());
        fans.points += !inside && !is_triangle;
        fans.hits.insert(fans.hits.end(), loop.begin(), loop.end());
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
      mask_((level.high.extent().size[1] + 2) * (level.high.extent().size[2] + 2), level.high.words()),
      domain_(level.high, Boundary::closed),
      map_(level.info().geometry, level.window ? level.window->whole : level.info().extent),
      flip_(is_mirrored(level.info())),
      cells_(grid_, level.tau, domain_, map_, how, flip_),
      groups_(domain_),
      options_(how.surface),
      components_(components) {
    domain_.only = &mask_;
}

template <class T>
auto FrontMesh<T>::state_of(const FrontLeaf& leaf) const -> typename CellWriter<T>::State {
    const Index3& cell = leaf.block;
    return cells_.state_of(cell[0], cell[1] - 1, cell[2] - 1, leaves_.blocks().pattern(0, cell),
                           cells_.has_tunnels(cell[1] - 1, cell[2] - 1));
}

template <class T>
void FrontMesh<T>::mark(std::int64_t row, const EdgeHit& hit) {
    const std::int64_t y = hit.position[1], z = hit.position[2];
    if (!leaves_.owns(row, y, z)) return;  // the row that does marks it, too
    const std::int64_t number = domain_.row_number(y - 1, z - 1);
    if (layout_[number].hit_words == 0) mask_.clear(number);  // few rows have hits: those of edges of blocks
    mark_word(layout_[number].hit_words, hit.position[0] / 64);
    mask_.add(number, hit.axis, hit.position[0]);
}

template <class T>
void FrontMesh<T>::mark_hits(std::int64_t row, const RowFans& fans) {
    if (leaves_.leaves(row).empty()) return;
    for (const EdgeHit& hit : fans.hits) mark(row, hit);
    for (const EdgeHit& centre : fans.centre) {
        if (centre.axis >= 0) mark(row, centre);
    }
    for (const FrontLeaf& leaf : leaves_.leaves(row)) {
        if (leaf.level > 0) continue;
        const unsigned edges = cell_cases().hit_edges[static_cast<std::size_t>(leaves_.blocks().pattern(0, leaf.block))];
        for (int edge = 0; edge < 12; ++edge) {
            if ((edges >> edge & 1) != 0) mark(row, hit_on_edge(leaves_.blocks(), 0, leaf.block, edge));
        }
    }
    const int top = leaves_.blocks().max_level();
    const std::int64_t rows_y = leaves_.blocks().blocks(top)[1], width = std::int64_t{1} << top;
    const std::int64_t first_y = row % rows_y * width, first_z = row / rows_y * width;
    const std::int64_t end_y = std::min(first_y + width, domain_.rows_y()), end_z = std::min(first_z + width, domain_.rows_z());
    for (std::int64_t z = first_z; z < end_z; ++z) {
        for (std::int64_t y = first_y; y < end_y; ++y) {
            const std::int64_t number = domain_.row_number(y - 1, z - 1);
            RowOffsets& place = layout_[number];
            if (place.hit_words == 0) continue;
            const auto [x_hits, y_hits, z_hits] = mask_.number(number);
            place.x_hits = x_hits, place.y_hits = y_hits, place.z_hits = z_hits;
        }
    }
}

template <class T>
std::int64_t FrontMesh<T>::point_of(const EdgeHit& hit) const {
    const std::int64_t row = domain_.row_number(hit.position[1] - 1, hit.position[2] - 1);
    const RowOffsets& place = layout_[row];
    const std::int64_t first = hit.axis == 0 ? place.point : hit.axis == 1 ? place.first_y() : place.first_z();
    return first + mask_.rank(row, hit.axis, hit.position[0]);
}

template <class T>
void FrontMesh<T>::write(const std::vector<RowFans>& fans, Surface& surface) {
    resize_for_overwrite(layout_, static_cast<std::size_t>(domain_.rows_y() * domain_.rows_z() + 1));
    const Slices slices{domain_.rows_z(), grid_.extent.slice()};
    for_each_slab(context_, kFrontPhases["points"], slices, [&](const Slab& slab) {
        std::fill(layout_.begin() + slab.z_begin * domain_.rows_y(), layout_.begin() + slab.z_end * domain_.rows_y(), RowOffsets{});
    });
    layout_.back() = {};
    first_.assign(fans.size() + 1, {0, 0});
    for_each_slab_of(1, context_, kFrontPhases["points"], leaves_.rows(), [&](const Slab& slab) {
        const std::int64_t row = slab.z_begin;
        const auto at = static_cast<std::size_t>(row);
        mark_hits(row, fans[at]);
        first_[at] = {fans[at].points, fans[at].triangles};
        for (const FrontLeaf& leaf : leaves_.leaves(row)) {
            if (leaf.level > 0) continue;
            const auto [triangles, points] = cells_.size_of(state_of(leaf));
            first_[at][0] += points, first_[at][1] += triangles;
        }
    });
    exclusive_scan_counts(layout_);
    std::int64_t point = layout_.back().point, triangle = 0;
    for (auto& [points, triangles] : first_) {
        point += std::exchange(points, point);
        triangle += std::exchange(triangles, triangle);
    }
    if (!selects_components(options_)) require_triangles(triangle, options_);
    resize_for_overwrite(surface.points, static_cast<std::size_t>(point));
    resize_for_overwrite(surface.normals, static_cast<std::size_t>(options_.normals ? point : 0));
    resize_for_overwrite(surface.contour, static_cast<std::size_t>(components_ != nullptr ? point : 0));
    resize_for_overwrite(surface.triangles, static_cast<std::size_t>(triangle));

    for_each_slab(context_, kFrontPhases["points"], slices, [&](const Slab& slab) {
        for (std::int64_t z = slab.z_begin - 1; z < slab.z_end - 1; ++z) {
            for (std::int64_t group = groups_.begin(); group < groups_.end(); ++group) {
                const auto [begin, end] = RowGroups::rows(domain_, group);
                for (std::int64_t y = begin; y < end; ++y) {
                    const RowOffsets& place = layout_[domain_.row_number(y, z)];
                    if (place.x_hits + place.y_hits + place.z_hits > 0) groups_.use(group, z);
                }
            }
        }
    });
    const HitWriter<T> hits(grid_, level_.tau, map_, domain_, surface);
    for_each_slab_of(1, context_, kFrontPhases["points"], hits.bundles(),
                     [&](const Slab& bundle) { hits.write(bundle.z_begin, layout_, groups_); });
    for_each_slab_of(1, context_, kFrontPhases["points"], domain_.rows_z(), [&](const Slab& slab) {
        const std::int64_t z = slab.z_begin - 1;
        for (std::int64_t y = -1; y + 1 < domain_.rows_y(); ++y) {
            const RowOffsets& place = layout_[domain_.row_number(y, z)];
            if (place.x_hits + place.y_hits + place.z_hits == 0) continue;
            if (y < 0 || z < 0) hits.write_outside(y, z, place);
            if (components_ != nullptr) write_contours(*components_, domain_, y, z, place, surface);
        }
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
        for (int edge = 0; edge < 12; ++edge) {
            if ((cell_cases().hit_edges[static_cast<std::size_t>(state.pattern)] >> edge & 1) != 0)
                point[static_cast<std::size_t>(edge)] = point_of(hit_on_edge(leaves_.blocks(), 0, leaf.block, edge));
        }
        cells_.write_cell(state, leaf.block - 1, point.data(), next_point, triangle, surface);
    }
}

template <class T>
void FrontMesh<T>::write_fan(std::span<const EdgeHit> loop, const EdgeHit& centre, std::int64_t& next_point,
                             std::array<std::int64_t, 3>*& triangle, Surface& surface) const {
    thread_local std::vector<std::int64_t> points;
    points.clear();
    for (const EdgeHit& hit : loop) points.push_back(point_of(hit));
    const std::size_t second = flip_ ? 2 : 1, third = flip_ ? 1 : 2;
    const auto add = [&](const std::array<std::int64_t, 3>& corners) { *triangle++ = {corners[0], corners[second], corners[third]}; };
    if (centre.axis < 0 && points.size() == 3) return add({points[0], points[1], points[2]});
    std::int64_t middle;
    if (centre.axis >= 0) {
        middle = point_of(centre);
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

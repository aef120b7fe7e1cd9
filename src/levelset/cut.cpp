#include "levelset/cut_level.h"

#include <algorithm>
#include <limits>

#include "critical/bodies.h"
#include "field/slab_work.h"
#include "isoatlas/environment.h"
#include "levelset/components.h"
#include "levelset/contour_counts.h"

namespace isoatlas {
namespace {

/// Voxels, physical size and bounds of every object, in the numbering of Components. In scan order: sums do not depend on threads.
void measure_objects(const VolumeInfo& info, const Components& components, IdArray<ObjectNumber, CutObject>& objects) {
    const Extent& extent = info.extent;
    const Geometry& geometry = info.geometry;
    const bool rectilinear = std::ranges::any_of(geometry.coordinates, [](const auto& axis) { return axis.size() > 1; });
    constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();
    for (const ObjectNumber i : objects.ids()) {
        objects[i] = {components.highest[i].number(), 0, 0, 0, 0, 0, {kFar, kFar, kFar}, {-1, -1, -1}, 0, 0};
    }
    for (std::int64_t r = 0; r < components.runs.rows(); ++r) {
        const RunRow row = components.runs.row(r);
        const std::array<std::int64_t, 2> yz{r % extent.size[1], r / extent.size[1]};
        for (std::int64_t i = 1; i < row.changes; i += 2) {
            CutObject& object = objects[components.object_of(row.run(i))];
            const std::int64_t begin = row.change[i - 1] - 1, end = row.change[i] - 1;
            object.voxels += end - begin;
            if (rectilinear) {
                for (std::int64_t x = begin; x < end; ++x) object.measure += voxel_measure(geometry, extent, extent.index(x, yz[0], yz[1]));
            }
            const Index3 low{begin, yz[0], yz[1]}, high{end - 1, yz[0], yz[1]};
            object.box_low = min(object.box_low, low);
            object.box_high = max(object.box_high, high);
        }
    }
    if (rectilinear) return;
    const double voxel = voxel_measure(geometry, extent, 0);
    for (CutObject& object : objects.items()) object.measure = voxel * static_cast<double>(object.voxels);
}

CutContour describe_contour(const Components& components, const ContourCounts& counts, ContourNumber contour) {
    const VoxelId object = components.highest[components.object_of_contour(contour)];
    const Shell shell = components.is_outer(contour) ? Shell::outer : Shell::inner;
    CutContour result{components.contour_id(contour).number(), object.number(), shell, 0, counts.hits[contour]};
    if (components.runs.extent.rank == 3) {
        const std::int64_t chi = counts.chi(contour);
        ISOATLAS_CHECK(chi <= 2 && chi % 2 == 0);
        result.genus = (2 - chi) / 2;
    }
    return result;
}

/// Fills `contours` in the order of `objects` and completes the Betti numbers of the objects.
void group_contours(const Components& components, const ContourCounts& counts, const std::vector<ObjectNumber>& order, Cut& cut) {
    IdArray<ObjectNumber, std::vector<ContourNumber>> cavities(static_cast<std::size_t>(components.objects()));
    for (const LowNumber low : components.outer_object.ids()) {
        if (low != LowNumber(0)) cavities[components.outer_object[low]].push_back(components.wall(low));
    }
    const bool is_3d = components.runs.extent.rank == 3;
    for (std::size_t position = 0; position < order.size(); ++position) {
        CutObject& object = cut.objects[position];
        std::vector<ContourNumber>& inner = cavities[order[position]];
        std::ranges::sort(inner, {}, [&](ContourNumber contour) { return components.contour_id(contour); });
        object.first_contour = static_cast<std::int64_t>(cut.contours.size());
        object.contour_count = 1 + static_cast<std::int64_t>(inner.size());
        cut.contours.push_back(describe_contour(components, counts, Components::outer_contour(order[position])));
        std::int64_t genus = cut.contours.back().genus;
        for (const ContourNumber contour : inner) {
            cut.contours.push_back(describe_contour(components, counts, contour));
            genus += cut.contours.back().genus;
        }
        object.b2 = is_3d ? object.contour_count - 1 : 0;
        object.b1 = is_3d ? genus : object.contour_count - 1;  // docs/theory/4-genus.md#objects
        object.chi = 1 - object.b1 + object.b2;
    }
    ISOATLAS_CHECK(static_cast<std::int64_t>(cut.contours.size()) == components.contours());
}

void label_voxels(const Components& components, const std::vector<ObjectNumber>& order, const Context& context,
                  std::vector<std::int32_t>& label) {
    const Extent& extent = components.runs.extent;
    IdArray<ObjectNumber, std::int32_t> position(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = static_cast<std::int32_t>(i);
    label.assign(static_cast<std::size_t>(extent.voxels()), -1);
    for_each_row(context, kLabelPhases["labels"], extent, [&](std::int64_t y, std::int64_t z) {
        const RunRow row = components.runs.row(y, z);
        const std::int64_t first = extent.index(-1, y, z);  // position p is voxel p - 1
        for (std::int64_t i = 1; i < row.changes; i += 2) {
            std::fill(label.begin() + (first + row.change[i - 1]), label.begin() + (first + row.change[i]),
                      position[components.object_of(row.run(i))]);
        }
    });
}

}  // namespace

Cut cut_level(const TauLevel& level, const CutOptions& options, const Context& context) {
    const double tunnel_height = tunnel_height_of(options.interpolant, options.tunnel_height);
    const Components components = find_components(level, tunnel_height, context);
    const ContourCounts counts = count_contours(level.volume, level.tau, tunnel_height, level.high, components, context);

    IdArray<ObjectNumber, CutObject> objects(static_cast<std::size_t>(components.objects()));
    measure_objects(level.info(), components, objects);
    std::vector<ObjectNumber> order;
    order.reserve(objects.size());
    for (const ObjectNumber object : objects.ids()) order.push_back(object);
    std::ranges::sort(order, [&](ObjectNumber a, ObjectNumber b) {
        return objects[a].voxels != objects[b].voxels ? objects[a].voxels > objects[b].voxels : objects[a].id < objects[b].id;
    });

    Cut result{level.tau, options.interpolant, options.tunnel_height, {}, {}, counts.active_cells, {}};
    for (const ObjectNumber object : order) result.objects.push_back(objects[object]);
    group_contours(components, counts, order, result);
    if (options.label) label_voxels(components, order, context, result.label);
    return result;
}

Cut cut(const Volume& volume, double tau, const CutOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    const HighBits high = classify(volume, tau, context);
    return cut_level({volume, tau, high}, options, context);
}

}  // namespace isoatlas

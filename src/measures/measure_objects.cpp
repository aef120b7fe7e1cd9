// measure_objects() of volumes and stores.
#include <algorithm>
#include <cmath>

#include "atlas/access.h"
#include "atlas/object_window.h"
#include "bricks/stored_samples.h"
#include "critical/bodies.h"
#include "isoatlas/environment.h"
#include "isoatlas/measures.h"
#include "levelset/components.h"
#include "levelset/high_bits.h"
#include "measures/object_walls.h"
#include "measures/surface_parts.h"
#include "measures/voxel_sums.h"

namespace isoatlas {
namespace {

/// Of the surface nothing but points, facets and ids.
SurfaceOptions surface_of(const std::vector<std::int64_t>& objects, std::int64_t max_triangles = 0) {
    SurfaceOptions options;
    options.objects = objects;
    options.max_triangles = max_triangles;
    options.normals = false;
    return options;
}

std::vector<ObjectMeasures> measured(const Surface& surface, const VolumeInfo& info, const MeasuredVoxels& sums, bool thickness,
                                     const Context& context) {
    std::vector<ObjectMeasures> objects(sums.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        sums.describe(i, objects[i]);
        objects[i].tau = surface.tau;
    }
    measure_surface(surface, info, objects, context);
    if (thickness && info.extent.rank == 3) measure_walls(surface, objects, context);
    std::ranges::sort(
        objects, [](const ObjectMeasures& a, const ObjectMeasures& b) { return a.voxels != b.voxels ? a.voxels > b.voxels : a.id < b.id; });
    return objects;
}

/// Adds the samples of a store, some slices at a time.
void add_samples(StoredSamples& samples, const VolumeInfo& info, MeasuredVoxels& sums, const Context& context, LevelQuery& spent) {
    constexpr std::int64_t kSlices = 16;  // two layers of bricks
    const SampleBox all = sums.box();
    std::vector<std::byte> bytes;
    for (std::int64_t begin = all.begin[2]; begin < all.end[2];) {
        SampleBox part = all;
        part.begin[2] = begin;
        part.end[2] = std::min((begin / kSlices + 1) * kSlices, all.end[2]);
        bytes.resize(static_cast<std::size_t>(part.size().product()) * size_of(info.type));
        samples.read_box({part.begin, part.end}, 1, bytes, context, spent);
        sums.add(bytes, part, context);
        begin = part.end[2];
    }
}

}  // namespace

std::vector<ObjectMeasures> measure_objects(const Volume& volume, double tau, const MeasureOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    const Surface surface = extract(
        volume, tau, {.interpolant = options.interpolant, .tunnel_height = options.tunnel_height, .surface = surface_of(options.objects)},
        context);
    const HighBits high = classify(volume, tau, context);
    const Components components =
        find_components({volume, tau, high}, tunnel_height_of(options.interpolant, options.tunnel_height), context);
    MeasuredVoxels sums(volume.info, components, options.objects);
    const Extent& extent = volume.info.extent;
    sums.add(volume.bytes, {{0, 0, 0}, extent.size}, context);
    return measured(surface, volume.info, sums, options.thickness, context);
}

std::vector<ObjectMeasures> measure_objects(const Atlas& atlas, double tau, const AtlasMeasureOptions& options, const Context& context,
                                            QueryCost* cost) {
    const EnvironmentScope scope(context);
    const VolumeInfo& info = atlas.info();
    const std::vector<std::int64_t>& objects = options.objects;
    const double tunnel_height = tunnel_height_of(atlas.interpolant(), atlas.tunnel_height());
    const Surface surface = atlas.extract(tau, surface_of(objects, options.max_triangles), context, cost);
    StoredSamples& samples = AtlasAccess::samples(atlas);
    LevelQuery spent;
    const auto measure = [&](const Components& components, const Index3& origin) {
        MeasuredVoxels sums(info, components, objects, origin);
        add_samples(samples, info, sums, context, spent);
        AtlasAccess::count(atlas, spent, 0, cost);
        return measured(surface, info, sums, options.thickness, context);
    };
    if (objects.size() == 1) {  // from its own part of the store, unless that is most of it
        const std::optional<StoredWindow> window = part_of_object(samples, objects[0], tau, tunnel_height, false, context, spent).window;
        if (window) return measure(find_components(window->at(tau), tunnel_height, context), window->window.origin);
    }
    StoredLevel stored = samples.classify(tau, BrickFlags(), context, spent);
    samples.add_extremes(stored.bricks, context);
    const auto sample = [&](std::int64_t voxel) { return samples.sample(voxel, spent); };
    return measure(find_components({samples.view(), tau, stored.high, &stored.bricks, {}, sample}, tunnel_height, context), {0, 0, 0});
}

}  // namespace isoatlas

// measure_labels(): each label of a label volume as one object.
#include <algorithm>
#include <string>

#include "base/phase.h"
#include "critical/bodies.h"
#include "isoatlas/environment.h"
#include "isoatlas/labels.h"
#include "isoatlas/measures.h"
#include "levelset/components.h"
#include "levelset/high_bits.h"
#include "measures/object_walls.h"
#include "measures/surface_parts.h"
#include "measures/voxel_sums.h"
#include "mesh/label_mask.h"

namespace isoatlas {
namespace {

/// Pieces together: the counts of a surface are those of one object.
void set_pieces(ObjectMeasures& object, const LabelRegion& region) {
    object.tunnels = region.tunnels, object.cavities = region.cavities;
    object.euler = region.components - object.tunnels + object.cavities;
}

ObjectMeasures measured(const Volume& volume, const LabelRegion& region, const LabelMeasureOptions& options, const Context& context) {
    const SampleBox box = box_around(region, volume.info.extent);
    const Volume mask = mask_of(volume, region.label, box);
    const Extent& extent = mask.info.extent;
    SurfaceOptions of_surface;
    of_surface.normals = false;
    Surface surface = extract(mask, kMaskLevel, {.interpolant = options.interpolant, .surface = of_surface}, context);
    std::ranges::fill(surface.object, region.label);
    const HighBits high = classify(mask, kMaskLevel, context);
    const Components components = find_components({mask, kMaskLevel, high}, tunnel_height_of(options.interpolant, 0), context);
    MeasuredVoxels sums(mask.info, components);
    sums.add(mask.bytes, {{0, 0, 0}, extent.size}, context);
    std::vector<ObjectMeasures> object(1);
    sums.describe(0, object[0]);
    object[0].id = region.label;
    object[0].tau = static_cast<double>(region.label);
    const double value = volume.info.calibration.reported(object[0].tau);
    object[0].values = {.mean = value, .min = value, .max = value, .sum = value * static_cast<double>(region.voxels), .deviation = 0};
    measure_surface(surface, mask.info, object, context);
    if (options.thickness && extent.rank == 3) measure_walls(surface, object, context);
    set_pieces(object[0], region);
    return object[0];
}

}  // namespace

std::vector<ObjectMeasures> measure_labels(const Volume& volume, const LabelMeasureOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    const LabelTable table = list_labels(volume, {.interpolant = options.interpolant}, context);
    Context quiet = context;
    quiet.progress = {};
    std::vector<ObjectMeasures> objects;
    for (const LabelRegion& region : table.regions) {
        report(context, only_phase("measures"), static_cast<double>(objects.size()) / static_cast<double>(table.regions.size()));
        objects.push_back(measured(volume, region, options, quiet));
    }
    return objects;
}

}  // namespace isoatlas

// What volume rendering shows: the proposal of the table, materials, opacity curves.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/picture.h"
#include "data/sides.h"

namespace isoatlas::cli {
namespace {

/// The length that opacities refer to: the smallest distance of two samples, physical.
double voxel_of(const VolumeInfo& info) { return *std::min_element(info.geometry.spacing.begin(), info.geometry.spacing.end()); }

std::vector<Material> materials_of(const PictureArguments& picture, const VolumeInfo& info) {
    const Scale scale(info);
    std::vector<Material> materials;
    for (const ShownMaterial& shown : picture.materials) {
        materials.push_back({.name = shown.name,
                             .mean = scale.stored(shown.mean),
                             .sigma = shown.sigma / std::abs(info.calibration.slope),
                             .colour = shown.colour,
                             .density = extinction_of(shown.opacity, voxel_of(info))});
    }
    return materials;
}

TransferCurve curve_of(const ShownCurve& shown, const VolumeInfo& info) {
    const Scale scale(info);
    TransferCurve curve{.name = fmt::format("opacity {:.5g} to {:.5g}", shown.points.front().value, shown.points.back().value)};
    double densest = -1;
    for (const ShownCurve::Point& point : shown.points) {
        curve.points.push_back({scale.stored(point.value), extinction_of(point.opacity, voxel_of(info))});
        curve.colours.push_back(point.colour);
        if (point.opacity > densest) densest = point.opacity, curve.colour = point.colour;
    }
    if (curve.points.front()[0] > curve.points.back()[0]) {  // stored values may fall where calibrated ones rise
        std::reverse(curve.points.begin(), curve.points.end());
        std::reverse(curve.colours.begin(), curve.colours.end());
    }
    return curve;
}

/// With names for the legend.
std::vector<OpacityTent> proposed_tents(Source& source, const std::array<double, 2>& range, std::size_t first_colour) {
    const ObjectTable table = source.objects({.top = 5});
    std::vector<OpacityTent> tents = propose_transfer(table, source.info(), range, static_cast<std::int64_t>(first_colour));
    const Scale scale(source.info());
    for (std::size_t i = 0; i < tents.size(); ++i) {
        OpacityTent& bump = tents[i];
        const bool body = i > 0 && bump.tau == tents[i - 1].tau;
        if (!body) bump.name = fmt::format("opacity {} {:.5g}", scale.is_low() ? "below" : "above", scale.reported(bump.tau));
    }
    return tents;
}

}  // namespace

SceneVolume matter_of(const Arguments& arguments, Source& source, std::size_t first_colour) {
    const PictureArguments& picture = arguments.picture;
    if (!picture.volume) return {};
    const ValueRange range = source.range();
    SceneVolume matter{.range = std::array<double, 2>{range.low, range.high},
                       .shadows = picture.shadows,
                       .sample_distance = picture.sample_distance,
                       .optics = picture.optics,
                       .scattering = picture.scattering};
    if (!picture.materials.empty()) matter.curves = material_transfer(materials_of(picture, source.info()), *matter.range);
    for (const ShownCurve& shown : picture.curves) matter.curves.push_back(curve_of(shown, source.info()));
    if (picture.materials.empty() && picture.curves.empty()) matter.tents = proposed_tents(source, *matter.range, first_colour);
    return matter;
}

}  // namespace isoatlas::cli

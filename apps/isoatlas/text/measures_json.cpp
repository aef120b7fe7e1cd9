#include "text/measures_json.h"

#include <array>
#include <cmath>
#include <utility>

namespace isoatlas::cli {
namespace {

Json quantiles_json(const SizeQuantiles& quantiles) {
    Json list = Json::array();
    for (std::size_t i = 0; i < quantiles.size(); ++i) list.push_back({{"fraction", kSizeFractions[i]}, {"diameter", quantiles[i]}});
    return list;
}

}  // namespace

std::optional<double> millilitres(const std::string& unit) {
    static const std::array<std::pair<const char*, double>, 12> kUnits{{{"m", 1e6},
                                                                        {"dm", 1e3},
                                                                        {"cm", 1},
                                                                        {"mm", 1e-3},
                                                                        {"um", 1e-12},
                                                                        {"\u00b5m", 1e-12},
                                                                        {"\u03bcm", 1e-12},
                                                                        {"micron", 1e-12},
                                                                        {"micrometer", 1e-12},
                                                                        {"nm", 1e-21},
                                                                        {"millimeter", 1e-3},
                                                                        {"meter", 1e6}}};
    for (const auto& [name, factor] : kUnits) {
        if (unit == name) return factor;
    }
    return std::nullopt;
}

Json measures_json(const ObjectMeasures& object, const VolumeInfo& info) {
    const std::optional<double> factor = info.extent.rank == 3 ? millilitres(info.geometry.unit) : std::nullopt;
    Json json{{"id", object.id},
              {"tau", info.calibration.reported(object.tau)},
              {"voxels", object.voxels},
              {"voxel_volume", object.voxel_volume},
              {"volume", object.volume},
              {"volume_ml", factor ? Json(object.volume * *factor) : Json(nullptr)},
              {"area", object.area},
              {"equivalent_diameter", object.equivalent_diameter},
              {"sphericity", object.sphericity}};
    const ValueStatistics& values = object.values;
    json["values"] = {
        {"mean", values.mean}, {"min", values.min}, {"max", values.max}, {"sum", values.sum}, {"deviation", values.deviation}};
    json["centroid"] = object.centroid;
    json["axes"] = {{"length", object.axes.length}, {"direction", object.axes.direction}};
    json["box"] = {{"centre", object.box.centre}, {"size", object.box.size}};
    json["bounds"] = object.bounds;
    json["feret"] = {{"max", object.feret.max},
                     {"min", number(object.feret.min)},
                     {"mean", number(object.feret.mean)},
                     {"max_direction", object.feret.max_direction},
                     {"min_direction", object.feret.min_direction}};
    const bool has_walls = std::isfinite(object.thickness.median);
    json["thickness"] = has_walls ? Json{{"min", object.thickness.min}, {"median", object.thickness.median}} : Json(nullptr);
    json["euler"] = object.euler;
    json["tunnels"] = object.tunnels;
    json["cavities"] = object.cavities;
    json["touches_border"] = object.touches_border;
    return json;
}

Json sizes_json(const SizeDistribution& sizes) {
    return {{"objects", sizes.objects},
            {"mean", sizes.mean},
            {"deviation", sizes.deviation},
            {"min", sizes.min},
            {"max", sizes.max},
            {"by_number", quantiles_json(sizes.by_number)},
            {"by_volume", quantiles_json(sizes.by_volume)}};
}

Json percolation_json(const Percolation& percolation, const VolumeInfo& info) {
    Json json{{"high", Json::array()}, {"low", Json::array()}};
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(info.extent.rank); ++axis) {
        json["high"].push_back(info.calibration.reported(percolation.high[axis]));
        json["low"].push_back(info.calibration.reported(percolation.low[axis]));
    }
    return json;
}

}  // namespace isoatlas::cli

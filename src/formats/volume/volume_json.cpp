#include "formats/volume/volume_json.h"

namespace isoatlas {
namespace {

void put_text_or_null(JsonStream& json, const char* key, const std::string& text) {
    json.key(key);
    text.empty() ? json.null() : json.value(text);
}

}  // namespace

void put_volume(JsonStream& json, const VolumeInfo& info) {
    const Geometry& geometry = info.geometry;
    json.line().key("volume").begin_object().key("path").value(info.path).key("rank").value(info.extent.rank);
    json.key("dims").begin_array();
    for (int axis = 0; axis < info.extent.rank; ++axis) json.value(info.extent.size[static_cast<std::size_t>(axis)]);
    json.end_array().key("type").value(isoatlas::name_of(info.type));
    json.key("spacing").value(geometry.spacing).key("origin").value(geometry.origin);
    json.key("direction").begin_array();
    for (const Vec3& row : geometry.direction) json.value(row);
    json.end_array();
    if (!geometry.coordinates[0].empty()) {  // a rectilinear grid has no spacing
        json.key("coordinates").begin_array();
        for (const auto& axis : geometry.coordinates) {
            json.begin_array();
            for (const double x : axis) json.value(x);
            json.end_array();
        }
        json.end_array();
    }
    json.key("space").value(geometry.space);
    put_text_or_null(json, "unit", geometry.unit);
    put_text_or_null(json, "value_unit", info.value_unit);
    if (info.gaussian > 0) json.key("gaussian").value(info.gaussian);
    json.key("calibration").begin_object().key("slope").value(info.calibration.slope);
    json.key("intercept").value(info.calibration.intercept).end_object().end_object();
}

}  // namespace isoatlas

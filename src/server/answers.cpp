#include "server/answers.h"

#include <algorithm>

#include "output/json_stream.h"

namespace isoatlas::server {
namespace {

using output::JsonStream;

template <class Write>
std::string document(const char* kind, Write&& write) {
    std::string text;
    JsonStream json([&text](std::string_view piece) { text += piece; });
    json.begin_object().key("schema").value("isoatlas/server/1").key("kind").value(kind);
    write(json);
    json.end_object().finish();
    return text;
}

void put_bounds(JsonStream& json, const char* name, const Bounds& bounds) {
    json.key(name).begin_array().value(bounds.least).value(bounds.most).end_array();
}

void put_text(JsonStream& json, const char* name, const std::string& text) {
    json.key(name);
    if (text.empty()) {
        json.null();
    } else {
        json.value(text);
    }
}

void put_entry(JsonStream& json, const ObjectEntry& entry, const VolumeInfo& info, double lowest) {
    const Calibration& scale = info.calibration;
    json.line().begin_object().key("id").value(entry.id);
    json.key("appears").value(scale.reported(entry.appears)).key("merges").value(scale.reported(entry.merges));
    json.key("best").value(scale.reported(entry.best_tau));
    json.key("low").value(scale.reported(std::max(entry.tau_low, lowest))).key("high").value(scale.reported(entry.tau_high));
    json.key("voxels").value(entry.voxels).key("measure").value(entry.measure);
    json.key("tunnels").value(entry.tunnels).key("cavities").value(entry.cavities);
    json.key("position").value(to_physical(info.geometry, entry.position));
    json.key("inside").value(entry.inside).key("trunk").value(entry.trunk).key("note").value(entry.note).end_object();
}

}  // namespace

std::string atlas_json(const Atlas& atlas) {
    const VolumeInfo& info = atlas.info();
    const auto [low, high] = atlas.range();
    const double first = info.calibration.reported(low), last = info.calibration.reported(high);
    const ObjectTable table = atlas.objects();
    return document("atlas", [&](JsonStream& json) {
        json.key("name").value(info.path.substr(info.path.rfind('/') + 1)).key("size").begin_array();
        for (int axis = 0; axis < info.extent.rank; ++axis) json.value(info.extent.size[axis]);
        json.end_array().key("type").value(name_of(info.type)).key("spacing").value(info.geometry.spacing);
        json.key("origin").value(info.geometry.origin).key("direction").begin_array();
        for (const Vec3& row : info.geometry.direction) json.value(row);
        json.end_array();
        put_text(json, "unit", info.geometry.unit);
        put_text(json, "valueUnit", info.value_unit);
        json.key("low").value(std::min(first, last)).key("high").value(std::max(first, last));
        json.key("noise").value(info.calibration.reported_difference(table.noise)).key("branches").value(table.branches);
        json.line().key("objects").begin_array();
        for (const ObjectEntry& entry : table.entries) put_entry(json, entry, info, low);
        json.end_array();
    });
}

std::string preview_json(const SurfacePreview& preview, double tau) {
    return document("preview", [&](JsonStream& json) {
        json.key("tau").value(tau).key("objects").value(preview.objects).key("contours").value(preview.contours);
        json.key("tunnels").value(preview.tunnels).key("cavities").value(preview.contours - preview.objects);
        put_bounds(json, "voxels", preview.voxels);
        put_bounds(json, "cells", preview.cells);
        put_bounds(json, "triangles", preview.triangles);
        put_bounds(json, "bytes", preview.bytes);
    });
}

std::string active_json(const ActiveObjects& active, double tau, std::int64_t top) {
    return document("objects", [&](JsonStream& json) {
        const std::size_t listed = std::min(active.objects.size(), static_cast<std::size_t>(top));
        json.key("tau").value(tau).key("count").value(active.objects.size()).key("contours").value(active.contour_count);
        json.key("objects").begin_array();
        for (std::size_t i = 0; i < listed; ++i) {
            const ActiveObject& object = active.objects[i];
            json.line().begin_object().key("id").value(object.id).key("tunnels").value(object.b1).key("cavities").value(object.b2);
            put_bounds(json, "voxels", {object.voxels_least, object.voxels_most});
            json.end_object();
        }
        json.end_array();
    });
}

std::string error_json(const Error& error) {
    const ErrorText& text = error.text();
    return document("error", [&](JsonStream& json) {
        json.key("error").begin_object().key("code").value(static_cast<int>(error.kind())).key("message").value(error.what());
        json.key("where").value(text.where).key("what").value(text.what);
        json.key("expected").value(text.expected).key("next").value(text.next).end_object();
    });
}

}  // namespace isoatlas::server

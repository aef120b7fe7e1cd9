#include "server/answers.h"

#include <algorithm>
#include <limits>

#include "page/page_json.h"
#include "page/web_colour.h"
#include "server/document.h"

namespace isoatlas {
namespace {

void put_bounds(JsonStream& json, const char* name, const Bounds& bounds) {
    json.key(name).begin_array().value(bounds.min).value(bounds.max).end_array();
}

void put_object(JsonStream& json, const ActiveObject& object) {
    json.begin_object().key("id").value(object.id).key("tunnels").value(object.b1).key("cavities").value(object.b2);
    put_bounds(json, "voxels", {object.min_voxels, object.max_voxels});
    json.end_object();
}

void put_error(JsonStream& json, const Error& error) {
    const ErrorText& text = error.text();
    json.key("error").begin_object().key("code").value(static_cast<int>(error.kind())).key("message").value(error.what());
    json.key("where").value(text.where).key("what").value(text.what);
    json.key("expected").value(text.expected).key("next").value(text.next);
    json.key("reason").value(name_of(text.reason)).key("value").value(text.value).end_object();
}

void put_build(JsonStream& json, const BuildState& build) {
    constexpr double unknown = std::numeric_limits<double>::infinity();  // null
    json.key("build").begin_object().key("phase").value(build.phase);
    json.key("phase_index").value(build.phase_index).key("phase_count").value(build.phase_count).key("fraction").value(build.fraction);
    json.key("seconds_left").value(build.seconds_left.value_or(unknown));
    json.key("voxels_per_second").value(build.voxels_per_second.value_or(unknown));
    json.key("peak_memory").value(build.peak_memory).end_object();
}

}  // namespace

std::string atlas_json(const StoreSides& sides, const PageContents& contents) {
    std::string text;
    JsonStream json([&text](std::string_view piece) { text += piece; });
    write_page_json(json, sides, contents, sides.main.info().path);
    return text;
}

std::string preview_json(const SurfacePreview& preview, double tau, const NamedObject& named) {
    return document("preview", [&](JsonStream& json) {
        json.key("tau").value(tau).key("objects").value(preview.objects).key("contours").value(preview.contours);
        json.key("tunnels").value(preview.tunnels).key("cavities").value(preview.contours - preview.objects);
        put_bounds(json, "voxels", preview.voxels);
        put_bounds(json, "cells", preview.cells);
        put_bounds(json, "triangles", preview.triangles);
        put_bounds(json, "bytes", preview.bytes);
        if (!named.id) return;
        json.key("object");
        if (named.object) {
            put_object(json, *named.object);
        } else {
            json.null();
        }
    });
}

std::string active_json(const ActiveObjects& active, double tau, std::int64_t top) {
    return document("objects", [&](JsonStream& json) {
        const std::size_t listed = std::min(active.objects.size(), static_cast<std::size_t>(top));
        json.key("tau").value(tau).key("count").value(active.objects.size()).key("contours").value(active.contour_count);
        json.key("objects").begin_array();
        for (std::size_t i = 0; i < listed; ++i) put_object(json.line(), active.objects[i]);
        json.end_array();
    });
}

std::string measures_json(const VolumeInfo& info, std::span<const ObjectMeasures> objects, double tau) {
    return document("measures", [&](JsonStream& json) {
        json.key("tau").value(tau).key("unit").value(info.geometry.unit).key("objects").begin_array();
        for (const ObjectMeasures& object : objects) {
            json.line().begin_object().key("id").value(object.id).key("area").value(object.area).key("volume").value(object.volume);
            json.key("tunnels").value(object.tunnels).key("cavities").value(object.cavities).key("triangles").value(object.facets);
            put_bounds(json, "voxels", {object.voxels, object.voxels});
            json.key("box").begin_array().value(object.bounds[0]).value(object.bounds[1]).end_array();
            const ValueStatistics& values = object.values;
            json.key("values").begin_object().key("mean").value(values.mean).key("min").value(values.min).key("max").value(values.max);
            json.key("sum").value(values.sum).key("deviation").value(values.deviation).end_object();
            json.key("sphericity").value(object.sphericity).key("feret").begin_object().key("max").value(object.feret.max);
            json.key("min").value(object.feret.min).key("mean").value(object.feret.mean).end_object();
            json.key("centroid").value(object.centroid).key("axes").value(object.axes.length);
            json.key("touches_border").value(object.touches_border).end_object();
        }
        json.end_array();
    });
}

std::string at_json(const AtVoxel& at) {
    return document("at", [&](JsonStream& json) {
        const auto put = [&json](const char* name, const auto& values) {
            json.key(name).begin_array();
            for (const typename std::decay_t<decltype(values)>::value_type value : values) json.value(value);
            json.end_array();
        };
        put("voxel", at.voxel);
        put("position", at.position);
        json.key("value").value(at.value);
        put("entries", at.entries);
        put("objects", at.objects);
        put("contours", at.contours);
    });
}

std::string transfer_json(std::span<const OpacityTent> tents, const Calibration& calibration) {
    return document("transfer", [&](JsonStream& json) {
        json.key("tents").begin_array();
        for (const OpacityTent& bump : tents) {
            json.line().begin_object().key("tau").value(calibration.reported(bump.tau));
            const auto [low, high] = calibration.reported_interval(bump.low, bump.high);
            json.key("low").value(low).key("high").value(high);
            json.key("ramp").value(bump.ramp).key("density").value(bump.density);
            json.key("colour").value(web_colour(bump.colour)).end_object();
        }
        json.end_array();
    });
}

std::string address_json(const std::string& address) {
    return document("address", [&](JsonStream& json) { json.key("address").value(address); });
}

std::string volumes_json(const Channels& channels, std::int64_t volume) {
    return document("volumes", [&](JsonStream& json) {
        json.key("volume").value(volume).key("channels").begin_array();
        for (const std::string& name : channels.names) json.value(name);
        json.end_array().key("time_steps").value(channels.time_steps).key("times").begin_array();
        for (const double time : channels.times) json.value(time);
        json.end_array().key("time_unit").value(channels.time_unit);
    });
}

std::string error_json(const Error& error) {
    return document("error", [&](JsonStream& json) { put_error(json, error); });
}

std::string events_json(const StoreState::State& state, const std::vector<JobQueues::Pending>& pending, std::uint64_t scene) {
    std::string text = document("events", [&](JsonStream& json) {
        json.key("state").value(state.is_open ? "open" : state.failure ? "failed" : "building");
        if (!state.is_open && state.failure) put_error(json, *state.failure);
        if (!state.is_open && !state.failure) put_build(json, state.build);
        json.key("scene").value(static_cast<std::int64_t>(scene)).key("requests").begin_array();
        for (const auto& [line, request] : pending) {
            json.begin_object().key("client").value(request.client).key("queue").value(line).key("place").value(request.place);
            json.key("fraction").value(request.fraction).end_object();
        }
        json.end_array();
    });
    std::erase(text, '\n');
    return text;
}

}  // namespace isoatlas

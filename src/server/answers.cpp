#include "server/answers.h"

#include <algorithm>

#include "output/json_stream.h"
#include "page/contents.h"
#include "page/page_json.h"

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

}  // namespace

std::string atlas_json(const Atlas& atlas, const Context& context) {
    std::string text;
    JsonStream json([&text](std::string_view piece) { text += piece; });
    page::write_page_json(json, atlas, page::page_contents(atlas, {}, context), atlas.info().path);
    return text;
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

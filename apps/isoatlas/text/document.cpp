#include "text/document.h"

#include <cmath>
#include <set>
#include <vector>

#include <isoatlas/version.h>

#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

/// File names need not be UTF-8: other bytes are escaped. Uses an explicit stack instead of recursion.
void make_utf8(Json& json) {
    for (std::vector<Json*> left{&json}; !left.empty();) {
        Json& value = *left.back();
        left.pop_back();
        if (value.is_string()) {
            auto& text = value.get_ref<std::string&>();
            if (!is_utf8(text)) text = written_name(text);
        } else if (value.is_structured()) {
            for (Json& member : value) left.push_back(&member);
        }
    }
}

std::string text_of(Json json) {
    make_utf8(json);
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // no invalid bytes are left; a safeguard
}

/// One member a line.
std::string members(const Json& json) {
    std::string text;
    for (const auto& [name, value] : json.items()) text += (text.empty() ? "  \"" : ",\n  \"") + name + "\": " + text_of(value);
    return text;
}

Json or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json volume_json(const VolumeInfo& info) {
    Json json{{"path", info.path},
              {"format", info.format},
              {"encoding", info.encoding},
              {"type", name_of(info.type)},
              {"rank", info.extent.rank}};
    json["dims"] = Json::array();
    for (int axis = 0; axis < info.extent.rank; ++axis) json["dims"].push_back(info.extent.size[static_cast<std::size_t>(axis)]);
    json["spacing"] = info.geometry.spacing;
    json["origin"] = info.geometry.origin;
    json["direction"] = info.geometry.direction;
    if (!info.geometry.coordinates[0].empty()) json["coordinates"] = info.geometry.coordinates;
    json["space"] = info.geometry.space;
    json["unit"] = or_null(info.geometry.unit);
    json["value_unit"] = or_null(info.value_unit);
    json["calibration"] = {{"slope", info.calibration.slope}, {"intercept", info.calibration.intercept}};
    json["gaussian"] = info.gaussian > 0 ? Json(info.gaussian) : Json(nullptr);
    json["notes"] = info.notes;
    return json;
}

}  // namespace

Json document(const std::string& name) {
    static const std::set<std::string> kSecond{"animate", "ask",  "atlas",   "build",
                                               "extract", "info", "objects", "spectrum"};  // CHANGES.md, 0.2.0; extract: 0.3.0
    return {{"schema", "isoatlas/" + name + (kSecond.contains(name) ? "/2" : "/1")}, {"version", ISOATLAS_VERSION}};
}

Json document(const std::string& name, const VolumeInfo& info) {
    Json json = document(name);
    json["volume"] = volume_json(info);
    json["units"] = {{"length", or_null(info.geometry.unit)}, {"measure", plain_measure_unit(info)}, {"value", or_null(info.value_unit)}};
    return json;
}

Json document(const std::string& name, const VolumeInfo& info, Interpolant interpolant, double tunnel_height, Boundary boundary) {
    Json json = document(name, info);
    json["interpolant"] = name_of(interpolant);
    if (interpolant == Interpolant::trilinear) json["tunnel_height"] = info.calibration.reported_difference(tunnel_height);
    json["polarity"] = name_of(polarity_of(info));
    json["boundary"] = boundary == Boundary::closed ? "closed" : "open";
    return json;
}

void add_reads(Json& json, const std::optional<QueryCost>& reads) {
    Json& entry = json["reads"] = nullptr;
    if (!reads) return;
    entry = {{"bytes", reads->bytes}, {"extents", reads->extents}, {"bricks", reads->bricks}};
    entry["cells_loaded"] = reads->cells_loaded;
    entry["cells_visited"] = reads->cells_visited;
    entry["cells_active"] = reads->cells_active;
    entry["load_utility"] = reads->cells_loaded > 0 ? Json(reads->load_utility()) : Json(nullptr);
    entry["travel_utility"] = reads->cells_visited > 0 ? Json(reads->travel_utility()) : Json(nullptr);
}

void print(Terminal& terminal, const Json& json) { terminal.out() << "{\n" << members(json) << "\n}\n"; }

void print(Terminal& terminal, const Json& head, const std::string& name, std::int64_t count,
           const std::function<Json(std::int64_t)>& item) {
    terminal.out() << "{\n" << members(head) << ",\n  \"" << name << "\": [";
    for (std::int64_t i = 0; i < count; ++i) terminal.out() << (i > 0 ? ",\n    " : "\n    ") << text_of(item(i));
    terminal.out() << (count > 0 ? "\n  ]\n}\n" : "]\n}\n");
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace isoatlas::cli

// Scene files of the viewer (docs/scene.md), checked before a page is opened with them. What only the viewer knows, its own parts and the
// numbers of objects, the viewer checks (web/src/viewer/export/scene_file.ts).
#include <algorithm>
#include <memory>
#include <span>

#include <nlohmann/json.hpp>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"
#include "isoatlas/server.h"
#include "server/shared_scene.h"

namespace isoatlas {
namespace {

using Json = nlohmann::json;

constexpr const char* kSchema = "isoatlas/scene/1";
constexpr std::int64_t kLongestFile = std::int64_t{16} << 20;
constexpr int kDeepest = 8;  ///< levels of JSON
constexpr std::size_t kOfView = 6;

[[noreturn]] void refuse(const std::string& path, const std::string& where, const std::string& what, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = where,
                                   .what = what,
                                   .expected = expected,
                                   .next = "save the scene again: in the viewer, Export, Scene file"});
}

std::string text_of(const std::string& path) {
    const std::unique_ptr<File> file = open_file(path);
    if (file->size() > kLongestFile) refuse(path, "", "too long for a scene", "at most 16 MiB");
    std::string bytes(static_cast<std::size_t>(file->size()), '\0');
    read_fully(*file, path, 0, std::as_writable_bytes(std::span(bytes.data(), bytes.size())));
    return bytes;
}

Json parsed(const std::string& path, const std::string& text) {
    const auto limit = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > kDeepest) refuse(path, "", "not a scene", "JSON of at most 8 levels");
        return true;
    };
    try {
        return Json::parse(text, limit);
    } catch (const Json::parse_error& error) {
        refuse(path, "byte " + std::to_string(error.byte), "not JSON", std::string("a scene, ") + kSchema);
    }
}

/// Members of an object of the scene, checked.
class Members {
public:
    Members(const std::string& path, const Json& object, std::string where) : path_(path), object_(object), where_(std::move(where)) {
        if (!object.is_object()) refuse(path, where_, "not a scene", "an object");
    }

    template <class Good>
    const Json& at(const char* name, Good good, const char* expected) const {
        const auto found = object_.find(name);
        const std::string where = where_.empty() ? name : where_ + "." + name;
        if (found == object_.end()) refuse(path_, where, "missing: not a scene", expected);
        if (!good(*found)) refuse(path_, where, "not a scene", expected);
        return *found;
    }

private:
    const std::string& path_;
    const Json& object_;
    const std::string where_;
};

bool is_number(const Json& json) { return json.is_number(); }
bool is_whole(const Json& json) { return json.is_number_integer(); }
bool is_text(const Json& json) { return json.is_string(); }
bool is_list(const Json& json) { return json.is_array(); }

bool is_view(const Json& json) {
    return json.is_null() || (json.is_array() && json.size() == kOfView && std::ranges::all_of(json, is_number));
}
bool is_size(const Json& json) {
    const auto is_positive = [](const Json& one) { return is_whole(one) && one.get<double>() >= 1; };
    return json.is_array() && (json.size() == 2 || json.size() == 3) && std::ranges::all_of(json, is_positive);
}
bool are_parts(const Json& json) { return json.is_object() && std::ranges::all_of(json, is_text); }

void check_shown(const std::string& path, const Json& shown) {
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const Members one(path, shown[i], "shown[" + std::to_string(i) + "]");
        one.at("entry", is_whole, "a whole number");
        one.at("id", [](const Json& id) { return id.is_null() || is_whole(id); }, "a voxel, or null");
        for (const char* name : {"tau", "opacity"}) one.at(name, is_number, "a number");
        one.at("visible", [](const Json& json) { return json.is_boolean(); }, "true or false");
        one.at("colour", [](const Json& json) { return json.is_null() || is_text(json); }, "#rrggbb, or null");
        one.at("walls", [](const Json& json) { return json == "all" || json == "cavities"; }, "\"all\" or \"cavities\"");
    }
}

std::string size_text(std::span<const std::int64_t> size) {
    std::string text;
    for (const std::int64_t one : size) text += (text.empty() ? "" : " x ") + std::to_string(one);
    return text;
}

}  // namespace

SceneFile read_scene(const std::string& path) { return scene_of(path, text_of(path)); }

SceneFile scene_of(const std::string& path, const std::string& text) {
    const Json json = parsed(path, text);
    const Members scene(path, json, "");
    scene.at("schema", [](const Json& schema) { return schema == kSchema; }, kSchema);
    const Members volume(path, scene.at("volume", [](const Json& one) { return one.is_object(); }, "an object"), "volume");
    SceneFile file{.path = path, .volume = volume.at("name", is_text, "a text").get<std::string>()};
    file.size = volume.at("size", is_size, "two or three numbers of samples").get<std::vector<std::int64_t>>();
    check_shown(path, scene.at("shown", is_list, "a list"));
    scene.at("selected", is_whole, "a whole number");
    scene.at("view", is_view, "six numbers, or null");
    scene.at("parts", are_parts, "an object of texts");
    file.text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    return file;
}

void check_scene(const SceneFile& scene, const VolumeInfo& info) {
    std::vector<std::int64_t> size;
    for (int axis = 0; axis < info.extent.rank; ++axis) size.push_back(info.extent.size[axis]);
    if (size == scene.size) return;
    throw Error(ErrorKind::usage, {.file = scene.path,
                                   .where = "volume.size",
                                   .what = "the scene is of another volume, " + scene.volume + ", of " + size_text(scene.size) + " samples",
                                   .expected = size_text(size) + ", as in " + info.path,
                                   .next = "view the volume of the scene, or omit the scene"});
}

}  // namespace isoatlas

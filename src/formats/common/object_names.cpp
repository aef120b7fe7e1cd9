#include "isoatlas/object_names.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "formats/common/byte_writer.h"
#include "formats/common/json_file.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "isoatlas/names/1";
constexpr const char* kDamaged = "the file of names is damaged";
constexpr const char* kNext = "correct it, or delete it: the names are lost then, nothing else";
constexpr std::size_t kLongestName = 100;

[[noreturn]] void damaged(const std::string& path, const std::string& where, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path, .where = where, .what = kDamaged, .expected = expected, .next = kNext});
}

bool is_digits(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// 2, c2, v2; low2, lowc2, lowv2
bool is_reference(std::string_view name) {
    if (name.starts_with("low")) name.remove_prefix(3);
    return is_digits(name) || ((name.starts_with('c') || name.starts_with('v')) && is_digits(name.substr(1)));
}

std::string problem_of(const std::string& name) {
    if (name.empty()) return "it is empty";
    if (name.size() > kLongestName) return "it has more than 100 bytes";
    if (!is_utf8(name)) return "it is not UTF-8";
    if (name.starts_with('-') || name.starts_with(' ') || name.ends_with(' ')) return "it begins with '-' or a blank, or ends with one";
    for (const char c : name) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "it has a control character";
        if (c == '@' || c == ',' || c == '/') return std::string("it has a '") + c + "'";
    }
    return is_reference(name) ? "it would be taken for the number of an object" : "";
}

Json document_of(const std::string& path) {
    Json json = read_json_file(path, kSchema, kDamaged, kNext);
    if (!json.contains("names") || !json["names"].is_array()) damaged(path, "names", "an array");
    return json;
}

Json size_of(const Extent& extent) {
    Json size = Json::array();
    for (int axis = 0; axis < extent.rank; ++axis) size.push_back(extent.size[static_cast<std::size_t>(axis)]);
    return size;
}

ObjectName name_of(const Json& item, const Extent& extent, const std::string& path, const std::string& where) {
    const auto is = [&](const char* key, auto good) { return item.is_object() && item.contains(key) && good(item[key]); };
    if (!is("name", [](const Json& j) { return j.is_string(); })) damaged(path, where + ".name", "a text");
    if (!is("voxel", [&](const Json& j) {
            return j.is_number_integer() && j.get<double>() >= 0 && j.get<double>() < static_cast<double>(extent.voxels());
        }))
        damaged(path, where + ".voxel", "a voxel of the volume");
    if (!is("isovalue", [](const Json& j) { return j.is_number() && std::isfinite(j.get<double>()); }))
        damaged(path, where + ".isovalue", "a number");
    if (!is("side", [](const Json& j) { return j == "object" || j == "cavity"; })) damaged(path, where + ".side", "object or cavity");
    ObjectName name{item["name"].get<std::string>(), item["voxel"].get<std::int64_t>(), item["isovalue"].get<double>(),
                    item["side"] == "cavity"};
    if (const std::string problem = problem_of(name.name); !problem.empty()) damaged(path, where + ".name: " + problem, "a name");
    return name;
}

bool is_same(const ObjectName& p, const ObjectName& q) {
    return p.is_cavity == q.is_cavity && p.voxel == q.voxel && p.isovalue == q.isovalue;
}

std::string place_of(const ObjectName& name) {
    return std::string(name.is_cavity ? "the cavity" : "the object") + " v" + std::to_string(name.voxel) + " at " +
           number_text(name.isovalue);
}

}  // namespace

std::string object_names_path(const std::string& store, Polarity polarity) {
    if (polarity == Polarity::high) return store + ".names.json";
    const std::string end = store.ends_with(".atlas") ? ".atlas" : "";
    const std::string stem = store.substr(0, store.size() - end.size());
    return stem + (stem.ends_with(".low") ? "" : ".low") + end + ".names.json";
}

std::vector<ObjectName> read_object_names(const std::string& path, const Extent& extent) {
    std::error_code ignored;
    if (std::filesystem::symlink_status(path, ignored).type() == std::filesystem::file_type::not_found) return {};
    const Json json = document_of(path);
    if (json.value("size", Json()) != size_of(extent)) damaged(path, "size", size_of(extent).dump() + ": the names are of another volume");
    std::vector<ObjectName> names;
    for (const Json& item : json["names"]) {
        const std::string where = "names[" + std::to_string(names.size()) + "]";
        ObjectName name = name_of(item, extent, path, where);
        const bool is_repeated = std::ranges::any_of(names, [&](const ObjectName& n) { return n.name == name.name || is_same(n, name); });
        if (is_repeated) damaged(path, where, "names and objects that are listed once");
        names.push_back(std::move(name));
    }
    return names;
}

void write_object_names(const std::string& path, const Extent& extent, std::span<const ObjectName> names) {
    std::vector<ObjectName> checked;
    for (const ObjectName& name : names) set_object_name(checked, name);
    AtomicFile file(path);  // checks what may be replaced, also where it is removed
    if (checked.empty()) {
        std::error_code failed;
        std::filesystem::remove(path, failed);
        if (failed) throw Error(ErrorKind::resource, {.file = path, .what = failed.message(), .next = "remove it by hand"});
        return;
    }
    std::string text = "{\n  \"schema\": \"" + std::string(kSchema) + "\",\n  \"size\": " + size_of(extent).dump() + ",\n  \"names\": [";
    for (const ObjectName& name : checked) {
        const Json item{
            {"name", name.name}, {"side", name.is_cavity ? "cavity" : "object"}, {"voxel", name.voxel}, {"isovalue", name.isovalue}};
        text += (&name == checked.data() ? "\n    " : ",\n    ") + item.dump();
    }
    file.write(text + "\n  ]\n}\n");
    file.commit();
}

void check_object_name(const std::string& name) {
    const std::string problem = problem_of(name);
    if (problem.empty()) return;
    throw Error(ErrorKind::usage, {.where = "the name \"" + shown_name(name) + "\"",
                                   .what = problem,
                                   .expected = "text such as skull or \"left lung\"",
                                   .next = "give another name"});
}

void set_object_name(std::vector<ObjectName>& names, const ObjectName& given) {
    check_object_name(given.name);
    const ObjectName* taken = find_object_name(names, given.name);
    if (taken != nullptr && !is_same(*taken, given)) {
        throw Error(ErrorKind::usage, {.where = "the name \"" + given.name + "\"",
                                       .what = place_of(*taken) + " has it already, " + place_of(given) + " would have it too",
                                       .next = "give another name, or take it away from the other first"});
    }
    std::erase_if(names, [&](const ObjectName& name) { return is_same(name, given); });
    names.push_back(given);
}

const ObjectName* find_object_name(std::span<const ObjectName> names, const std::string& name) {
    const auto found = std::ranges::find(names, name, &ObjectName::name);
    return found == names.end() ? nullptr : &*found;
}

const ObjectName* find_object_name(std::span<const ObjectName> names, bool is_cavity, std::int64_t voxel, double isovalue) {
    const auto found = std::ranges::find_if(
        names, [&](const ObjectName& name) { return name.is_cavity == is_cavity && name.voxel == voxel && name.isovalue == isovalue; });
    return found == names.end() ? nullptr : &*found;
}

}  // namespace isoatlas

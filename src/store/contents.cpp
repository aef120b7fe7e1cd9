#include "store/contents.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "isoatlas/error.h"
#include "isoatlas/text.h"
#include "isoatlas/units.h"

namespace isoatlas {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::pair<std::string_view, int> kTypes[] = {{"uint8", 1}, {"int8", 1},   {"uint16", 2}, {"int16", 2},   {"uint32", 4},
                                                       {"int32", 4}, {"uint64", 8}, {"int64", 8},  {"float32", 4}, {"float64", 8}};

[[noreturn]] void damaged(const std::string& path, const std::string& where, const std::string& what) {
    throw Error(ErrorKind::input,
                {.file = path, .where = where, .what = what, .next = "the store is damaged: build it again from the volume"});
}

/// A JSON text that is not the contents of a store.
struct Unreadable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Unlike the library, rejects 1e300 as an integer.
std::int64_t integer(const Json& json) {
    if (!json.is_number_integer()) throw Unreadable("an integer is expected, not " + json.dump());
    return json.get<std::int64_t>();
}

std::uint64_t unsigned_integer(const Json& json) {
    if (!json.is_number_unsigned()) throw Unreadable("a number of at least 0 is expected, not " + json.dump());
    return json.get<std::uint64_t>();
}

std::vector<std::int64_t> integers(const Json& json) {
    std::vector<std::int64_t> list;
    for (const Json& entry : json) list.push_back(integer(entry));
    return list;
}

Json json_of(const VolumeInfo& info) {
    Json json{{"name", written_name(info.path)}, {"rank", info.extent.rank}, {"size", info.extent.size}, {"type", name_of(info.type)}};
    const Geometry& g = info.geometry;
    json["spacing"] = g.spacing;
    json["origin"] = g.origin;
    json["direction"] = g.direction;
    json["coordinates"] = g.coordinates;
    json["space"] = decoded_text(g.space);
    json["unit"] = decoded_text(g.unit);
    json["calibration"] = {{"slope", info.calibration.slope}, {"intercept", info.calibration.intercept}};
    json["value_unit"] = decoded_text(info.value_unit);
    json["description"] = decoded_text(info.description);
    if (info.gaussian > 0) json["gaussian"] = info.gaussian;
    return json;
}

Json json_of(const Fingerprint& fingerprint) {
    Json members = Json::object();
    for (const Fingerprint::Member& member : fingerprint.members) members[member.name] = member.text;
    return {{"hash", fingerprint.hash()}, {"members", std::move(members)}};
}

Fingerprint fingerprint_of(const Json& json) {
    Fingerprint fingerprint;
    for (const auto& [name, text] : json.at("members").items()) fingerprint.add(name, text.get<std::string>());
    if (fingerprint.hash() != unsigned_integer(json.at("hash"))) throw Unreadable("the hash of the fingerprint is wrong");
    return fingerprint;
}

ValueType value_type(const std::string& name) {
    for (int i = 0; i < 8; ++i) {
        if (name == name_of(static_cast<ValueType>(i))) return static_cast<ValueType>(i);
    }
    throw Unreadable("'" + name + "' is not a sample type");
}

VolumeInfo volume_of(const Json& json) {
    VolumeInfo info;
    info.path = json.at("name").get<std::string>();
    info.format = "isoatlas store";
    info.encoding = "bricks";
    const std::vector<std::int64_t> size = integers(json.at("size"));
    if (size.size() != 3) throw Unreadable("a volume has three sizes");
    std::copy(size.begin(), size.end(), info.extent.size.begin());
    info.extent.rank = integer(json.at("rank")) == 2 ? 2 : 3;
    info.type = value_type(json.at("type").get<std::string>());
    Geometry& g = info.geometry;
    g.spacing = json.at("spacing").get<Vec3>();
    g.origin = json.at("origin").get<Vec3>();
    g.direction = json.at("direction").get<Mat3>();
    g.coordinates = json.at("coordinates").get<std::array<std::vector<double>, 3>>();
    g.space = json.at("space").get<std::string>();
    g.unit = unit_name(json.at("unit").get<std::string>());  // earlier stores have "um"
    info.calibration.slope = json.at("calibration").at("slope").get<double>();
    info.calibration.intercept = json.at("calibration").at("intercept").get<double>();
    info.value_unit = json.at("value_unit").get<std::string>();
    info.description = json.at("description").get<std::string>();
    info.gaussian = json.value("gaussian", 0.0);
    return info;
}

StoredArray array_of(const Json& json) {
    StoredArray array;
    array.name = json.at("name").get<std::string>();
    array.type = json.at("type").get<std::string>();
    array.shape = integers(json.at("shape"));
    array.offset = integer(json.at("offset"));
    array.block = integer(json.at("block"));
    array.checksums = integer(json.at("checksums"));
    array.sum = unsigned_integer(json.at("sum"));
    array.chunk = integer(json.at("chunk"));
    return array;
}

PolarityChoice polarities_of(const std::string& name) {
    for (const PolarityChoice choice : {PolarityChoice::high, PolarityChoice::low, PolarityChoice::both}) {
        if (name == name_of(choice)) return choice;
    }
    throw Unreadable("'" + name + "' is not a polarity");
}

bool lies_inside(std::int64_t offset, std::int64_t bytes, std::int64_t file_size) {
    return offset >= 0 && bytes >= 0 && offset <= file_size && bytes <= file_size - offset;
}

/// A product of sizes, checked for overflow.
bool is_sound(const StoredArray& array, std::int64_t file_size) {
    constexpr std::int64_t kLargestChunk = 1 << 24, kBestCompression = 1 << 11;  // deflate: 1032 at most
    const std::int64_t size = size_of_type(array.type);
    if (size == 0 || array.block < 0 || array.shape.empty()) return false;
    if (array.chunk < 0 || array.chunk > kLargestChunk || (array.chunk > 0 && array.block != array.chunk * size)) return false;
    const std::int64_t max = array.chunk == 0 ? file_size : file_size * kBestCompression;
    std::int64_t bytes = size;
    for (const std::int64_t n : array.shape) {
        if (n < 0 || (n > 0 && bytes > max / n)) return false;
        bytes *= n;
    }
    return lies_inside(array.offset, array.chunk == 0 ? bytes : 0, file_size) &&
           lies_inside(array.checksums, array.index_bytes(), file_size);
}

bool is_sound(const Extent& extent) {
    if (extent.rank != 2 && extent.rank != 3) return false;
    std::int64_t voxels = 1;
    for (const std::int64_t n : extent.size) {
        if (n < 1 || voxels > (std::int64_t{1} << 60) / n) return false;
        voxels *= n;
    }
    return extent.rank == 3 || extent.size[2] == 1;
}

}  // namespace

std::int64_t size_of_type(std::string_view type) {
    for (const auto& [name, size] : kTypes) {
        if (name == type) return size;
    }
    return 0;
}

std::int64_t StoredArray::count() const {
    std::int64_t count = 1;
    for (const std::int64_t n : shape) count *= n;
    return count;
}

std::int64_t StoredArray::bytes() const { return count() * size_of_type(type); }

bool Contents::has_array(std::string_view name) const { return std::ranges::find(arrays, name, &StoredArray::name) != arrays.end(); }

bool Contents::has_present_values() const {
    const std::string* algorithm = fingerprint.find("algorithm");
    return algorithm != nullptr && *algorithm == std::to_string(kAlgorithmVersion);
}

bool Contents::has_present_trees() const {
    const std::string* algorithm = fingerprint.find("algorithm");
    return has_present_values() || (algorithm != nullptr && *algorithm == std::to_string(kFirstExactAlgorithm));
}

const StoredArray& Contents::array(std::string_view name, std::string_view type) const {
    const auto found = std::find_if(arrays.begin(), arrays.end(), [&](const StoredArray& a) { return a.name == name && a.type == type; });
    if (found != arrays.end()) return *found;
    damaged(volume.path, std::string(name), "the store has no such array of the type " + std::string(type));
}

Contents contents_of(const Contents& whole, Polarity polarity) {
    if (!holds(whole.polarities, polarity)) {
        throw Error(ErrorKind::unsupported, {.file = whole.volume.path,
                                             .what = std::string("the store does not hold objects of ") + name_of(polarity) + " values",
                                             .next = "build another one from the volume, of both polarities",
                                             .reason = Reason::polarity_not_stored,
                                             .value = name_of(polarity)});
    }
    Contents one = whole;
    std::erase_if(one.arrays, [](const StoredArray& array) { return array.name.starts_with(kLowGroup); });
    if (polarity == Polarity::high) return one;
    one.volume.calibration.mirror = mirror_of(one.volume.type);
    std::erase_if(one.arrays, [](const StoredArray& array) { return !array.name.starts_with("volume/"); });
    for (StoredArray array : whole.arrays) {
        if (!array.name.starts_with(kLowGroup)) continue;
        array.name.erase(0, kLowGroup.size());
        std::erase_if(one.arrays, [&](const StoredArray& other) { return other.name == array.name; });
        one.arrays.push_back(std::move(array));
    }
    return one;
}

std::string to_json(const Contents& contents) {
    Json json{{"format", "isoatlas store"}, {"version", contents.version}, {"volume", json_of(contents.volume)}};
    json["parameters"] = {{"interpolant", name_of(contents.parameters.interpolant)},
                          {"tunnel_height", contents.parameters.tunnel_height},
                          {"samples_checksum", contents.parameters.samples_checksum}};
    if (contents.version >= 3) json["fingerprint"] = json_of(contents.fingerprint);
    if (contents.is_replaceable) json["replaceable"] = true;
    if (contents.polarities != PolarityChoice::high) json["polarity"] = name_of(contents.polarities);
    Json& arrays = json["arrays"] = Json::array();
    for (const StoredArray& a : contents.arrays) {
        arrays.push_back({{"name", a.name},
                          {"type", a.type},
                          {"shape", a.shape},
                          {"offset", a.offset},
                          {"block", a.block},
                          {"checksums", a.checksums},
                          {"sum", a.sum},
                          {"chunk", a.chunk}});
    }
    return json.dump(1, ' ', false, Json::error_handler_t::replace);  // no invalid bytes are left; a safeguard
}

Contents contents_of_json(std::string_view text, const std::string& path, std::int64_t file_size) try {
    const Json json = Json::parse(text);
    Contents contents;
    const std::int64_t version = integer(json.at("version"));
    if (version < 1 || version > kStoreVersion) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .what = "is a store of version " + std::to_string(version),
                                             .expected = "version 1 to " + std::to_string(kStoreVersion),
                                             .next = "use the version of isoatlas that built it, or build it again",
                                             .reason = Reason::unknown_store_version});
    }
    contents.version = static_cast<int>(version);
    contents.volume = volume_of(json.at("volume"));
    if (!is_sound(contents.volume.extent)) damaged(path, "contents", "the size of the volume is not valid");
    const Json& parameters = json.at("parameters");
    const bool is_faces = parameters.at("interpolant").get<std::string>() == name_of(Interpolant::faces);
    contents.parameters.interpolant = is_faces ? Interpolant::faces : Interpolant::trilinear;
    contents.parameters.tunnel_height = parameters.at("tunnel_height").get<double>();
    contents.parameters.samples_checksum = unsigned_integer(parameters.at("samples_checksum"));
    if (contents.version >= 3) contents.fingerprint = fingerprint_of(json.at("fingerprint"));
    contents.is_replaceable = json.value("replaceable", false);
    contents.polarities = polarities_of(json.value("polarity", "high"));
    for (const Json& entry : json.at("arrays")) {
        contents.arrays.push_back(array_of(entry));
        if (!is_sound(contents.arrays.back(), file_size)) damaged(path, contents.arrays.back().name, "the array lies outside the file");
    }
    return contents;
} catch (const nlohmann::json::exception& error) {
    damaged(path, "contents", std::string("they cannot be read: ") + error.what());
} catch (const Unreadable& error) {
    damaged(path, "contents", std::string("they cannot be read: ") + error.what());
}

}  // namespace isoatlas

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/raw_description.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

using SidecarJson = nlohmann::json;

constexpr std::int64_t kLongestSidecar = 1024 * 1024;
constexpr int kDeepest = 8;  // a sidecar is a flat object; deeper nesting is another kind of JSON

[[noreturn]] void fail(const std::string& path, const std::string& key, const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = key.empty() ? "" : "key \"" + key + "\"",
                                   .what = key.empty() ? "the sidecar of a RAW file is not valid" : "the value is not valid",
                                   .expected = expected,
                                   .next = "correct the sidecar, or delete it and give the sizes and the type of the samples",
                                   .reason = Reason::sidecar_invalid});
}

bool nested_too_deep(const std::string& text) {
    int depth = 0;
    for (const char c : text) {
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (depth > kDeepest) return true;
    }
    return false;
}

std::vector<std::int64_t> read_dims(const std::string& path, const SidecarJson& value) {
    constexpr const char* kExpected = "[nx, ny] or [nx, ny, nz], each at least 1";
    if (!value.is_array() || value.size() < 2 || value.size() > 3) fail(path, "dims", kExpected);
    std::vector<std::int64_t> dims;
    for (const SidecarJson& size : value) {
        const bool huge = size.is_number_unsigned() && size.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX);
        if (!size.is_number_integer() || huge || size.get<std::int64_t>() < 1) fail(path, "dims", kExpected);
        dims.push_back(size.get<std::int64_t>());
    }
    return dims;
}

Vec3 read_vector(const std::string& path, const std::string& key, const SidecarJson& value, double otherwise) {
    if (!value.is_array() || value.size() < 2 || value.size() > 3) fail(path, key, "2 or 3 numbers");
    Vec3 vector{otherwise, otherwise, otherwise};
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!value[i].is_number() || !std::isfinite(value[i].get<double>())) fail(path, key, "2 or 3 numbers");
        vector[i] = value[i].get<double>();
    }
    return vector;
}

std::string read_text(const std::string& path, const std::string& key, const SidecarJson& value) {
    if (!value.is_string()) fail(path, key, "a text");
    return printable(value.get<std::string>());
}

bool read_big_endian(const std::string& path, const SidecarJson& value) {
    const std::string text = lower(read_text(path, "endian", value));
    if (text != "little" && text != "big") fail(path, "endian", "\"little\" or \"big\"");
    return text == "big";
}

std::int64_t read_skip(const std::string& path, const SidecarJson& value) {
    const bool huge = value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX);
    if (!value.is_number_integer() || huge || value.get<std::int64_t>() < 0) fail(path, "skip", "a number of bytes");
    return value.get<std::int64_t>();
}

void read_key(const std::string& path, const std::string& key, const SidecarJson& value, RawDescription& description) {
    if (key == "dims") {
        description.dims = read_dims(path, value);
    } else if (key == "type") {
        description.type = find_value_type(read_text(path, key, value));
        if (!description.type) fail(path, key, "uint8 int8 uint16 int16 uint32 int32 float32 or float64");
    } else if (key == "endian") {
        description.big_endian = read_big_endian(path, value);
    } else if (key == "skip") {
        description.skip_bytes = read_skip(path, value);
    } else if (key == "spacing") {
        description.spacing = read_vector(path, key, value, 1);
        for (const double length : *description.spacing) {
            if (length == 0) fail(path, key, "distances other than 0");
        }
    } else if (key == "origin") {
        description.origin = read_vector(path, key, value, 0);
    } else if (key == "unit") {
        description.unit = read_text(path, key, value);
    } else if (key == "value_unit") {
        description.value_unit = read_text(path, key, value);
    } else if (key == "space") {
        description.space = read_text(path, key, value);
    } else {
        description.notes.push_back("unknown key " + in_quotes(key) + " of the sidecar ignored");
    }
}

}  // namespace

std::optional<std::string> find_sidecar(const std::string& path) {
    const std::array<std::string, 2> candidates = {path + ".json", std::filesystem::path(path).replace_extension(".json").string()};
    for (const std::string& candidate : candidates) {
        if (candidate != path && file_exists(candidate)) return candidate;
    }
    return std::nullopt;
}

RawDescription read_sidecar(const std::string& sidecar_path) {
    if (file_size(sidecar_path) > kLongestSidecar) fail(sidecar_path, "", "a JSON object of less than 1 MiB");
    const std::vector<std::byte> bytes = read_header_bytes(sidecar_path, kLongestSidecar);
    const std::string text = decoded_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (nested_too_deep(text)) fail(sidecar_path, "", "a flat JSON object");
    const SidecarJson object = SidecarJson::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!object.is_object()) fail(sidecar_path, "", "a JSON object like {\"dims\": [64, 64, 64], \"type\": \"uint8\"}");
    RawDescription description;
    description.notes.push_back("described by " + shown_name(std::filesystem::path(sidecar_path).filename().string()));
    for (const auto& [key, value] : object.items()) read_key(sidecar_path, key, value, description);
    return description;
}

}  // namespace isoatlas

// The XML header of MIPAV: <image filename="v.raw" nDimensions="3"> <Dataset-attributes> ...
#include <algorithm>
#include <array>
#include <cmath>
#include <pugixml.hpp>
#include <string_view>
#include <utility>

#include "formats/common/byte_source.h"
#include "formats/common/text.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/named_type.h"
#include "formats/volume/raw_header.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxMipavBytes = std::int64_t{1} << 24;

std::optional<ValueType> type_of_mipav(const std::string& name) {
    static constexpr std::array<NamedType, 8> kTypes{{{"byte", ValueType::i8},
                                                      {"unsigned byte", ValueType::u8},
                                                      {"short", ValueType::i16},
                                                      {"unsigned short", ValueType::u16},
                                                      {"integer", ValueType::i32},
                                                      {"unsigned integer", ValueType::u32},
                                                      {"float", ValueType::f32},
                                                      {"double", ValueType::f64}}};
    return find_type(kTypes, name);
}

/// The text of the elements of a name, in their order.
std::vector<std::string> texts(const pugi::xml_node& parent, const char* name) {
    std::vector<std::string> found;
    for (const pugi::xml_node& node : parent.children(name)) found.emplace_back(trim(node.text().get()));
    return found;
}

std::string first_text(const pugi::xml_node& parent, const char* name) { return std::string(trim(parent.child(name).text().get())); }

/// Numbers of elements; empty: there are none.
std::vector<double> numbers_of(const std::string& path, const pugi::xml_node& parent, const char* name) {
    std::vector<double> numbers;
    for (const std::string& text : texts(parent, name)) {
        const std::optional<double> number = parse_number(text);
        if (!number || !std::isfinite(*number)) bad_field(path, name, in_quotes(text) + " is not a number", "a number");
        numbers.push_back(*number);
    }
    return numbers;
}

void read_sizes(const std::string& path, const pugi::xml_node& set, RawHeader& header) {
    const std::vector<std::string> extents = texts(set, "Extents");
    if (extents.size() < 2 || extents.size() > 4) bad_field(path, "Extents", std::to_string(extents.size()) + " of them", "2 to 4");
    for (const std::string& text : extents) {
        const std::optional<std::int64_t> size = parse_integer(text);
        if (!size || *size < 1) bad_field(path, "Extents", in_quotes(text) + " is not a size", "1 or more");
        header.sizes.push_back(*size);
    }
    if (header.sizes.size() == 4) {
        header.time_steps = header.sizes[3];
        header.sizes.pop_back();
    }
    if (header.sizes.size() == 2) header.sizes.push_back(1);
}

}  // namespace

RawHeader read_mipav_header(const std::string& path) {
    const std::vector<std::byte> bytes = read_header_bytes(path, kMaxMipavBytes + 1);
    if (static_cast<std::int64_t>(bytes.size()) > kMaxMipavBytes) bad_field(path, "header", "is longer than 16 MiB", "a header of MIPAV");
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
    if (!parsed) bad_field(path, "offset " + std::to_string(parsed.offset), std::string("is not XML: ") + parsed.description(), "XML");
    const pugi::xml_node image = document.child("image"), set = image.child("Dataset-attributes");
    RawHeader header;
    header.files = {image.attribute("filename").value()};
    if (!set || header.files[0].empty()) bad_field(path, "image", "has no file name or no Dataset-attributes", "a header of MIPAV");
    read_sizes(path, set, header);
    const std::string type = first_text(set, "Data-type"), packing = lower(first_text(set, "Compression")),
                      order = lower(first_text(set, "Endianess"));
    header.type = type_of_mipav(lower(type));
    if (!header.type || !(packing.empty() || packing == "none")) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .where = header.type ? "Compression" : "Data-type",
                                             .what = in_quotes(header.type ? packing : type) + " is not supported",
                                             .expected = "8 to 32 bit integers, Float or Double, not compressed",
                                             .next = "save it in MIPAV as another type, not compressed"});
    }
    if (order == "big" || order == "little") header.big_endian = order == "big";
    const std::optional<std::int64_t> offset = parse_integer(first_text(set, "Image-offset"));
    if (set.child("Image-offset") && (!offset || *offset < 0)) bad_field(path, "Image-offset", "is wrong", "a number of bytes");
    header.offset = offset.value_or(0);
    const std::vector<double> steps = numbers_of(path, set.child("Resolutions"), "Resolution"), origin = numbers_of(path, set, "Origin");
    if (!steps.empty()) {
        header.steps = Mat3{};
        for (std::size_t axis = 0; axis < 3; ++axis) (*header.steps)[axis][axis] = axis < steps.size() ? steps[axis] : 1;
    }
    for (std::size_t axis = 0; axis < std::min<std::size_t>(origin.size(), 3); ++axis) header.origin[axis] = origin[axis];
    const std::vector<std::string> units = texts(set, "Units");
    if (!units.empty() && lower(units[0]) != "unknown measurement unit") header.unit = units[0];
    return header;
}

}  // namespace isoatlas

#include <filesystem>

#include "formats/common/text.h"
#include "formats/volume/named_type.h"
#include "formats/volume/raw_description.h"

namespace isoatlas {
namespace {

/// The sizes of a word like 512x512x128; nullopt for other words.
std::optional<std::vector<std::int64_t>> parse_sizes(std::string_view word) {
    std::vector<std::int64_t> sizes;
    for (std::size_t begin = 0; begin <= word.size();) {
        const std::size_t end = std::min(word.find('x', begin), word.size());
        const std::optional<std::int64_t> size = parse_integer(word.substr(begin, end - begin));
        if (!size || *size < 1) return std::nullopt;
        sizes.push_back(*size);
        begin = end + 1;
    }
    if (sizes.size() < 2 || sizes.size() > 3) return std::nullopt;
    return sizes;
}

}  // namespace

std::optional<ValueType> find_value_type(std::string_view name) {
    static constexpr NamedType kNames[] = {
        {"uint8", ValueType::u8},  {"u8", ValueType::u8},      {"uchar", ValueType::u8},   {"byte", ValueType::u8},
        {"int8", ValueType::i8},   {"i8", ValueType::i8},      {"schar", ValueType::i8},   {"uint16", ValueType::u16},
        {"u16", ValueType::u16},   {"ushort", ValueType::u16}, {"int16", ValueType::i16},  {"i16", ValueType::i16},
        {"short", ValueType::i16}, {"uint32", ValueType::u32}, {"u32", ValueType::u32},    {"uint", ValueType::u32},
        {"int32", ValueType::i32}, {"i32", ValueType::i32},    {"int", ValueType::i32},    {"float32", ValueType::f32},
        {"f32", ValueType::f32},   {"float", ValueType::f32},  {"single", ValueType::f32}, {"float64", ValueType::f64},
        {"f64", ValueType::f64},   {"double", ValueType::f64}, {"real64", ValueType::f64},
    };
    return find_type(kNames, lower(name));
}

RawDescription description_from_name(const std::string& path) {
    RawDescription description;
    const std::string name = lower(std::filesystem::path(path).filename().string());
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find_first_of("_-. ", begin), name.size());
        const std::string_view word = std::string_view(name).substr(begin, end - begin);
        begin = end + 1;
        if (const auto sizes = parse_sizes(word); sizes && !description.dims) description.dims = sizes;
        if (const auto type = find_value_type(word)) description.type = type;
        if (word == "le" || word == "little" || word == "lsb") description.big_endian = false;
        if (word == "be" || word == "big" || word == "msb") description.big_endian = true;
    }
    return description;
}

}  // namespace isoatlas

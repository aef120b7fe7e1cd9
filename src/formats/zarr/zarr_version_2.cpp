// Arrays of Zarr version 2: https://zarr-specs.readthedocs.io/en/latest/v2/v2.0.html
#include <algorithm>
#include <numeric>
#include <utility>

#include "formats/common/text.h"
#include "formats/zarr/zarr_array.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

ZarrType type_of_numpy(const KeyStore& store, const std::string& where, const Json* value) {
    using Kind = ZarrType::Kind;
    struct Known {
        std::string_view name;
        ValueType type;
        Kind kind = Kind::same;
        WideInteger wide = WideInteger::none;
    };
    constexpr Known kKnown[] = {{"u1", ValueType::u8},
                                {"i1", ValueType::i8},
                                {"u2", ValueType::u16},
                                {"i2", ValueType::i16},
                                {"u4", ValueType::u32},
                                {"i4", ValueType::i32},
                                {"f4", ValueType::f32},
                                {"f8", ValueType::f64},
                                {"b1", ValueType::u8, Kind::boolean},
                                {"f2", ValueType::f32, Kind::half},
                                {"i8", ValueType::f64, Kind::same, WideInteger::int64},
                                {"u8", ValueType::f64, Kind::same, WideInteger::uint64}};
    constexpr const char* kExpected = "8 to 64 bit integers, float16, float32, float64 or bool";
    if (value == nullptr) bad_zarr(store, where, "is missing", kExpected);
    if (value->is_array())
        unsupported_zarr(store, where, "the samples have several values each", kExpected, "write one of them as an array");
    std::string name = value->is_string() ? value->get<std::string>() : "";
    const char order = name.empty() ? ' ' : name[0];
    if (std::string_view("<>|").find(order) == std::string_view::npos) bad_zarr(store, where, "is not valid", "a type such as \"<f4\"");
    const std::string_view kind = std::string_view(name).substr(1);
    for (const Known& known : kKnown) {
        if (kind != known.name) continue;
        const std::size_t bytes = known.kind == Kind::half ? 2 : size_of(known.type);
        if (order == '|' && bytes > 1) bad_zarr(store, where, "has no byte order", "\"<\" or \">\" before the type");
        return {.kind = known.kind, .type = known.type, .wide = known.wide, .stored_bytes = bytes, .big_endian = order == '>' && bytes > 1};
    }
    unsupported_zarr(store, where, in_quotes(name) + " samples are not supported", kExpected,
                     "write the array again in another type, in Python with array.astype(\"float64\")");
}

void read_memory_order(const KeyStore& store, const std::string& key, const Json& metadata, ZarrArray& array) {
    const std::string order = text_member(metadata, "order");
    if (order != "C" && order != "F") bad_zarr(store, in_key(key, "order"), "is not valid", "\"C\" or \"F\"");
    array.order.resize(array.rank());
    std::iota(array.order.begin(), array.order.end(), std::size_t{0});
    if (order == "F") std::ranges::reverse(array.order);
}

void read_filters(const KeyStore& store, const std::string& key, const Json& metadata, ZarrArray& array) {
    constexpr std::size_t kMostCodecs = 16;
    array.encoding = "raw";
    const Json* filters = find_member(metadata, "filters");
    if (filters != nullptr && !filters->is_null()) {
        const std::string where = in_key(key, "filters");
        if (!filters->is_array() || filters->size() > kMostCodecs) bad_zarr(store, where, "is not valid", "null or a list of filters");
        for (const Json& filter : *filters) array.codecs.push_back(codec_of_numcodecs(store, where, text_member(filter, "id"), filter));
    }
    const Json* compressor = find_member(metadata, "compressor");
    if (compressor == nullptr || compressor->is_null()) return;
    array.encoding = text_member(*compressor, "id");
    array.codecs.push_back(codec_of_numcodecs(store, in_key(key, "compressor"), array.encoding, *compressor));
    if (const std::string inner = text_member(*compressor, "cname"); !inner.empty()) array.encoding += " (" + inner + ")";
}

}  // namespace

ZarrArray array_of_version_2(const KeyStore& store, const std::string& path, const Json& metadata, Json attributes) {
    const std::string key = join_key(path, ".zarray");
    const Json* version = find_member(metadata, "zarr_format");
    if (version == nullptr || *version != 2) bad_zarr(store, in_key(key, "zarr_format"), "is not valid", "2");
    ZarrArray array;
    array.path = path;
    array.shape = read_counts(store, key, metadata, "shape", 1);
    array.chunk = read_counts(store, key, metadata, "chunks", 1);
    array.type = type_of_numpy(store, in_key(key, "dtype"), find_member(metadata, "dtype"));
    read_memory_order(store, key, metadata, array);
    read_filters(store, key, metadata, array);
    if (const Json* fill = find_member(metadata, "fill_value")) set_fill(store, in_key(key, "fill_value"), *fill, array);
    const std::string separator = text_member(metadata, "dimension_separator");
    if (!separator.empty() && separator != "." && separator != "/")
        bad_zarr(store, in_key(key, "dimension_separator"), "is not valid", "\".\" or \"/\"");
    array.separator = separator.empty() ? '.' : separator[0];
    array.attributes = std::move(attributes);
    if (const Json* names = find_member(array.attributes, "_ARRAY_DIMENSIONS"); names != nullptr && names->is_array()) {
        for (const Json& name : *names) array.axis_names.push_back(name.is_string() ? name.get<std::string>() : "");
    }
    if (array.axis_names.size() != array.rank()) array.axis_names.clear();
    check_array(store, key, array);
    return array;
}

}  // namespace isoatlas

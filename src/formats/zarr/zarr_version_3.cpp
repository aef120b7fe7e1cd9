// Arrays of Zarr version 3: https://zarr-specs.readthedocs.io/en/latest/v3/core/index.html
#include <algorithm>
#include <numeric>
#include <utility>

#include "formats/common/text.h"
#include "formats/zarr/zarr_array.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

ZarrType type_of_name(const KeyStore& store, const std::string& where, const Json* value) {
    using Kind = ZarrType::Kind;
    struct Known {
        std::string_view name;
        ValueType type;
        Kind kind = Kind::same;
        WideInteger wide = WideInteger::none;
    };
    constexpr Known kKnown[] = {{"uint8", ValueType::u8},
                                {"int8", ValueType::i8},
                                {"uint16", ValueType::u16},
                                {"int16", ValueType::i16},
                                {"uint32", ValueType::u32},
                                {"int32", ValueType::i32},
                                {"float32", ValueType::f32},
                                {"float64", ValueType::f64},
                                {"bool", ValueType::u8, Kind::boolean},
                                {"float16", ValueType::f32, Kind::half},
                                {"int64", ValueType::f64, Kind::same, WideInteger::int64},
                                {"uint64", ValueType::f64, Kind::same, WideInteger::uint64}};
    constexpr const char* kExpected = "8 to 64 bit integers, float16, float32, float64 or bool";
    if (value == nullptr) bad_zarr(store, where, "is missing", kExpected);
    const std::string name = value->is_string() ? value->get<std::string>() : text_member(*value, "name");
    for (const Known& known : kKnown) {
        if (name != known.name) continue;
        const std::size_t bytes = known.kind == Kind::half ? 2 : size_of(known.type);
        return {.kind = known.kind, .type = known.type, .wide = known.wide, .stored_bytes = bytes};
    }
    if (name.empty()) bad_zarr(store, where, "is not valid", "a type such as \"float32\"");
    unsupported_zarr(store, where, in_quotes(name) + " samples are not supported", kExpected,
                     "write the array again in another type, in Python with array.astype(\"float64\")");
}

/// "name" and "configuration" of a codec, a grid, an encoding: {"name": "gzip", "configuration": {"level": 1}}, or the name alone.
struct Extension {
    std::string name;
    Json settings = Json::object();
};

Extension extension_of(const KeyStore& store, const std::string& where, const Json* value) {
    Extension extension;
    if (value != nullptr && value->is_string()) extension.name = value->get<std::string>();
    if (value != nullptr) {
        if (const Json* settings = find_member(*value, "configuration"); settings != nullptr && settings->is_object())
            extension.settings = *settings;
        if (value->is_object()) extension.name = text_member(*value, "name");
    }
    if (extension.name.empty()) bad_zarr(store, where, "is missing or not valid", "an object with a name and a configuration");
    return extension;
}

void read_transpose(const KeyStore& store, const std::string& where, const Json& settings, ZarrArray& array) {
    const Json* order = find_member(settings, "order");
    const std::vector<std::size_t> before = array.order;
    std::vector<std::size_t> axes;
    if (order != nullptr && order->is_array()) {
        for (const Json& axis : *order) axes.push_back(static_cast<std::size_t>(as_count(axis).value_or(-1)));
    } else {
        axes.resize(array.rank());
        std::iota(axes.begin(), axes.end(), std::size_t{0});
        const std::string letter = text_member(settings, "order");
        if (letter == "F") std::ranges::reverse(axes);
        if (letter != "C" && letter != "F") axes.clear();
    }
    std::vector<std::size_t> sorted = axes;
    std::ranges::sort(sorted);
    bool is_order = sorted.size() == array.rank();
    for (std::size_t i = 0; is_order && i < sorted.size(); ++i) is_order = sorted[i] == i;
    if (!is_order) bad_zarr(store, where, "\"order\" of transpose is not valid", "every axis once");
    for (std::size_t i = 0; i < axes.size(); ++i) array.order[i] = before[axes[i]];
}

bool is_big_endian(const KeyStore& store, const std::string& where, const Json& settings) {
    const std::string endian = text_member(settings, "endian");
    if (!endian.empty() && endian != "little" && endian != "big")
        bad_zarr(store, where, "\"endian\" of bytes is not valid", "\"little\" or \"big\"");
    return endian == "big";
}

void read_index_codecs(const KeyStore& store, const std::string& where, const Json& settings, ZarrShards& shards) {
    const Json* codecs = find_member(settings, "index_codecs");
    if (codecs == nullptr || !codecs->is_array() || codecs->empty() || codecs->size() > 2)
        bad_zarr(store, where, "\"index_codecs\" is missing or not valid", "bytes, then crc32c or nothing");
    for (std::size_t i = 0; i < codecs->size(); ++i) {
        const Extension codec = extension_of(store, where, &(*codecs)[i]);
        if (codec.name != (i == 0 ? "bytes" : "crc32c"))
            unsupported_zarr(store, where, "the index of the shards has the codec " + in_quotes(codec.name),
                             "bytes, then crc32c or nothing");
        if (i == 0) shards.index_big_endian = is_big_endian(store, where, codec.settings);
        if (i == 1) shards.index_has_checksum = true;
    }
}

void read_codecs(const KeyStore& store, const std::string& where, const Json* list, ZarrArray& array);

void read_shards(const KeyStore& store, const std::string& where, const Json& settings, ZarrArray& array) {
    if (array.shards) unsupported_zarr(store, where, "has shards inside of shards", "one level of shards");
    if (!array.codecs.empty()) unsupported_zarr(store, where, "the shards are filtered as a whole", "filters inside of the shards");
    if (!std::ranges::is_sorted(array.order)) unsupported_zarr(store, where, "the shards are transposed", "transpose inside of the shards");
    array.shards = ZarrShards{.size = array.chunk};
    array.chunk = read_counts(store, where, settings, "chunk_shape", 1);
    const std::string place = text_member(settings, "index_location");
    if (!place.empty() && place != "start" && place != "end")
        bad_zarr(store, where, "\"index_location\" is not valid", "\"start\" or \"end\"");
    array.shards->index_at_end = place != "start";
    read_index_codecs(store, where, settings, *array.shards);
    read_codecs(store, where, find_member(settings, "codecs"), array);
}

/// First those that turn axes, then one that makes bytes, then those of bytes.
void read_codecs(const KeyStore& store, const std::string& where, const Json* list, ZarrArray& array) {
    constexpr std::size_t kMostCodecs = 16;
    constexpr std::string_view kNumcodecs = "numcodecs.";
    if (list == nullptr || !list->is_array() || list->empty() || list->size() > kMostCodecs)
        bad_zarr(store, where, "is missing or not valid", "a list of codecs, \"bytes\" among them");
    bool has_bytes = false;
    for (const Json& value : *list) {
        Extension codec = extension_of(store, where, &value);
        const bool is_of_axes = codec.name == "transpose", makes_bytes = codec.name == "bytes" || codec.name == "sharding_indexed";
        if (has_bytes && (is_of_axes || makes_bytes))
            bad_zarr(store, where, in_quotes(codec.name) + " comes too late", "transpose, bytes, then the others");
        if (is_of_axes) {
            read_transpose(store, where, codec.settings, array);
        } else if (codec.name == "bytes") {
            array.type.big_endian = is_big_endian(store, where, codec.settings) && array.type.stored_bytes > 1;
            has_bytes = true;
        } else if (codec.name == "sharding_indexed") {
            if (list->size() > 1 && &value != &list->back())
                unsupported_zarr(store, where, "the shards are encoded as a whole", "codecs inside of the shards");
            return read_shards(store, where, codec.settings, array);
        } else {
            if (codec.name.starts_with(kNumcodecs)) codec.name.erase(0, kNumcodecs.size());
            const bool is_filter = codec.name == "delta" || codec.name == "fixedscaleoffset";  // of numbers, before bytes
            if (!has_bytes && !is_filter)
                bad_zarr(store, where, "\"bytes\" is missing before " + in_quotes(codec.name), "transpose, bytes, then the others");
            array.codecs.push_back(codec_of_numcodecs(store, where, codec.name, codec.settings));
            array.codecs.back().decoded.big_endian = array.codecs.back().encoded.big_endian = false;  // numbers, whatever their bytes
            if (!is_filter) array.encoding = codec.name == "crc32c" && array.encoding != "raw" ? array.encoding : codec.name;
            if (const std::string inner = text_member(codec.settings, "cname"); !inner.empty()) array.encoding += " (" + inner + ")";
        }
    }
    if (!has_bytes) bad_zarr(store, where, "\"bytes\" is missing", "a codec that makes bytes of samples");
}

void read_chunks(const KeyStore& store, const std::string& key, const Json& metadata, ZarrArray& array) {
    const std::string grid_key = in_key(key, "chunk_grid"), encoding_key = in_key(key, "chunk_key_encoding");
    const Extension grid = extension_of(store, grid_key, find_member(metadata, "chunk_grid"));
    if (grid.name != "regular") unsupported_zarr(store, grid_key, in_quotes(grid.name) + " chunks are not supported", "regular chunks");
    array.chunk = read_counts(store, key, grid.settings, "chunk_shape", 1);
    const Extension encoding = extension_of(store, encoding_key, find_member(metadata, "chunk_key_encoding"));
    if (encoding.name != "default" && encoding.name != "v2")
        unsupported_zarr(store, encoding_key, in_quotes(encoding.name) + " keys are not supported", "default or v2");
    array.keys_begin_with_c = encoding.name == "default";
    const std::string separator = text_member(encoding.settings, "separator");
    if (!separator.empty() && separator != "." && separator != "/")
        bad_zarr(store, encoding_key, "has a separator that is not valid", "\".\" or \"/\"");
    array.separator = !separator.empty() ? separator[0] : array.keys_begin_with_c ? '/' : '.';
}

/// Members that a reader may not ignore.
void refuse_unknown(const KeyStore& store, const std::string& key, const Json& metadata) {
    const Json* transformers = find_member(metadata, "storage_transformers");
    if (transformers != nullptr && transformers->is_array() && !transformers->empty())
        unsupported_zarr(store, in_key(key, "storage_transformers"), "are not supported", "none");
    constexpr std::string_view kKnown[] = {"zarr_format",         "node_type",  "shape",  "data_type",  "chunk_grid",
                                           "chunk_key_encoding",  "fill_value", "codecs", "attributes", "dimension_names",
                                           "storage_transformers"};
    for (const auto& [name, value] : metadata.items()) {
        const Json* must = find_member(value, "must_understand");
        const bool may_ignore = must != nullptr && *must == false;
        if (std::ranges::find(kKnown, name) == std::end(kKnown) && !may_ignore)
            unsupported_zarr(store, in_key(key, name), "is an extension that is not supported", "an array without it");
    }
}

}  // namespace

ZarrArray array_of_version_3(const KeyStore& store, const std::string& path, const Json& metadata) {
    const std::string key = join_key(path, "zarr.json");
    ZarrArray array;
    array.path = path;
    array.version = 3;
    array.shape = read_counts(store, key, metadata, "shape", 1);
    array.type = type_of_name(store, in_key(key, "data_type"), find_member(metadata, "data_type"));
    read_chunks(store, key, metadata, array);
    refuse_unknown(store, key, metadata);
    array.order.resize(array.rank());
    std::iota(array.order.begin(), array.order.end(), std::size_t{0});
    array.encoding = "raw";
    read_codecs(store, in_key(key, "codecs"), find_member(metadata, "codecs"), array);
    const auto is_filter = [](const ByteCodec& codec) {
        return codec.kind == ByteCodec::Kind::delta || codec.kind == ByteCodec::Kind::scale;
    };
    if (array.type.big_endian && std::ranges::any_of(array.codecs, is_filter))
        unsupported_zarr(store, in_key(key, "codecs"), "a filter of numbers before big-endian bytes is not supported",
                         "little-endian bytes");
    const Json* fill = find_member(metadata, "fill_value");
    if (fill == nullptr) bad_zarr(store, in_key(key, "fill_value"), "is missing", "the value of what is not stored");
    set_fill(store, in_key(key, "fill_value"), *fill, array);
    if (const Json* attributes = find_member(metadata, "attributes"); attributes != nullptr && attributes->is_object())
        array.attributes = *attributes;
    if (const Json* names = find_member(metadata, "dimension_names"); names != nullptr && names->is_array()) {
        for (const Json& name : *names) array.axis_names.push_back(name.is_string() ? name.get<std::string>() : "");
    }
    if (array.axis_names.size() != array.rank()) array.axis_names.clear();
    check_array(store, key, array);
    return array;
}

}  // namespace isoatlas

// Writes small Zarr arrays of every layout, slowly and sample by sample.
#pragma once

#include <cstring>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/zarr/codecs.h"
#include "oracle/write_file.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas::test {

using Sizes = std::vector<std::int64_t>;

/// Values of a store by key; written as a folder or as a zip archive.
using Keys = std::map<std::string, std::string>;

inline std::string folder_of(const TestFolder& folder, const std::string& name, const Keys& keys) {
    for (const auto& [key, value] : keys) {
        const std::filesystem::path path = std::filesystem::path(folder / name) / key;
        std::filesystem::create_directories(path.parent_path());
        oracle::write_file(path, value);
    }
    return folder / name;
}

template <class T>
std::string little(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// A zip archive; deflated: every second entry.
inline std::string zip_of(const Keys& keys, bool deflated = false, const std::string& comment = "") {
    std::string file, list;
    int entries = 0;
    for (const auto& [key, value] : keys) {
        const bool packs = deflated && entries % 2 == 0;
        const std::string data = packs ? compress(value, -15) : value;
        const auto crc =
            static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(value.data()), static_cast<uInt>(value.size())));
        const std::string shared = little<std::uint16_t>(20) + little<std::uint16_t>(0) + little<std::uint16_t>(packs ? 8 : 0) +
                                   little<std::uint32_t>(0) + little(crc) + little(static_cast<std::uint32_t>(data.size())) +
                                   little(static_cast<std::uint32_t>(value.size())) + little(static_cast<std::uint16_t>(key.size())) +
                                   little<std::uint16_t>(0);
        list += "PK\x01\x02" + little<std::uint16_t>(20) + shared + little<std::uint16_t>(0) + little<std::uint16_t>(0) +
                little<std::uint16_t>(0) + little<std::uint32_t>(0) + little(static_cast<std::uint32_t>(file.size())) + key;
        file += "PK\x03\x04" + shared + key + data;
        ++entries;
    }
    const std::string end = "PK\x05\x06" + little<std::uint32_t>(0) + little(static_cast<std::uint16_t>(entries)) +
                            little(static_cast<std::uint16_t>(entries)) + little(static_cast<std::uint32_t>(list.size())) +
                            little(static_cast<std::uint32_t>(file.size())) + little(static_cast<std::uint16_t>(comment.size()));
    return file + list + end + comment;
}

struct Layout {
    int version = 2;
    Sizes shape{4, 5, 6}, chunk{2, 3, 4}, shard{};
    std::string type = "u2";  ///< of numpy, without the byte order
    bool big = false;
    std::vector<std::size_t> order{};  ///< axes of stored samples, the slowest first; empty: as the array
    char separator = '.';
    bool begins_with_c = true;  ///< version 3
    std::string compressor{};   ///< "", "zlib", "gzip"
    bool index_at_start = false, index_has_checksum = true;
    bool leaves_chunks_out = false;
    std::string attributes = "{}";
    std::string dimension_names{};  ///< version 3: JSON, if any
};

inline std::string list_text(const auto& numbers) {
    std::string text;
    for (const auto number : numbers) text += (text.empty() ? "" : ",") + std::to_string(number);
    return "[" + text + "]";
}

/// Calls use(index) for every index below the sizes, the last axis fastest.
template <class Use>
void for_each_index(const Sizes& sizes, const Use& use) {
    Sizes index(sizes.size(), 0);
    for (;;) {
        use(std::as_const(index));
        std::size_t axis = sizes.size();
        while (axis > 0 && ++index[axis - 1] == sizes[axis - 1]) index[--axis] = 0;
        if (axis == 0) return;
    }
}

/// The value of a sample: few different ones, so that there are ties, and what no value of the array is outside of it.
inline double sample_at(const Layout& layout, const Sizes& index) {
    std::uint64_t hash = 1469598103934665603U;
    bool is_inside = true, is_left_out = layout.leaves_chunks_out;
    for (std::size_t axis = 0; axis < index.size(); ++axis) {
        hash = (hash ^ static_cast<std::uint64_t>(index[axis])) * 1099511628211U;
        is_inside = is_inside && index[axis] < layout.shape[axis];
        is_left_out = is_left_out && index[axis] / layout.chunk[axis] % 2 == 1;
    }
    return is_left_out ? 7 : is_inside ? static_cast<double>(hash >> 32 & 31) : 99;
}

inline std::string bytes_of_sample(const Layout& layout, double value) {
    std::string bytes;
    const std::string& type = layout.type;
    if (type == "u1" || type == "b1") bytes = little(static_cast<std::uint8_t>(value));
    if (type == "i1") bytes = little(static_cast<std::int8_t>(value));
    if (type == "u2") bytes = little(static_cast<std::uint16_t>(value));
    if (type == "i2") bytes = little(static_cast<std::int16_t>(value));
    if (type == "u4") bytes = little(static_cast<std::uint32_t>(value));
    if (type == "i4") bytes = little(static_cast<std::int32_t>(value));
    if (type == "f4") bytes = little(static_cast<float>(value));
    if (type == "f8") bytes = little(value);
    if (layout.big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

inline std::string packed(const std::string& compressor, const std::string& bytes) {
    return compressor == "zlib" ? zlib(bytes) : compressor == "gzip" ? gzip(bytes) : bytes;
}

/// The chunk with this number; nullopt: it is left out.
inline std::optional<std::string> chunk_of(const Layout& layout, const Sizes& number) {
    std::vector<std::size_t> order = layout.order;
    if (order.empty()) order.resize(layout.shape.size()), std::iota(order.begin(), order.end(), std::size_t{0});
    bool is_left_out = layout.leaves_chunks_out;
    for (const std::int64_t n : number) is_left_out = is_left_out && n % 2 == 1;
    if (is_left_out) return std::nullopt;
    Sizes stored;
    for (const std::size_t axis : order) stored.push_back(layout.chunk[axis]);
    std::string bytes;
    for_each_index(stored, [&](const Sizes& place) {
        Sizes index(place.size());
        for (std::size_t i = 0; i < place.size(); ++i) index[order[i]] = number[order[i]] * layout.chunk[order[i]] + place[i];
        bytes += bytes_of_sample(layout, sample_at(layout, index));
    });
    return packed(layout.compressor, bytes);
}

inline std::string name_of_chunk(const Layout& layout, const Sizes& number) {
    std::string name = layout.version == 3 && layout.begins_with_c ? "c" : "";
    for (const std::int64_t n : number) name += (name.empty() ? "" : std::string(1, layout.separator)) + std::to_string(n);
    return name;
}

inline std::string metadata_2(const Layout& layout) {
    const bool is_f = !layout.order.empty();  // version 2 knows only the order of all axes turned around
    return R"({"zarr_format":2,"shape":)" + list_text(layout.shape) + R"(,"chunks":)" + list_text(layout.chunk) + R"(,"dtype":")" +
           (layout.type.ends_with('1') ? "|"
            : layout.big               ? ">"
                                       : "<") +
           layout.type + R"(","order":")" + (is_f ? "F" : "C") + R"(","filters":null,"fill_value":7,"compressor":)" +
           (layout.compressor.empty() ? "null" : R"({"id":")" + layout.compressor + R"(","level":1})") + R"(,"dimension_separator":")" +
           layout.separator + "\"}";
}

inline std::string metadata_3(const Layout& layout) {
    const std::map<std::string, std::string> names{{"u1", "uint8"},  {"b1", "bool"},  {"i1", "int8"},    {"u2", "uint16"}, {"i2", "int16"},
                                                   {"u4", "uint32"}, {"i4", "int32"}, {"f4", "float32"}, {"f8", "float64"}};
    std::string codecs = R"({"name":"bytes","configuration":{"endian":")" + std::string(layout.big ? "big" : "little") + "\"}}";
    if (!layout.order.empty()) codecs = R"({"name":"transpose","configuration":{"order":)" + list_text(layout.order) + "}}," + codecs;
    if (!layout.compressor.empty()) codecs += R"(,{"name":"gzip","configuration":{"level":1}})";
    if (!layout.shard.empty()) {
        codecs = R"({"name":"sharding_indexed","configuration":{"chunk_shape":)" + list_text(layout.chunk) + R"(,"codecs":[)" + codecs +
                 R"(],"index_location":")" + (layout.index_at_start ? "start" : "end") +
                 R"(","index_codecs":[{"name":"bytes","configuration":{"endian":"little"}})" +
                 (layout.index_has_checksum ? R"(,{"name":"crc32c"})" : "") + "]}}";
    }
    return R"({"zarr_format":3,"node_type":"array","shape":)" + list_text(layout.shape) + R"(,"data_type":")" + names.at(layout.type) +
           R"(","chunk_grid":{"name":"regular","configuration":{"chunk_shape":)" +
           list_text(layout.shard.empty() ? layout.chunk : layout.shard) + R"(}},"chunk_key_encoding":{"name":")" +
           (layout.begins_with_c ? "default" : "v2") + R"(","configuration":{"separator":")" + layout.separator + R"("}},"fill_value":)" +
           (layout.type == "b1" ? "true" : "7") + R"(,"codecs":[)" + codecs + R"(],"attributes":)" + layout.attributes +
           (layout.dimension_names.empty() ? "" : R"(,"dimension_names":)" + layout.dimension_names) + "}";
}

/// A shard with this number: the chunks one behind the other, in turned order, and where each begins.
inline std::string shard_of(const Layout& layout, const Sizes& number) {
    Sizes per_shard;
    for (std::size_t axis = 0; axis < number.size(); ++axis) per_shard.push_back(layout.shard[axis] / layout.chunk[axis]);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> places;
    std::string chunks;
    const std::size_t index_bytes =
        16 * static_cast<std::size_t>(std::accumulate(per_shard.begin(), per_shard.end(), std::int64_t{1}, std::multiplies<>())) +
        (layout.index_has_checksum ? 4 : 0);
    for_each_index(per_shard, [&](const Sizes& place) {
        Sizes chunk(place.size());
        for (std::size_t axis = 0; axis < place.size(); ++axis) chunk[axis] = number[axis] * per_shard[axis] + place[axis];
        const std::optional<std::string> bytes = chunk_of(layout, chunk);
        if (!bytes) {
            places.emplace_back(~std::uint64_t{0}, ~std::uint64_t{0});
            return;
        }
        chunks += "gap";
        places.emplace_back(chunks.size() + (layout.index_at_start ? index_bytes : 0), bytes->size());
        chunks += *bytes;
    });
    std::string index;
    for (const auto& [offset, size] : places) index += little(offset) + little(size);
    if (layout.index_has_checksum) index += little(crc32c(std::as_bytes(std::span(index))));
    return layout.index_at_start ? index + chunks : chunks + index;
}

/// The keys of an array, below `path` ("" or "a/b/").
inline Keys array_keys(const Layout& layout, const std::string& path = "") {
    Keys keys;
    keys[path + (layout.version == 2 ? ".zarray" : "zarr.json")] = layout.version == 2 ? metadata_2(layout) : metadata_3(layout);
    if (layout.version == 2 && layout.attributes != "{}") keys[path + ".zattrs"] = layout.attributes;
    const Sizes& each = layout.shard.empty() ? layout.chunk : layout.shard;
    Sizes count;
    for (std::size_t axis = 0; axis < each.size(); ++axis) count.push_back((layout.shape[axis] + each[axis] - 1) / each[axis]);
    for_each_index(count, [&](const Sizes& number) {
        const std::optional<std::string> value = layout.shard.empty() ? chunk_of(layout, number) : std::optional(shard_of(layout, number));
        if (value) keys[path + name_of_chunk(layout, number)] = *value;
    });
    return keys;
}

/// The samples of the array at these numbers of its slowest axes, x fastest, in the byte order of this machine.
inline std::string expected_samples(Layout layout, const Sizes& fixed) {
    layout.big = false;
    const Sizes rest(layout.shape.begin() + static_cast<std::ptrdiff_t>(fixed.size()), layout.shape.end());
    std::string bytes;
    for_each_index(rest, [&](const Sizes& place) {
        Sizes index = fixed;
        index.insert(index.end(), place.begin(), place.end());
        const double value = sample_at(layout, index);
        bytes += bytes_of_sample(layout, layout.type == "b1" && value == 7 ? 1 : value);
    });
    return bytes;
}

}  // namespace isoatlas::test

// What the metadata of a Zarr array says, of version 2 and 3 alike.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/common/wide_integers.h"
#include "formats/zarr/codecs.h"
#include "formats/zarr/zarr_json.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Samples as they are stored, and the type that they are read as.
struct ZarrType {
    enum class Kind : std::uint8_t { same, half, boolean } kind = Kind::same;
    ValueType type = ValueType::u8;
    WideInteger wide = WideInteger::none;
    std::size_t stored_bytes = 1;
    bool big_endian = false;
    [[nodiscard]] const char* name() const { return wide == WideInteger::none ? name_of(type) : name_of(wide); }
};

/// Chunks together in one value, with a list of where each begins.
struct ZarrShards {
    std::vector<std::int64_t> size;  ///< samples along each axis: whole chunks
    bool index_at_end = true;
    bool index_big_endian = false;
    bool index_has_checksum = false;
};

struct ZarrArray {
    std::string path;  ///< in the hierarchy, "" for the root
    int version = 2;
    std::vector<std::int64_t> shape, chunk;  ///< samples along each axis, the slowest one of C order first; positive
    ZarrType type;
    std::array<std::byte, 8> fill{};  ///< the value of what is not stored: a sample of type.type (wide: of that) in host byte order
    std::vector<std::size_t> order;   ///< the axes in the order of the stored samples, the slowest first
    std::vector<ByteCodec> codecs;    ///< in the order of encoding
    std::string encoding;             ///< of chunks, for the user: "blosc", "raw"
    std::optional<ZarrShards> shards;
    bool keys_begin_with_c = false;       ///< "c/0/1" instead of "0/1"
    char separator = '.';                 ///< between the numbers of a key
    std::vector<std::string> axis_names;  ///< one for each axis, or none
    Json attributes = Json::object();

    [[nodiscard]] std::size_t rank() const { return shape.size(); }
    /// Of a chunk, decoded.
    [[nodiscard]] std::int64_t chunk_samples() const;
    [[nodiscard]] std::int64_t chunk_bytes() const { return chunk_samples() * static_cast<std::int64_t>(type.stored_bytes); }
    /// The key of a chunk, or of a shard where there are any.
    [[nodiscard]] std::string key(std::span<const std::int64_t> index) const;
};

/// From .zarray (metadata) and .zattrs. Throws Error: input, unsupported.
[[nodiscard]] ZarrArray array_of_version_2(const KeyStore& store, const std::string& path, const Json& metadata, Json attributes);
/// From zarr.json. Throws Error: input, unsupported.
[[nodiscard]] ZarrArray array_of_version_3(const KeyStore& store, const std::string& path, const Json& metadata);

/// A codec as numcodecs describes it: {"id": "zlib", ...}. where: of it, in messages.
[[nodiscard]] ByteCodec codec_of_numcodecs(const KeyStore& store, const std::string& where, const std::string& id, const Json& settings);
/// What numpy calls it: "<f4"; of a filter.
[[nodiscard]] CodecNumber codec_number(const KeyStore& store, const std::string& where, const std::string& text);
/// Sets the fill value from JSON: a number, a truth value, null (0), "NaN", "Infinity", "-Infinity", or hexadecimal bits.
void set_fill(const KeyStore& store, const std::string& where, const Json& value, ZarrArray& array);
/// Whether sizes, order and type fit together; called last by both.
void check_array(const KeyStore& store, const std::string& key, const ZarrArray& array);

}  // namespace isoatlas

// Codecs as numcodecs and Zarr describe them.
#include <cmath>
#include <optional>
#include <utility>

#include "formats/common/text.h"
#include "formats/zarr/zarr_array.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

constexpr const char* kCodecs = "blosc, zstd, lz4, bz2, zlib or gzip, with the filters shuffle, delta, fixedscaleoffset or crc32c";

ByteCodec shuffle_of(const KeyStore& store, const std::string& where, const Json& settings) {
    const Json* size = find_member(settings, "elementsize");
    const std::optional<std::int64_t> bytes = size == nullptr ? std::optional<std::int64_t>(4) : as_count(*size);
    constexpr std::int64_t kLargest = 255;
    if (!bytes || *bytes < 1 || *bytes > kLargest) bad_zarr(store, where, "\"elementsize\" of shuffle is not valid", "1 to 255 bytes");
    return {.kind = ByteCodec::Kind::shuffle, .element = static_cast<std::size_t>(*bytes)};
}

double number_setting(const KeyStore& store, const std::string& where, const Json& settings, const char* name) {
    const Json* value = find_member(settings, name);
    const double number = value != nullptr && value->is_number() ? value->get<double>() : std::nan("");
    if (!std::isfinite(number)) bad_zarr(store, where, std::string("\"") + name + "\" is not valid", "a number");
    return number;
}

ByteCodec filter_of(const KeyStore& store, const std::string& where, ByteCodec::Kind kind, const Json& settings) {
    ByteCodec codec{.kind = kind};
    codec.decoded = codec_number(store, where, text_member(settings, "dtype"));
    const std::string encoded = text_member(settings, "astype");
    codec.encoded = encoded.empty() ? codec.decoded : codec_number(store, where, encoded);
    const bool has_floats = codec.decoded.kind == 'f' || codec.encoded.kind == 'f';
    if (kind == ByteCodec::Kind::delta) {
        const bool is_alike = codec.decoded.kind == codec.encoded.kind && codec.decoded.bytes == codec.encoded.bytes;
        if (has_floats && !is_alike) unsupported_zarr(store, where, "the filter delta has floating-point numbers of two types", "one type");
        return codec;
    }
    if (codec.encoded.kind == 'f') unsupported_zarr(store, where, "the filter fixedscaleoffset stores floating-point numbers", "integers");
    codec.scale = number_setting(store, where, settings, "scale");
    codec.offset = number_setting(store, where, settings, "offset");
    if (codec.scale == 0) bad_zarr(store, where, "\"scale\" is 0", "another number");
    return codec;
}

}  // namespace

CodecNumber codec_number(const KeyStore& store, const std::string& where, const std::string& text) {
    std::string_view name = text;
    const char order = name.empty() || std::string_view("<>|=").find(name[0]) == std::string_view::npos ? '<' : name[0];
    if (!name.empty() && order == name[0]) name.remove_prefix(1);
    const std::optional<std::int64_t> bytes = name.size() == 2 ? parse_integer(name.substr(1)) : std::nullopt;
    const char kind = name.empty() ? ' ' : name[0];
    const bool is_integer = (kind == 'i' || kind == 'u') && bytes && (*bytes == 1 || *bytes == 2 || *bytes == 4 || *bytes == 8);
    if (!is_integer && !(kind == 'f' && bytes && (*bytes == 4 || *bytes == 8)))
        unsupported_zarr(store, where, "the type " + in_quotes(text) + " of a filter is not supported", "integers, float32 or float64");
    return {.kind = kind, .bytes = static_cast<std::size_t>(*bytes), .big_endian = order == '>'};
}

ByteCodec codec_of_numcodecs(const KeyStore& store, const std::string& where, const std::string& id, const Json& settings) {
    using Kind = ByteCodec::Kind;
    constexpr std::pair<std::string_view, Kind> kPlain[] = {{"zlib", Kind::inflate}, {"gzip", Kind::inflate}, {"zstd", Kind::zstd},
                                                            {"lz4", Kind::lz4},      {"bz2", Kind::bzip2},    {"blosc", Kind::blosc},
                                                            {"crc32c", Kind::crc32c}};
    for (const auto& [name, kind] : kPlain) {
        if (id == name) return {.kind = kind};
    }
    if (id == "shuffle") return shuffle_of(store, where, settings);
    if (id == "delta") return filter_of(store, where, Kind::delta, settings);
    if (id == "fixedscaleoffset") return filter_of(store, where, Kind::scale, settings);
    if (id.empty()) bad_zarr(store, where, "a compressor or filter has no name", kCodecs);
    unsupported_zarr(store, where, "the compressor or filter " + in_quotes(id) + " is not supported", kCodecs);
}

}  // namespace isoatlas

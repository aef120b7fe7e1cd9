#include "codec/chunk_codec.h"

#include <libdeflate.h>

#include <memory>

#include "base/check.h"

namespace isoatlas {
namespace {

struct FreeCompressor {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};
struct FreeDecompressor {
    void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
};

libdeflate_compressor* compressor() {
    thread_local const std::unique_ptr<libdeflate_compressor, FreeCompressor> own(libdeflate_alloc_compressor(kDeflateLevel));
    if (own == nullptr) throw std::bad_alloc();
    return own.get();
}

libdeflate_decompressor* decompressor() {
    thread_local const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> own(libdeflate_alloc_decompressor());
    if (own == nullptr) throw std::bad_alloc();
    return own.get();
}

}  // namespace

std::vector<std::byte> encode_chunk(std::span<const std::byte> raw, std::int64_t width) {
    const auto wide = static_cast<std::size_t>(width), count = raw.size() / wide;
    ISOATLAS_CHECK(count * wide == raw.size());
    std::vector<std::byte> shuffled(raw.size());
    for (std::size_t b = 0; b < wide; ++b) {
        std::byte* const out = shuffled.data() + b * count;
        for (std::size_t i = 0; i < count; ++i) out[i] = raw[i * wide + b];
    }
    std::vector<std::byte> packed(libdeflate_zlib_compress_bound(compressor(), raw.size()));
    packed.resize(libdeflate_zlib_compress(compressor(), shuffled.data(), shuffled.size(), packed.data(), packed.size()));
    ISOATLAS_CHECK(!packed.empty());
    return packed;
}

bool decode_chunk(std::span<const std::byte> packed, std::int64_t width, std::span<std::byte> raw) {
    const auto wide = static_cast<std::size_t>(width), count = raw.size() / wide;
    std::vector<std::byte> shuffled(raw.size());
    if (libdeflate_zlib_decompress(decompressor(), packed.data(), packed.size(), shuffled.data(), shuffled.size(), nullptr) !=
        LIBDEFLATE_SUCCESS) {
        return false;
    }
    for (std::size_t b = 0; b < wide; ++b) {
        const std::byte* const in = shuffled.data() + b * count;
        for (std::size_t i = 0; i < count; ++i) raw[i * wide + b] = in[i];
    }
    return true;
}

}  // namespace isoatlas

// PNG (ISO/IEC 15948), written directly: a few chunks around one deflated block.
#include <libdeflate.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/check.h"
#include "image/png.h"

namespace isoatlas {
namespace {

int paeth(int left, int up, int corner) {
    const int p = left + up - corner, a = std::abs(p - left), b = std::abs(p - up), c = std::abs(p - corner);
    if (a <= b && a <= c) return left;
    return b <= c ? up : corner;
}

int predict(int filter, int left, int up, int corner) {
    switch (filter) {
        case 1: return left;
        case 2: return up;
        case 3: return (left + up) / 2;
        case 4: return paeth(left, up, corner);
        default: return 0;
    }
}

/// One row as differences, with the filter whose differences are smallest (as PNG's authors advise) in front.
void filter_row(const std::vector<std::uint8_t>& row, const std::vector<std::uint8_t>& above, std::size_t pixel,
                std::vector<std::uint8_t>& out) {
    std::vector<std::uint8_t> best, tried(row.size() + 1);
    long min = -1;
    for (int filter = 0; filter < 5; ++filter) {
        long sum = 0;
        tried[0] = static_cast<std::uint8_t>(filter);
        for (std::size_t i = 0; i < row.size(); ++i) {
            const int left = i >= pixel ? row[i - pixel] : 0, corner = i >= pixel ? above[i - pixel] : 0;
            const auto difference = static_cast<std::uint8_t>(row[i] - predict(filter, left, above[i], corner));
            tried[i + 1] = difference;
            sum += std::abs(static_cast<int>(static_cast<std::int8_t>(difference)));
        }
        if (min >= 0 && sum >= min) continue;
        min = sum;
        best = tried;
    }
    out.insert(out.end(), best.begin(), best.end());
}

std::vector<std::uint8_t> row_of(const Image& image, std::int64_t y, bool with_alpha) {
    std::vector<std::uint8_t> row;
    row.reserve(4 * image.width);
    for (std::int64_t x = 0; x < image.width; ++x) row.insert(row.end(), image.at(x, y), image.at(x, y) + (with_alpha ? 4 : 3));
    return row;
}

}  // namespace

void PngChunks::number(std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(value >> shift));
}

void PngChunks::chunk(const char* name, std::span<const std::uint8_t> content) {
    number(static_cast<std::uint32_t>(content.size()));
    const std::size_t begin = bytes.size();
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(name[i]));
    const auto* raw = reinterpret_cast<const std::byte*>(content.data());
    bytes.insert(bytes.end(), raw, raw + content.size());
    number(libdeflate_crc32(0, bytes.data() + begin, bytes.size() - begin));
}

void PngChunks::begin(std::int64_t width, std::int64_t height, bool with_alpha) {
    static constexpr std::uint8_t kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    for (const std::uint8_t b : kSignature) bytes.push_back(static_cast<std::byte>(b));
    std::vector<std::uint8_t> header;
    put_number(header, static_cast<std::uint32_t>(width));
    put_number(header, static_cast<std::uint32_t>(height));
    header.insert(header.end(), {8, static_cast<std::uint8_t>(with_alpha ? 6 : 2), 0, 0, 0});
    chunk("IHDR", header);
    const std::uint8_t perceptual = 0;
    chunk("sRGB", {&perceptual, 1});
}

void put_number(std::vector<std::uint8_t>& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

bool has_transparency(const Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
        if (image.rgba[i] != 255) return true;
    }
    return false;
}

std::vector<std::uint8_t> deflated_pixels(const Image& image, bool with_alpha) {
    std::vector<std::uint8_t> filtered;
    std::vector<std::uint8_t> above(image.width * (with_alpha ? 4 : 3));
    for (std::int64_t y = 0; y < image.height; ++y) {
        std::vector<std::uint8_t> row = row_of(image, y, with_alpha);
        filter_row(row, above, with_alpha ? 4 : 3, filtered);
        above = std::move(row);
    }
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(libdeflate_alloc_compressor(6),
                                                                                              libdeflate_free_compressor);
    if (!compressor) throw Error(ErrorKind::resource, {.what = "not enough memory to compress a picture"});
    std::vector<std::uint8_t> out(libdeflate_zlib_compress_bound(compressor.get(), filtered.size()));
    out.resize(libdeflate_zlib_compress(compressor.get(), filtered.data(), filtered.size(), out.data(), out.size()));
    ISOATLAS_CHECK(!out.empty());
    return out;
}

std::vector<std::byte> encode_png(const Image& image) {
    const bool with_alpha = has_transparency(image);
    PngChunks chunks;
    chunks.begin(image.width, image.height, with_alpha);
    chunks.chunk("IDAT", deflated_pixels(image, with_alpha));
    chunks.chunk("IEND", {});
    return std::move(chunks.bytes);
}

}  // namespace isoatlas

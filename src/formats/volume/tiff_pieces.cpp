// Strips and tiles of a TIFF file, decoded and checked.
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/check.h"
#include "field/copy_box.h"
#include "formats/common/byte_source.h"
#include "formats/volume/tiff_handle.h"
#include "formats/volume/tiff_lengths.h"

namespace isoatlas {

/// Decoded bytes of a strip or tile, with its checksum verified where its code has one; `wanted` where the size is unknown.
std::int64_t TiffFile::Handle::decoded_bytes(std::uint32_t number, std::int64_t wanted) {
    const int compression = tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    const auto offset = static_cast<std::int64_t>(TIFFGetStrileOffset(tiff, number));
    const std::int64_t room = client.file->size() - offset;
    const auto bytes = static_cast<std::int64_t>(std::min(TIFFGetStrileByteCount(tiff, number), static_cast<std::uint64_t>(room)));
    if (compression == COMPRESSION_DEFLATE || compression == COMPRESSION_ADOBE_DEFLATE) {
        return inflated_bytes(client.path, offset, bytes, wanted + kMaxRest);
    }
    if (compression != COMPRESSION_LZW && compression != COMPRESSION_PACKBITS) return wanted;
    packed.resize(static_cast<std::size_t>(bytes));
    read_fully(*client.file, client.path, offset, packed);
    return compression == COMPRESSION_LZW ? lzw_bytes(packed).value_or(wanted) : packbits_bytes(packed);
}

/// Is the strip or tile one deflate stream that ends with the checksum of these decoded bytes? Not known where they are not those of the
/// stream, for a predictor or the byte order.
bool TiffFile::Handle::ends_with_checksum_of(std::uint32_t number, std::span<const std::byte> decoded) {
    const int compression = tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    if (compression != COMPRESSION_DEFLATE && compression != COMPRESSION_ADOBE_DEFLATE) return false;
    if (tag<std::uint16_t>(TIFFTAG_PREDICTOR, PREDICTOR_NONE) != PREDICTOR_NONE) return false;
    std::array<std::byte, 4> end{};
    const std::uint64_t offset = TIFFGetStrileOffset(tiff, number), bytes = TIFFGetStrileByteCount(tiff, number);
    const auto size = static_cast<std::uint64_t>(client.file->size());
    if (bytes < end.size() || offset > size || bytes > size - offset) return false;
    read_fully(*client.file, client.path, static_cast<std::int64_t>(offset + bytes - end.size()), end);
    std::uint32_t checksum = 0;  // big-endian
    for (const std::byte b : end) checksum = checksum << 8 | std::to_integer<std::uint32_t>(b);
    return checksum == adler32_z(adler32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(decoded.data()), decoded.size());
}

/// libtiff stops when it has enough bytes: before the checksum of deflate, and before superfluous bytes.
void TiffFile::Handle::check_piece(std::uint32_t number, std::span<const std::byte> decoded, const std::string& name) {
    if (ends_with_checksum_of(number, decoded)) return;
    const auto wanted = static_cast<std::int64_t>(decoded.size());
    const std::int64_t found = decoded_bytes(number, wanted);
    if (found == wanted || (found > wanted && skip_rest)) return;
    throw Error(ErrorKind::input,
                {.file = client.path,
                 .where = name,
                 .what = "it decodes to " + std::to_string(found) + (found > wanted + kMaxRest ? " bytes or more" : " bytes"),
                 .expected = std::to_string(wanted) + " bytes",
                 .next = found > wanted ? kMoreThanPixels : "the file is damaged or incomplete: copy or export it again",
                 .reason = found > wanted ? Reason::bytes_after_samples : Reason::none});
}

void TiffFile::Handle::decode(const TiffPage& page, std::uint32_t number, std::span<std::byte> out) {
    load(page.directory, where);
    const bool tiled = TIFFIsTiled(tiff) != 0;
    const std::string name = where + (tiled ? ", tile " : ", strip ") + std::to_string(number);
    const auto wanted = static_cast<tmsize_t>(out.size());
    const tmsize_t done =
        tiled ? TIFFReadEncodedTile(tiff, number, out.data(), wanted) : TIFFReadEncodedStrip(tiff, number, out.data(), wanted);
    if (done != wanted) corrupt(name, "cannot be read");
    check_piece(number, out, name);
}

void TiffFile::read_piece(const TiffPage& page, std::int64_t column, std::int64_t row, const PixelChoice& choice,
                          std::span<std::byte> out) {
    Handle& handle = *handle_;
    handle.load(page.directory, handle.where);
    const bool tiled = TIFFIsTiled(handle.tiff) != 0;
    const auto pixels = static_cast<std::size_t>(rows_of_piece(page, row, tiled) * page.piece_width);
    const std::size_t plane_bytes = pixels * size_of(page.type);
    ISOATLAS_CHECK(out.size() >= plane_bytes && choice.sample < page.pixel.values());
    const std::int64_t number = row * pieces_across(page) + column, of_plane = pieces_across(page) * pieces_down(page);
    const std::span<std::byte> values = out.first(plane_bytes);
    const auto plane = [&](int sample) { return static_cast<std::uint32_t>(sample * of_plane + number); };
    if (page.pixel.samples == 1) return handle.decode(page, plane(0), values);
    if (!page.is_planar) {
        handle.pixels.resize(plane_bytes * static_cast<std::size_t>(page.pixel.samples));
        handle.decode(page, plane(0), handle.pixels);
        return take_values(handle.pixels, page.pixel.samples, page.type, choice, values);
    }
    if (!choice.is_luminance) return handle.decode(page, plane(choice.sample), values);
    const std::size_t sample = size_of(page.type);
    handle.pixels.resize(3 * plane_bytes);
    handle.plane.resize(plane_bytes);
    for (int colour = 0; colour < 3; ++colour) {
        handle.decode(page, plane(colour), handle.plane);
        std::byte* to = handle.pixels.data() + static_cast<std::size_t>(colour) * sample;
        for (std::size_t i = 0; i < pixels; ++i) std::memcpy(to + 3 * i * sample, handle.plane.data() + i * sample, sample);
    }
    take_values(handle.pixels, 3, page.type, choice, values);
}

void TiffFile::read(const TiffPage& page, const PixelChoice& choice, std::span<std::byte> out) {
    ISOATLAS_CHECK(static_cast<std::int64_t>(out.size()) == page.bytes());
    const Index3 piece{page.piece_width, page.piece_height, 1}, whole{page.width, page.height, 1};
    std::vector<std::byte> decoded(static_cast<std::size_t>(piece.product()) * size_of(page.type));
    for (std::int64_t row = 0; row < pieces_down(page); ++row) {
        for (std::int64_t column = 0; column < pieces_across(page); ++column) {
            read_piece(page, column, row, choice, decoded);
            const Index3 begin{column * page.piece_width, row * page.piece_height, 0};
            copy_box(min(begin + piece, whole) - begin, {decoded, piece, {0, 0, 0}}, {out, whole, begin}, size_of(page.type));
        }
    }
}

std::int64_t TiffFile::contiguous_offset(const TiffPage& page) {
    handle_->load(page.directory, handle_->where);
    TIFF* tiff = handle_->tiff;
    if (page.compression != COMPRESSION_NONE || page.is_planar || TIFFIsTiled(tiff) != 0) return -1;
    if (handle_->tag<std::uint16_t>(TIFFTAG_FILLORDER, FILLORDER_MSB2LSB) != FILLORDER_MSB2LSB) return -1;
    const std::uint32_t strips = TIFFNumberOfStrips(tiff);
    const std::uint64_t first = TIFFGetStrileOffset(tiff, 0);
    std::uint64_t expected = first;
    for (std::uint32_t strip = 0; strip < strips; ++strip) {
        if (TIFFGetStrileOffset(tiff, strip) != expected) return -1;
        expected += TIFFGetStrileByteCount(tiff, strip);
    }
    const std::uint64_t bytes = static_cast<std::uint64_t>(page.bytes()) * static_cast<std::uint64_t>(page.pixel.samples);
    return expected - first == bytes ? static_cast<std::int64_t>(first) : -1;
}

}  // namespace isoatlas

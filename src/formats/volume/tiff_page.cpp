// What a directory of a TIFF file says of its pixels, and whether the file can hold them.
#include <algorithm>
#include <limits>

#include "formats/volume/tiff_handle.h"

namespace isoatlas {
namespace {

/// Max expansion of one compressed byte: a strip that claims more is damaged. Source: the longest match or run of each code over its
/// shortest symbol (LZW: a 12-bit code for 4096 bytes; ZSTD: a 4-byte run-length block for 128 KiB).
std::int64_t largest_ratio(int compression) {
    switch (compression) {
        case COMPRESSION_NONE: return 1;
        case COMPRESSION_PACKBITS: return 64;
        case COMPRESSION_LZW: return 2731;
        case COMPRESSION_DEFLATE:
        case COMPRESSION_ADOBE_DEFLATE: return 1032;
        case COMPRESSION_PIXARLOG: return 4 * 1032;
        case COMPRESSION_JPEG:
        case COMPRESSION_OJPEG: return 1024;
        case COMPRESSION_LZMA: return 1 << 14;
        case COMPRESSION_ZSTD: return 1 << 16;
        default: return 1 << 20;  // LERC stores constant blocks in a few bytes
    }
}

}  // namespace

/// libtiff treats a truncated link to the next directory as the end of the file: pages would be lost silently.
std::vector<TiffEntry> TiffFile::Handle::directory_entries() const {
    auto entries = read_tiff_entries(*client.file, client.path, current, TIFFIsBigTIFF(tiff) != 0, TIFFIsBigEndian(tiff) != 0);
    if (!entries) corrupt(where, "the file ends inside the directory of this page");
    return std::move(*entries);
}

void TiffFile::Handle::check_entries(const std::vector<TiffEntry>& entries) const {
    const std::string doubt = doubtful_tag(entries, tag<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1));
    if (!doubt.empty()) corrupt(where, "its directory is damaged: " + doubt);
    const std::uint64_t listed = pieces_listed(entries),
                        wanted = TIFFIsTiled(tiff) != 0 ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    if (listed <= wanted || skip_rest) return;
    throw Error(ErrorKind::input, {.file = client.path,
                                   .where = where,
                                   .what = "its directory lists " + std::to_string(listed) + " strips or tiles",
                                   .expected = std::to_string(wanted) + " for its size",
                                   .next = kMoreThanPixels,
                                   .reason = Reason::bytes_after_samples});
}

TiffPage TiffFile::Handle::describe_page() const {
    TiffPage page;
    page.width = tag<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
    page.height = tag<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
    page.compression = tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    page.directory = current;
    page.pixel = pixel_kind(page.compression);
    page.is_planar = page.pixel.samples > 1 && tag<std::uint16_t>(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
    if (page.width < 1 || page.height < 1) corrupt(where, "it has no pixels");
    if (TIFFIsCODECConfigured(static_cast<std::uint16_t>(page.compression)) == 0) {
        unsupported("compression " + std::to_string(page.compression) + " is not known to the installed libtiff", "",
                    "save it with Deflate or LZW compression, or without compression");
    }
    page.type = sample_type();
    require_one_slice();
    const bool tiled = TIFFIsTiled(tiff) != 0;
    page.piece_width = tiled ? tag<std::uint32_t>(TIFFTAG_TILEWIDTH, 0) : page.width;
    page.piece_height = tiled ? tag<std::uint32_t>(TIFFTAG_TILELENGTH, 0)
                              : std::min<std::int64_t>(tag<std::uint32_t>(TIFFTAG_ROWSPERSTRIP, 0), page.height);
    if (page.piece_width < 1 || page.piece_height < 1) corrupt(where, "its strips or tiles are not described");
    page.reduced_images = std::ssize(reduced_images());
    return page;
}

/// Silicon Graphics' tags for volumes; libtiff reads the tiles of such a page, but does not say that the others are there.
void TiffFile::Handle::require_one_slice() const {
    const auto slices = std::max(tag<std::uint32_t>(TIFFTAG_IMAGEDEPTH, 1), tag<std::uint32_t>(TIFFTAG_TILEDEPTH, 1));
    if (slices <= 1) return;
    unsupported("the page has pixels of " + std::to_string(slices) + " slices (ImageDepth, TileDepth)", "a page for each slice",
                "save it as a stack of pages, e.g. tifffile.imwrite(..., volumetric=False)");
}

PixelKind TiffFile::Handle::pixel_kind(int compression) const {
    const int photometric = tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    PixelKind kind{.samples = tag<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1)};
    if (kind.samples < 1) corrupt(where, "its pixels have no samples");
    const bool is_decoded = photometric == PHOTOMETRIC_YCBCR && compression == COMPRESSION_JPEG;
    kind.is_rgb = kind.samples >= 3 && (photometric == PHOTOMETRIC_RGB || is_decoded);
    const bool is_foreign = photometric > PHOTOMETRIC_MASK && !is_decoded && photometric < PHOTOMETRIC_CFA;
    if (is_foreign || (photometric == PHOTOMETRIC_RGB && !kind.is_rgb)) {
        unsupported(std::to_string(kind.samples) + " values per pixel that are colours of kind " + std::to_string(photometric),
                    "grey values, several channels, or RGB", "convert it to grey values or RGB, e.g. in Fiji: Image > Type");
    }
    std::uint16_t extra = 0;
    const std::uint16_t* kinds = nullptr;
    if (kind.samples == 1 || TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extra, &kinds) != 1 || kinds == nullptr) extra = 0;
    const auto is_alpha = [](std::uint16_t one) { return one == EXTRASAMPLE_ASSOCALPHA || one == EXTRASAMPLE_UNASSALPHA; };
    while (kind.alphas < extra && is_alpha(kinds[extra - 1 - kind.alphas])) ++kind.alphas;
    if (kind.is_rgb) kind.alphas = kind.samples - 3;
    if (kind.values() < 1) kind.alphas = 0;
    return kind;
}

ValueType TiffFile::Handle::sample_type() const {
    const int bits = tag<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
    const int format = tag<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    const bool is_unsigned = format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID;
    if (bits == 8 && is_unsigned) return ValueType::u8;
    if (bits == 16 && is_unsigned) return ValueType::u16;
    if (bits == 32 && is_unsigned) return ValueType::u32;
    if (bits == 8 && format == SAMPLEFORMAT_INT) return ValueType::i8;
    if (bits == 16 && format == SAMPLEFORMAT_INT) return ValueType::i16;
    if (bits == 32 && format == SAMPLEFORMAT_INT) return ValueType::i32;
    if (bits == 32 && format == SAMPLEFORMAT_IEEEFP) return ValueType::f32;
    if (bits == 64 && format == SAMPLEFORMAT_IEEEFP) return ValueType::f64;
    const char* name = is_unsigned                     ? "unsigned integers"
                       : format == SAMPLEFORMAT_INT    ? "signed integers"
                       : format == SAMPLEFORMAT_IEEEFP ? "floating point numbers"
                                                       : "complex numbers";
    unsupported("samples are " + std::to_string(bits) + "-bit " + name, "8, 16 or 32-bit integers, 32 or 64-bit floating point",
                "convert it, e.g. in Fiji: Image > Type > 8-bit, 16-bit or 32-bit");
}

void TiffFile::Handle::check_page(const TiffPage& page) const {
    const std::int64_t max = std::numeric_limits<std::int64_t>::max() / 16;
    const std::int64_t piece_pixels_max = max / page.pixel.samples / page.piece_width;
    if (page.width > max / page.pixel.samples / page.height || page.piece_height > piece_pixels_max)
        corrupt(where, "its size does not fit in 63 bits");
    check_pieces(page);
}

/// Every strip or tile must be able to hold its pixels.
void TiffFile::Handle::check_pieces(const TiffPage& page) const {
    const bool tiled = TIFFIsTiled(tiff) != 0;
    const std::int64_t pieces = tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff),
                       of_plane = pieces_across(page) * pieces_down(page);
    const std::int64_t ratio = largest_ratio(page.compression);
    if (pieces != of_plane * (page.is_planar ? page.pixel.samples : 1)) corrupt(where, "its strips or tiles are not described");
    const bool is_deflate = page.compression == COMPRESSION_DEFLATE || page.compression == COMPRESSION_ADOBE_DEFLATE;
    if (is_deflate && tag<std::uint16_t>(TIFFTAG_FILLORDER, FILLORDER_MSB2LSB) != FILLORDER_MSB2LSB) {
        unsupported("the bits of its deflate streams are in reverse order", "FillOrder 1", "save it again with another program");
    }
    const std::int64_t row_bytes = page.piece_width * interleaved(page) * static_cast<std::int64_t>(size_of(page.type));
    const std::int64_t file_bytes = client.file->size();
    for (std::int64_t piece = 0; piece < pieces; ++piece) {
        const std::int64_t wanted = rows_of_piece(page, piece % of_plane / pieces_across(page), tiled) * row_bytes;
        const auto number = static_cast<std::uint32_t>(piece);
        const std::uint64_t offset = TIFFGetStrileOffset(tiff, number), count = TIFFGetStrileByteCount(tiff, number);
        const auto end = static_cast<std::uint64_t>(file_bytes);
        const std::int64_t present = offset >= end ? 0 : static_cast<std::int64_t>(std::min(count, end - offset));
        if (wanted / ratio <= present && present > 0) continue;
        throw Error(ErrorKind::input, {.file = client.path,
                                       .where = where + ", " + (tiled ? "tile " : "strip ") + std::to_string(piece),
                                       .what = "the file has " + std::to_string(present) + " bytes of it",
                                       .expected = ratio == 1 ? std::to_string(wanted) + " bytes" : std::to_string(count) + " bytes",
                                       .next = "the file is truncated or its header is wrong: copy or export it again"});
    }
}

bool TiffFile::Handle::is_cut_off() const {
    const std::int64_t pieces = TIFFIsTiled(tiff) != 0 ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    const auto end = static_cast<std::uint64_t>(client.file->size());
    for (std::int64_t piece = 0; piece < pieces; ++piece) {
        const auto number = static_cast<std::uint32_t>(piece);
        const std::uint64_t offset = TIFFGetStrileOffset(tiff, number), count = TIFFGetStrileByteCount(tiff, number);
        if (offset > end || count > end - offset) return true;
    }
    return false;
}

}  // namespace isoatlas

#include "formats/volume/tiff_file.h"

#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "base/check.h"
#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/tiff_client.h"
#include "formats/volume/tiff_directory.h"
#include "formats/volume/tiff_lengths.h"

namespace isoatlas {

namespace {

constexpr const char* kMoreThanPixels = "the file is damaged, or its program writes more than the pixels: then let the rest be skipped";

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

struct TiffFile::Handle {
    TiffClient client;
    TIFF* tiff = nullptr;
    std::vector<TiffPage> pages;
    std::int64_t previews = 0;
    TiffTags tags;
    std::uint64_t current = 0;  ///< offset of the directory that is loaded
    std::vector<std::byte> tile, packed;
    bool skip_rest;  ///< a strip or tile may decode to more than its pixels

    Handle(const std::string& path, bool may_skip_rest)
        : client{.path = path, .file = open_file(path), .messages = {}}, skip_rest(may_skip_rest) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (tiff != nullptr) TIFFClose(tiff);
    }

    void open();
    void list_pages();
    [[nodiscard]] std::vector<TiffEntry> directory_entries() const;
    void check_entries(const std::vector<TiffEntry>& entries) const;
    [[nodiscard]] TiffPage describe_page() const;
    [[nodiscard]] ValueType sample_type() const;
    void check_page(const TiffPage& page) const;
    void check_pieces(const TiffPage& page) const;
    void read_tags();
    void load(std::int64_t page);
    void check_piece(std::uint32_t piece, std::int64_t wanted, const std::string& where);
    [[nodiscard]] std::int64_t decoded_bytes(std::uint32_t piece, std::int64_t wanted);
    void read_strips(std::span<std::byte> out, const std::string& where);
    void read_tiles(const TiffPage& page, std::span<std::byte> out, const std::string& where);
    void copy_tile(const TiffPage& page, std::int64_t x, std::int64_t y, std::span<std::byte> out) const;

    template <class T>
    [[nodiscard]] T tag(std::uint32_t number, T missing) const {
        T value = missing;
        return TIFFGetFieldDefaulted(tiff, number, &value) == 1 ? value : missing;
    }
    [[nodiscard]] std::string next_page() const { return "page " + std::to_string(static_cast<std::int64_t>(pages.size()) + previews); }

    [[noreturn]] void corrupt(const std::string& where, const std::string& what) const {
        const std::string text = client.messages.empty() ? what : what + ": " + client.messages;
        throw Error(
            ErrorKind::input,
            {.file = client.path, .where = where, .what = text, .next = "the file is damaged or incomplete: copy or export it again"});
    }
    [[noreturn]] void unsupported(const std::string& what, const std::string& expected, const std::string& next) const {
        throw Error(ErrorKind::unsupported, {.file = client.path, .where = next_page(), .what = what, .expected = expected, .next = next});
    }
};

void TiffFile::Handle::open() {
    tiff = open_tiff_client(client);
    if (tiff == nullptr) corrupt("header", "cannot be read as TIFF");
    list_pages();
}

void TiffFile::Handle::list_pages() {
    do {
        client.messages.clear();
        current = TIFFCurrentDirOffset(tiff);
        const std::vector<TiffEntry> entries = directory_entries();
        constexpr std::uint32_t kPreview = FILETYPE_REDUCEDIMAGE | FILETYPE_MASK;
        if ((tag<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0) & kPreview) != 0 && !pages.empty()) {
            ++previews;
            client.messages.clear();
            continue;
        }
        const TiffPage page = describe_page();
        check_entries(entries);
        if (pages.empty()) read_tags();
        check_page(page);
        pages.push_back(page);
        client.messages.clear();
    } while (TIFFReadDirectory(tiff) == 1);
    // A valid end of the chain of directories has no message and no link.
    if (!client.messages.empty() || TIFFLastDirectory(tiff) == 0) corrupt(next_page(), "its directory cannot be read");
}

/// libtiff treats a truncated link to the next directory as the end of the file: pages would be lost silently.
std::vector<TiffEntry> TiffFile::Handle::directory_entries() const {
    auto entries = read_tiff_entries(*client.file, client.path, current, TIFFIsBigTIFF(tiff) != 0, TIFFIsBigEndian(tiff) != 0);
    if (!entries) corrupt(next_page(), "the file ends inside the directory of this page");
    return std::move(*entries);
}

void TiffFile::Handle::check_entries(const std::vector<TiffEntry>& entries) const {
    const std::string doubt = doubtful_tag(entries);
    if (!doubt.empty()) corrupt(next_page(), "its directory is damaged: " + doubt);
    const std::uint64_t listed = pieces_listed(entries),
                        wanted = TIFFIsTiled(tiff) != 0 ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    if (listed <= wanted || skip_rest) return;
    throw Error(ErrorKind::input, {.file = client.path,
                                   .where = next_page(),
                                   .what = "its directory lists " + std::to_string(listed) + " strips or tiles",
                                   .expected = std::to_string(wanted) + " for its size",
                                   .next = kMoreThanPixels,
                                   .reason = Reason::bytes_after_samples});
}

TiffPage TiffFile::Handle::describe_page() const {
    const int samples = tag<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
    if (samples != 1) {
        unsupported(std::to_string(samples) + " values per pixel (colour)", "one value per pixel",
                    "convert it to grey values or save one channel, e.g. in Fiji: Image > Type, or Image > Color > Split Channels");
    }
    TiffPage page;
    page.width = tag<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
    page.height = tag<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
    page.compression = tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    page.directory = current;
    if (page.width < 1 || page.height < 1) corrupt(next_page(), "it has no pixels");
    if (TIFFIsCODECConfigured(static_cast<std::uint16_t>(page.compression)) == 0) {
        unsupported("compression " + std::to_string(page.compression) + " is not known to the installed libtiff", "",
                    "save it with Deflate or LZW compression, or without compression");
    }
    page.type = sample_type();
    return page;
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
    if (page.width > max / page.height) corrupt(next_page(), "its size does not fit in 63 bits");
    check_pieces(page);
    if (pages.empty() || page.same_shape(pages[0])) return;
    const auto shape = [](const TiffPage& p) { return std::to_string(p.width) + " x " + std::to_string(p.height) + " " + name_of(p.type); };
    throw Error(ErrorKind::input, {.file = client.path,
                                   .where = next_page(),
                                   .what = "the page is " + shape(page),
                                   .expected = shape(pages[0]) + " like page 0",
                                   .next = "split the file: all pages of a volume must have one size and type"});
}

/// Every strip or tile must be able to hold its pixels.
void TiffFile::Handle::check_pieces(const TiffPage& page) const {
    const bool tiled = TIFFIsTiled(tiff) != 0;
    const std::uint32_t pieces = tiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
    const std::uint64_t full = tiled ? TIFFTileSize64(tiff) : TIFFStripSize64(tiff);
    const std::int64_t ratio = largest_ratio(page.compression);
    if (pieces == 0 || full == 0) corrupt(next_page(), "its strips or tiles are not described");
    const bool is_deflate = page.compression == COMPRESSION_DEFLATE || page.compression == COMPRESSION_ADOBE_DEFLATE;
    if (is_deflate && tag<std::uint16_t>(TIFFTAG_FILLORDER, FILLORDER_MSB2LSB) != FILLORDER_MSB2LSB) {
        unsupported("the bits of its deflate streams are in reverse order", "FillOrder 1", "save it again with another program");
    }
    for (std::uint32_t piece = 0; piece < pieces; ++piece) {
        const bool last_strip = !tiled && piece + 1 == pieces;
        const std::uint64_t wanted = last_strip ? static_cast<std::uint64_t>(page.bytes()) - (pieces - 1) * full : full;
        const std::uint64_t offset = TIFFGetStrileOffset(tiff, piece), count = TIFFGetStrileByteCount(tiff, piece);
        const auto file_bytes = static_cast<std::uint64_t>(client.file->size());
        const std::uint64_t present = offset >= file_bytes ? 0 : std::min(count, file_bytes - offset);
        if (wanted / static_cast<std::uint64_t>(ratio) <= present && present > 0) continue;
        throw Error(ErrorKind::input, {.file = client.path,
                                       .where = next_page() + ", " + (tiled ? "tile " : "strip ") + std::to_string(piece),
                                       .what = "the file has " + std::to_string(present) + " bytes of it",
                                       .expected = std::to_string(ratio == 1 ? wanted : count) + " bytes",
                                       .next = "the file is truncated or its header is wrong: copy or export it again"});
    }
}

void TiffFile::Handle::read_tags() {
    const char* text = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text != nullptr) tags.description = text;
    float x = 0, y = 0;
    if (TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x) == 1) tags.x_resolution = static_cast<double>(x);
    if (TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y) == 1) tags.y_resolution = static_cast<double>(y);
    tags.resolution_unit = tag<std::uint16_t>(TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
    tags.photometric = tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
}

void TiffFile::Handle::load(std::int64_t page) {
    const std::uint64_t directory = pages[static_cast<std::size_t>(page)].directory;
    client.messages.clear();
    if (directory == current) return;
    if (TIFFSetSubDirectory(tiff, directory) != 1) corrupt("page " + std::to_string(page), "its directory cannot be read");
    current = directory;
}

/// Decoded bytes of a strip or tile, with its checksum verified where its code has one; `wanted` where the size is unknown.
std::int64_t TiffFile::Handle::decoded_bytes(std::uint32_t piece, std::int64_t wanted) {
    const int compression = tag<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
    const auto offset = static_cast<std::int64_t>(TIFFGetStrileOffset(tiff, piece));
    const std::int64_t room = client.file->size() - offset;
    const auto bytes = static_cast<std::int64_t>(std::min(TIFFGetStrileByteCount(tiff, piece), static_cast<std::uint64_t>(room)));
    if (compression == COMPRESSION_DEFLATE || compression == COMPRESSION_ADOBE_DEFLATE) {
        return inflated_bytes(client.path, offset, bytes, wanted + kMaxRest);
    }
    if (compression != COMPRESSION_LZW && compression != COMPRESSION_PACKBITS) return wanted;
    packed.resize(static_cast<std::size_t>(bytes));
    read_fully(*client.file, client.path, offset, packed);
    return compression == COMPRESSION_LZW ? lzw_bytes(packed).value_or(wanted) : packbits_bytes(packed);
}

/// libtiff stops when it has enough bytes: before the checksum of deflate, and before superfluous bytes.
void TiffFile::Handle::check_piece(std::uint32_t piece, std::int64_t wanted, const std::string& where) {
    const std::int64_t found = decoded_bytes(piece, wanted);
    if (found == wanted || (found > wanted && skip_rest)) return;
    throw Error(ErrorKind::input,
                {.file = client.path,
                 .where = where,
                 .what = "it decodes to " + std::to_string(found) + (found > wanted + kMaxRest ? " bytes or more" : " bytes"),
                 .expected = std::to_string(wanted) + " bytes",
                 .next = found > wanted ? kMoreThanPixels : "the file is damaged or incomplete: copy or export it again",
                 .reason = found > wanted ? Reason::bytes_after_samples : Reason::none});
}

void TiffFile::Handle::read_strips(std::span<std::byte> out, const std::string& where) {
    const auto strip_bytes = static_cast<std::size_t>(TIFFStripSize64(tiff));
    std::uint32_t strip = 0;
    for (std::size_t begin = 0; begin < out.size(); begin += strip_bytes, ++strip) {
        const std::span<std::byte> part = out.subspan(begin, std::min(strip_bytes, out.size() - begin));
        const tmsize_t wanted = static_cast<tmsize_t>(part.size());
        if (TIFFReadEncodedStrip(tiff, strip, part.data(), wanted) != wanted) {
            corrupt(where + ", strip " + std::to_string(strip), "cannot be read");
        }
        check_piece(strip, wanted, where + ", strip " + std::to_string(strip));
    }
}

void TiffFile::Handle::read_tiles(const TiffPage& page, std::span<std::byte> out, const std::string& where) {
    const auto width = tag<std::uint32_t>(TIFFTAG_TILEWIDTH, 0), height = tag<std::uint32_t>(TIFFTAG_TILELENGTH, 0);
    tile.resize(static_cast<std::size_t>(TIFFTileSize64(tiff)));  // check_pieces has verified that the file can hold it
    std::uint32_t number = 0;
    for (std::int64_t y = 0; y < page.height; y += height) {
        for (std::int64_t x = 0; x < page.width; x += width, ++number) {
            const tmsize_t wanted = static_cast<tmsize_t>(tile.size());
            if (TIFFReadEncodedTile(tiff, number, tile.data(), wanted) != wanted) {
                corrupt(where + ", tile " + std::to_string(number), "cannot be read");
            }
            check_piece(number, wanted, where + ", tile " + std::to_string(number));
            copy_tile(page, x, y, out);
        }
    }
}

/// The part of the tile inside the page.
void TiffFile::Handle::copy_tile(const TiffPage& page, std::int64_t x, std::int64_t y, std::span<std::byte> out) const {
    const std::int64_t tile_width = tag<std::uint32_t>(TIFFTAG_TILEWIDTH, 0), tile_height = tag<std::uint32_t>(TIFFTAG_TILELENGTH, 0);
    const auto sample = static_cast<std::int64_t>(size_of(page.type));
    const std::int64_t columns = std::min(tile_width, page.width - x), rows = std::min(tile_height, page.height - y);
    for (std::int64_t row = 0; row < rows; ++row) {
        std::memcpy(out.data() + (y + row) * page.row_bytes() + x * sample, tile.data() + row * tile_width * sample,
                    static_cast<std::size_t>(columns * sample));
    }
}

TiffFile::TiffFile(const std::string& path, bool skip_rest) : handle_(std::make_unique<Handle>(path, skip_rest)) { handle_->open(); }
TiffFile::~TiffFile() = default;
TiffFile::TiffFile(TiffFile&&) noexcept = default;
TiffFile& TiffFile::operator=(TiffFile&&) noexcept = default;

const std::string& TiffFile::path() const { return handle_->client.path; }
const std::vector<TiffPage>& TiffFile::pages() const { return handle_->pages; }
std::int64_t TiffFile::previews() const { return handle_->previews; }
const TiffTags& TiffFile::tags() const { return handle_->tags; }
bool TiffFile::big_endian() const { return TIFFIsBigEndian(handle_->tiff) != 0; }
std::int64_t TiffFile::bytes() const { return handle_->client.file->size(); }

bool TiffFile::is_big_tiff() const { return TIFFIsBigTIFF(handle_->tiff) != 0; }

std::string TiffFile::encoding() const {
    const int compression = pages()[0].compression;
    if (compression == COMPRESSION_NONE) return "raw";
    const TIFFCodec* codec = TIFFFindCODEC(static_cast<std::uint16_t>(compression));
    return codec == nullptr ? "compression " + std::to_string(compression) : codec->name;
}

std::int64_t TiffFile::contiguous_offset() {
    const TiffPage& page = pages()[0];
    handle_->load(0);
    if (page.compression != COMPRESSION_NONE || TIFFIsTiled(handle_->tiff) != 0) return -1;
    const std::uint32_t strips = TIFFNumberOfStrips(handle_->tiff);
    const std::uint64_t first = TIFFGetStrileOffset(handle_->tiff, 0);
    std::uint64_t expected = first;
    for (std::uint32_t strip = 0; strip < strips; ++strip) {
        if (TIFFGetStrileOffset(handle_->tiff, strip) != expected) return -1;
        expected += TIFFGetStrileByteCount(handle_->tiff, strip);
    }
    return expected - first == static_cast<std::uint64_t>(page.bytes()) ? static_cast<std::int64_t>(first) : -1;
}

void TiffFile::read(std::int64_t page, std::span<std::byte> out) {
    ISOATLAS_CHECK(page >= 0 && page < static_cast<std::int64_t>(pages().size()));
    const TiffPage& shape = pages()[static_cast<std::size_t>(page)];
    ISOATLAS_CHECK(static_cast<std::int64_t>(out.size()) == shape.bytes());
    handle_->load(page);
    const std::string where = "page " + std::to_string(page);
    if (TIFFIsTiled(handle_->tiff) != 0) {
        handle_->read_tiles(shape, out, where);
    } else {
        handle_->read_strips(out, where);
    }
}

void TiffFile::read_raw(std::int64_t offset, std::span<std::byte> out) { read_fully(*handle_->client.file, path(), offset, out); }

}  // namespace isoatlas

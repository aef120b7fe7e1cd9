// BMP: uncompressed pixels of 8, 24 and 32 bits, rows from the bottom or from the top.
#include <algorithm>
#include <cstdlib>

#include "formats/common/byte_cursor.h"
#include "formats/common/byte_source.h"
#include "formats/common/field_reader.h"
#include "formats/common/file_access.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/picture.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kFileHeader = 14, kCoreHeader = 12, kInfoHeader = 40, kMaxHeader = 124, kMaxColours = 256;

/// Fields after the 14 bytes of the file header.
struct BmpHeader {
    std::int64_t pixels = 0;  ///< offset in the file
    std::int64_t header = 0;  ///< its bytes
    std::int64_t width = 0, height = 0;
    bool is_from_top = false;
    int planes = 0, bits = 0;
    std::uint32_t compression = 0, colours = 0;
    std::int32_t x_per_metre = 0, y_per_metre = 0;
};

bool is_bmp_header_size(std::int64_t size) {
    constexpr std::array<std::int64_t, 7> kSizes{kCoreHeader, kInfoHeader, 52, 56, 64, 108, kMaxHeader};
    return std::ranges::find(kSizes, size) != kSizes.end();
}

class BmpPicture final : public PictureFile {
public:
    explicit BmpPicture(const std::string& path) : path_(path), file_(open_file(path)) {
        picture_.kind = PictureKind::bmp;
        picture_.file_bytes = file_->size();
        read_header();
        check_kind();
        picture_.width = header_.width, picture_.height = header_.height;
        check_size();
        if (header_.bits == 8) {
            read_table();
            picture_.pixel = table_.pixel_kind();
            if (table_.is_grey() && !is_identity())
                picture_.notes.emplace_back("the grey levels of the colour table are read, not its indices");
        } else {
            picture_.pixel = {.samples = header_.bits / 8, .alphas = header_.bits == 32 ? 1 : 0, .is_rgb = true};
        }
        if (header_.x_per_metre > 0 && header_.y_per_metre > 0)
            picture_.spacing = {1000.0 / header_.x_per_metre, 1000.0 / header_.y_per_metre};
    }

    void read(const TakeRow& take) override {
        std::vector<std::byte> stored(static_cast<std::size_t>(stride())), row(picture_.row_bytes());
        for (std::int64_t i = 0; i < picture_.height; ++i) {
            read_fully(*file_, path_, header_.pixels + i * stride(), stored);
            const std::int64_t y = header_.is_from_top ? i : picture_.height - 1 - i;
            if (header_.bits > 8)
                turn_colours(stored, row);
            else if (!table_.look_up(std::span(stored).first(static_cast<std::size_t>(picture_.width)), row))
                bad_field(path_, "row " + std::to_string(y), "a pixel has no colour in the table", "");
            take(y, row);
        }
    }

private:
    /// Bytes of a row in the file: a multiple of 4.
    [[nodiscard]] std::int64_t stride() const { return (header_.width * (header_.bits / 8) + 3) / 4 * 4; }

    void read_header() {
        const std::vector<std::byte> bytes = read_header_bytes(path_, kFileHeader + kMaxHeader);
        const auto have = static_cast<std::int64_t>(bytes.size());
        const FieldReader fields(bytes, false);
        if (have < kFileHeader + kCoreHeader) ends_early(have);
        BmpHeader& h = header_;
        h.pixels = fields.at<std::uint32_t>(10);
        h.header = fields.at<std::uint32_t>(14);
        if (!is_bmp_header_size(h.header))
            bad_header(path_, "size of the header", std::to_string(h.header), "12, 40, 52, 56, 64, 108 or 124");
        if (have < kFileHeader + h.header) ends_early(have);
        if (h.header == kCoreHeader) {
            h.width = fields.at<std::uint16_t>(18), h.height = fields.at<std::uint16_t>(20);
            h.planes = fields.at<std::uint16_t>(22), h.bits = fields.at<std::uint16_t>(24);
        } else {
            const std::int64_t height = fields.at<std::int32_t>(22);
            h.width = fields.at<std::int32_t>(18), h.height = std::abs(height), h.is_from_top = height < 0;
            h.planes = fields.at<std::uint16_t>(26), h.bits = fields.at<std::uint16_t>(28);
            h.compression = fields.at<std::uint32_t>(30), h.colours = fields.at<std::uint32_t>(46);
            h.x_per_metre = fields.at<std::int32_t>(38), h.y_per_metre = fields.at<std::int32_t>(42);
        }
        if (h.width < 1 || h.height < 1) bad_header(path_, "width and height", "are not positive", "1 or more");
        if (h.planes != 1) bad_header(path_, "planes", std::to_string(h.planes), "1");
    }

    [[noreturn]] void ends_early(std::int64_t at) const {
        bad_header(path_, "offset " + std::to_string(at), "the file ends early", "a header of 26 to 138 bytes");
    }

    void check_kind() const {
        constexpr std::uint32_t kRaw = 0, kBitFields = 3, kAlphaBitFields = 6;
        const bool is_masked = header_.compression == kBitFields || header_.compression == kAlphaBitFields;
        const bool is_known = header_.bits == 8 || header_.bits == 24 || header_.bits == 32;
        const bool is_read = is_known && (header_.compression == kRaw || (header_.bits == 32 && is_masked && has_usual_masks()));
        if (is_read) return;
        throw Error(ErrorKind::unsupported, {.file = path_,
                                             .where = "header",
                                             .what = "the pixels have " + std::to_string(header_.bits) + " bits and compression " +
                                                     std::to_string(header_.compression),
                                             .expected = "uncompressed pixels of 8, 24 or 32 bits",
                                             .next = "convert the pictures to PNG or TIFF"});
    }
    /// Blue, green, red, alpha; the masks are in the header, or follow it.
    [[nodiscard]] bool has_usual_masks() const {
        constexpr std::int64_t kMasks = kFileHeader + kInfoHeader;
        constexpr std::array<std::uint32_t, 3> kUsual{0x00FF0000, 0x0000FF00, 0x000000FF};
        if (header_.header < kInfoHeader || picture_.file_bytes < kMasks + 12) return false;
        std::array<std::byte, 12> bytes{};
        read_fully(*file_, path_, kMasks, bytes);
        std::array<std::uint32_t, 3> masks{};
        FieldReader(bytes, false).take<std::uint32_t>(0, masks);
        return masks == kUsual;
    }

    void check_size() const {
        const std::int64_t begin = kFileHeader + header_.header;
        if (header_.pixels < begin || header_.pixels > picture_.file_bytes) {
            bad_header(path_, "offset of the pixels", std::to_string(header_.pixels), std::to_string(begin) + " or more, inside the file");
        }
        const std::int64_t rows = (picture_.file_bytes - header_.pixels) / stride();
        if (rows >= header_.height) return;
        throw Error(ErrorKind::input, {.file = path_,
                                       .what = "the file ends after " + std::to_string(rows) + " rows of pixels",
                                       .expected = std::to_string(header_.height) + " rows of " + std::to_string(stride()) + " bytes",
                                       .next = kDamagedFile});
    }

    /// Blue, green, red, and in newer files a byte of no meaning.
    void read_table() {
        const std::int64_t entry = header_.header == kCoreHeader ? 3 : 4, begin = kFileHeader + header_.header;
        const std::int64_t room = (header_.pixels - begin) / entry;
        const std::int64_t count = header_.colours == 0 ? std::min(room, kMaxColours) : std::int64_t{header_.colours};
        if (count > kMaxColours || count > room || count < 1)
            bad_header(path_, "number of colours", std::to_string(count), "1 to 256, in front of the pixels");
        std::vector<std::byte> bytes(static_cast<std::size_t>(count * entry));
        read_fully(*file_, path_, begin, bytes);
        const auto at = [&](std::int64_t i) { return std::to_integer<int>(bytes[static_cast<std::size_t>(i)]); };
        for (std::int64_t i = 0; i < count; ++i) table_.add(at(i * entry + 2), at(i * entry + 1), at(i * entry));
    }
    [[nodiscard]] bool is_identity() const {
        std::vector<std::byte> levels(table_.size()), grey(table_.size());
        for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<std::byte>(i);
        return table_.look_up(levels, grey) && levels == grey;
    }

    void turn_colours(std::span<const std::byte> stored, std::span<std::byte> row) const {
        const auto samples = static_cast<std::size_t>(picture_.pixel.samples);
        for (std::size_t i = 0; i + samples <= row.size(); i += samples) {
            row[i] = stored[i + 2], row[i + 1] = stored[i + 1], row[i + 2] = stored[i];
            if (samples > 3) row[i + 3] = stored[i + 3];
        }
    }

    std::string path_;
    std::unique_ptr<File> file_;
    BmpHeader header_;
    ColourTable table_;
};

}  // namespace

std::unique_ptr<PictureFile> open_bmp_picture(const std::string& path) { return std::make_unique<BmpPicture>(path); }

bool looks_like_bmp(FirstBytes first, const std::string&) {
    constexpr std::size_t kNeeded = 18;
    if (first.size() < kNeeded || first[0] != std::byte{'B'} || first[1] != std::byte{'M'}) return false;
    const FieldReader fields(first, false);
    const std::int64_t header = fields.at<std::uint32_t>(14);
    return is_bmp_header_size(header) && fields.at<std::uint32_t>(10) >= kFileHeader + header;
}

}  // namespace isoatlas

// TiffFile: the pages of a TIFF or BigTIFF file as samples. Only this, tiff_handle.h and tiff_client.h use libtiff.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/volume/pixel_choice.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// A directory of the file and the pixels that it describes.
struct TiffPage {
    std::int64_t width = 0, height = 0;
    ValueType type = ValueType::u8;
    PixelKind pixel;
    bool is_planar = false;                          ///< the samples of a pixel are in planes of their own
    int compression = 1;                             ///< TIFF tag 259; 1: none
    std::int64_t piece_width = 0, piece_height = 0;  ///< of a tile, or of a strip
    std::uint64_t directory = 0;                     ///< byte offset of its directory
    std::int64_t number = 0;                         ///< among all directories of the chain, from 0
    std::int64_t reduced_images = 0;                 ///< that it names as those of a pyramid (SubIFDs)
    bool is_preview = false;                         ///< a reduced image or a mask
    std::shared_ptr<const Error> problem;            ///< why it cannot be read

    [[nodiscard]] std::int64_t pixels() const { return width * height; }
    [[nodiscard]] std::int64_t bytes() const { return pixels() * static_cast<std::int64_t>(size_of(type)); }  ///< of one value a pixel
    [[nodiscard]] bool same_shape(const TiffPage& other) const {
        return width == other.width && height == other.height && type == other.type && pixel == other.pixel;
    }
    [[nodiscard]] bool same_layout(const TiffPage& other) const {
        return same_shape(other) && piece_width == other.piece_width && piece_height == other.piece_height && is_planar == other.is_planar;
    }
    [[nodiscard]] std::string shape() const;  ///< "5 x 4 uint16", "5 x 4 uint8, 3 values per pixel"
};

/// Tags of the first page that describe the whole file.
struct TiffTags {
    std::string description;                    ///< ImageDescription: free text, ImageJ or OME
    double x_resolution = 0, y_resolution = 0;  ///< pixels per unit; 0: not given
    int resolution_unit = 2;                    ///< 1: none, 2: inch, 3: centimetre
    int photometric = 1;                        ///< 0: white is zero, 1: black is zero, 2: colour, 3: palette
    std::vector<std::string> labels;            ///< of the images, by ImageJ
};

/// Reads all directories and checks every page before anything is allocated for samples: every strip or tile must be able to hold its
/// pixels, given its compression. Throws Error: input (not a TIFF, corrupt, truncated), unsupported (bit depths other than 8, 16, 32, 64,
/// colours other than RGB, compressions that this libtiff lacks). Messages of libtiff become part of the error; nothing is printed. Not
/// thread safe.
class TiffFile {
public:
    /// skip_rest: strips and tiles may decode to more bytes than the page has.
    explicit TiffFile(const std::string& path, bool skip_rest = false);
    ~TiffFile();
    TiffFile(TiffFile&&) noexcept;
    TiffFile& operator=(TiffFile&&) noexcept;

    [[nodiscard]] const std::string& path() const;
    /// All directories of the chain, at least one; listed at the first call. A page that cannot be read has a problem, a preview has no
    /// size. Throws Error{input} when the chain is broken.
    [[nodiscard]] const std::vector<TiffPage>& chain();
    /// Those that are no previews, or the first one. Throws the problem of a page.
    [[nodiscard]] std::vector<TiffPage> pages();
    /// The page at the offset of a directory, or a reduced image of that page: level 1, 2, ...; not checked as those of the chain are where
    /// `is_checked` is false.
    [[nodiscard]] TiffPage page_at(std::uint64_t directory, std::int64_t number, std::int64_t level, bool is_checked);
    [[nodiscard]] const TiffTags& tags();
    [[nodiscard]] bool big_endian() const;
    [[nodiscard]] bool is_big_tiff() const;
    [[nodiscard]] std::int64_t bytes() const;  ///< size of the file
    /// Name of a compression; "raw" for none.
    [[nodiscard]] static std::string encoding(int compression);
    /// Offset of the first sample when the page is uncompressed and its strips follow each other, else -1.
    [[nodiscard]] std::int64_t contiguous_offset(const TiffPage& page);
    /// Decodes the strip or tile in this column and row of them, host byte order. out: its values, piece_width x piece_height; those
    /// outside the page are not written for strips. Throws Error{input} naming the page: also when the checksum of a deflate stream is
    /// wrong, or when a strip or tile of deflate, LZW or PackBits does not decode to exactly its pixels.
    void read_piece(const TiffPage& page, std::int64_t column, std::int64_t row, const PixelChoice& choice, std::span<std::byte> out);
    /// The whole page; out.size() == page.bytes().
    void read(const TiffPage& page, const PixelChoice& choice, std::span<std::byte> out);
    /// The bytes of the file themselves.
    void read_raw(std::int64_t offset, std::span<std::byte> out);

private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
};

}  // namespace isoatlas

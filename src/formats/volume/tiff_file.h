// TiffFile: the pages of a TIFF or BigTIFF file as samples. Only this and tiff_client.h use libtiff.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

struct TiffPage {
    std::int64_t width = 0, height = 0;
    ValueType type = ValueType::u8;
    int compression = 1;          ///< TIFF tag 259; 1: none
    std::uint64_t directory = 0;  ///< byte offset of its directory

    [[nodiscard]] std::int64_t row_bytes() const { return width * static_cast<std::int64_t>(size_of(type)); }
    [[nodiscard]] std::int64_t bytes() const { return height * row_bytes(); }
    [[nodiscard]] bool same_shape(const TiffPage& other) const {
        return width == other.width && height == other.height && type == other.type;
    }
};

/// Tags of the first page that describe the whole file.
struct TiffTags {
    std::string description;                    ///< ImageDescription: free text, ImageJ or OME
    double x_resolution = 0, y_resolution = 0;  ///< pixels per unit; 0: not given
    int resolution_unit = 2;                    ///< 1: none, 2: inch, 3: centimetre
    int photometric = 1;                        ///< 0: white is zero, 1: black is zero, 3: palette
};

/// Reads all directories and checks every page before anything is allocated for samples: every strip or tile must be able to hold its
/// pixels, given its compression. Throws Error: input (not a TIFF, corrupt, truncated, pages of different size or type), unsupported
/// (colour, bit depths other than 8, 16, 32, 64, compressions that this libtiff lacks).
/// Messages of libtiff become part of the error; nothing is printed. Not thread safe.
class TiffFile {
public:
    /// skip_rest: strips and tiles may decode to more bytes than the page has.
    explicit TiffFile(const std::string& path, bool skip_rest = false);
    ~TiffFile();
    TiffFile(TiffFile&&) noexcept;
    TiffFile& operator=(TiffFile&&) noexcept;

    [[nodiscard]] const std::string& path() const;
    /// At least one. Previews (reduced images, masks) are not listed.
    [[nodiscard]] const std::vector<TiffPage>& pages() const;
    [[nodiscard]] std::int64_t previews() const;  ///< number of ignored pages
    [[nodiscard]] const TiffTags& tags() const;
    [[nodiscard]] bool big_endian() const;
    [[nodiscard]] bool is_big_tiff() const;
    [[nodiscard]] std::int64_t bytes() const;  ///< size of the file
    /// Name of the compression of the first page; "raw" for none.
    [[nodiscard]] std::string encoding() const;
    /// Offset of the first sample when the first page is uncompressed and in one piece, else -1.
    [[nodiscard]] std::int64_t contiguous_offset();
    /// Decodes a page, host byte order. out.size() == pages()[page].bytes(). Throws Error{input} naming the page: also when the checksum of
    /// a deflate stream is wrong, or when a strip or tile of deflate, LZW or PackBits does not decode to exactly its pixels.
    void read(std::int64_t page, std::span<std::byte> out);
    /// The bytes of the file themselves.
    void read_raw(std::int64_t offset, std::span<std::byte> out);

private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
};

}  // namespace isoatlas

// What TiffFile keeps of an open file.
#pragma once

#include <tiffio.h>

#include <optional>
#include <string>
#include <vector>

#include "formats/common/file_access.h"
#include "formats/volume/tiff_client.h"
#include "formats/volume/tiff_directory.h"
#include "formats/volume/tiff_file.h"

namespace isoatlas {

inline constexpr const char* kMoreThanPixels =
    "the file is damaged, or its program writes more than the pixels: then let the rest be skipped";

struct TiffFile::Handle {
    TiffClient client;
    TIFF* tiff = nullptr;
    std::vector<TiffPage> chain;
    std::optional<TiffTags> tags;
    std::string where;          ///< of the directory that is loaded: "page 3"
    std::uint64_t current = 0;  ///< its offset; 0: none
    std::vector<std::byte> pixels, plane, packed;
    bool skip_rest;  ///< a strip or tile may decode to more than its pixels

    Handle(const std::string& path, bool may_skip_rest);
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle();

    // tiff_file.cpp
    void list_pages();
    void list_page();
    void load(std::uint64_t directory, const std::string& name);
    void prepare();
    void read_tags();
    [[nodiscard]] std::vector<std::uint64_t> reduced_images() const;

    // tiff_page.cpp
    [[nodiscard]] std::vector<TiffEntry> directory_entries() const;
    void check_entries(const std::vector<TiffEntry>& entries) const;
    [[nodiscard]] TiffPage describe_page() const;
    void require_one_slice() const;
    [[nodiscard]] PixelKind pixel_kind(int compression) const;
    [[nodiscard]] ValueType sample_type() const;
    void check_page(const TiffPage& page) const;
    void check_pieces(const TiffPage& page) const;
    /// Does a strip or tile end beyond the file? Of a page itself, decoding it tells.
    [[nodiscard]] bool is_cut_off() const;

    // tiff_pieces.cpp
    void decode(const TiffPage& page, std::uint32_t number, std::span<std::byte> out);
    [[nodiscard]] bool ends_with_checksum_of(std::uint32_t number, std::span<const std::byte> decoded);
    void check_piece(std::uint32_t number, std::span<const std::byte> decoded, const std::string& name);
    [[nodiscard]] std::int64_t decoded_bytes(std::uint32_t number, std::int64_t wanted);

    template <class T>
    [[nodiscard]] T tag(std::uint32_t number, T missing) const {
        T value = missing;
        return TIFFGetFieldDefaulted(tiff, number, &value) == 1 ? value : missing;
    }
    [[noreturn]] void corrupt(const std::string& place, const std::string& what) const;
    [[noreturn]] void unsupported(const std::string& what, const std::string& expected, const std::string& next) const;
};

/// Samples that follow each other in a strip or tile.
[[nodiscard]] inline int interleaved(const TiffPage& page) { return page.is_planar ? 1 : page.pixel.samples; }
/// Strips or tiles beside each other, and in a column.
[[nodiscard]] inline std::int64_t pieces_across(const TiffPage& page) { return (page.width - 1) / page.piece_width + 1; }
[[nodiscard]] inline std::int64_t pieces_down(const TiffPage& page) { return (page.height - 1) / page.piece_height + 1; }
/// Rows in a strip or tile of that row of them.
[[nodiscard]] inline std::int64_t rows_of_piece(const TiffPage& page, std::int64_t row, bool is_tiled) {
    return is_tiled ? page.piece_height : std::min(page.piece_height, page.height - row * page.piece_height);
}

}  // namespace isoatlas

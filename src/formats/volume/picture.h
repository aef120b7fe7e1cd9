// Pictures (PNG, JPEG, BMP) as slices: one file is one slice. Only png_picture.cpp and jpeg_picture.cpp use libpng and libjpeg.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/volume/formats.h"
#include "formats/volume/pixel_choice.h"
#include "isoatlas/volume.h"

namespace isoatlas {

enum class PictureKind : std::uint8_t { png, jpeg, bmp };
[[nodiscard]] const char* name_of(PictureKind kind);

/// What the header of a file says.
struct Picture {
    PictureKind kind = PictureKind::png;
    std::int64_t width = 0, height = 0;
    ValueType type = ValueType::u8;  ///< or u16
    PixelKind pixel;
    std::array<double, 2> spacing{0, 0};  ///< along x and y in mm; 0: not given in a unit of length
    std::int64_t file_bytes = 0;
    std::vector<std::string> notes;

    [[nodiscard]] bool same_shape(const Picture& other) const {
        return kind == other.kind && width == other.width && height == other.height && type == other.type && pixel == other.pixel;
    }
    [[nodiscard]] std::size_t row_bytes() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(pixel.samples) * size_of(type);
    }
    [[nodiscard]] std::string shape() const;  ///< "a PNG picture of 5 x 4 uint16"
};

/// take(y, pixels): a row of interleaved samples in host byte order, y from 0 at the top.
using TakeRow = std::function<void(std::int64_t, std::span<const std::byte>)>;

/// A file whose header was read and checked: its size can hold the pixels.
class PictureFile {
public:
    virtual ~PictureFile() = default;
    [[nodiscard]] const Picture& picture() const { return picture_; }
    /// Every row once, in any order; at most one call. Throws Error{input} when the file is damaged or ends early. Memory: a row; of
    /// interlaced and progressive files the picture.
    virtual void read(const TakeRow& take) = 0;

protected:
    Picture picture_;
};

/// The kind of picture that begins with these bytes.
[[nodiscard]] std::optional<PictureKind> picture_kind(FirstBytes first);

/// Reads the header. Allocates nothing in proportion to what it claims. Throws Error: input (not such a file, damaged, the sizes do not
/// fit the file), unsupported (a kind of pixels that is not read).
[[nodiscard]] std::unique_ptr<PictureFile> open_png_picture(const std::string& path);
[[nodiscard]] std::unique_ptr<PictureFile> open_jpeg_picture(const std::string& path);
[[nodiscard]] std::unique_ptr<PictureFile> open_bmp_picture(const std::string& path);

/// The pictures among the files of a folder, which are in their order, as slices; null: there are none. others: entries that are no files.
/// A file is a picture by its content; one that has the name of a picture must be one. Throws Error as open_volume().
[[nodiscard]] std::unique_ptr<VolumeReader> open_picture_folder(const std::string& path, const std::vector<std::string>& files,
                                                                std::int64_t others, const OpenOptions& options);

/// The colours that the indices of a picture stand for.
class ColourTable {
public:
    void add(int red, int green, int blue);
    [[nodiscard]] std::size_t size() const { return colours_.size(); }
    /// red = green = blue for all: the pixels are grey levels.
    [[nodiscard]] bool is_grey() const;
    /// Grey levels, or red, green, blue and the index of each.
    [[nodiscard]] PixelKind pixel_kind() const;
    /// One index a byte to pixel_kind(); false: an index has no colour.
    [[nodiscard]] bool look_up(std::span<const std::byte> indices, std::span<std::byte> out) const;

private:
    std::vector<std::array<std::uint8_t, 3>> colours_;
};

}  // namespace isoatlas

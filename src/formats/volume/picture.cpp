// Pictures as volumes: a folder of them is a volume, a single file an image of rank 2.
#include "formats/volume/picture.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "base/check.h"
#include "formats/common/byte_source.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/volume/chunk_reader.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/slice_misfit.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kSignatureBytes = 32;

bool has_name_of_pictures(const std::string& path) {
    constexpr std::array<std::string_view, 5> kNames{".png", ".jpg", ".jpeg", ".bmp", ".dib"};
    return std::ranges::any_of(kNames, [&](std::string_view end) { return ends_with_ignoring_case(path, end); });
}

/// Links that are not followed are not looked at either, unless their names say that they are slices.
bool is_slice(const std::string& path, bool follow_links) {
    if (has_name_of_pictures(path)) return true;
    std::error_code ignored;
    if (!follow_links && std::filesystem::is_symlink(path, ignored)) return false;
    return picture_kind(read_header_bytes(path, kSignatureBytes)).has_value();
}

std::unique_ptr<PictureFile> open_picture_file(const std::string& path) {
    const std::vector<std::byte> first = read_header_bytes(path, kSignatureBytes);
    const std::optional<PictureKind> kind = picture_kind(first);
    if (!kind) {
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "first bytes",
                                       .what = first.empty() ? "the file is empty" : "the file does not begin like a picture",
                                       .expected = "PNG, JPEG or BMP",
                                       .next = "the file is damaged or misnamed: get it again"});
    }
    switch (*kind) {
        case PictureKind::png: return open_png_picture(path);
        case PictureKind::jpeg: return open_jpeg_picture(path);
        case PictureKind::bmp: break;
    }
    return open_bmp_picture(path);
}

/// One file is open at a time.
class PictureSlices {
public:
    PictureSlices(std::vector<std::string> files, Picture first, PixelChoice choice)
        : files_(std::move(files)), first_(std::move(first)), choice_(choice) {}

    void read(std::int64_t z, std::span<std::byte> out) const {
        const std::string& path = files_[static_cast<std::size_t>(z)];
        const std::unique_ptr<PictureFile> file = open_picture_file(path);
        if (!file->picture().same_shape(first_)) {
            throw Error(ErrorKind::input,
                        {.file = path, .what = "the file has changed since the volume was opened", .next = "open the volume again"});
        }
        const std::size_t row = static_cast<std::size_t>(first_.width) * size_of(first_.type);
        ISOATLAS_CHECK(out.size() == static_cast<std::size_t>(first_.height) * row);
        file->read([&](std::int64_t y, std::span<const std::byte> pixels) {
            take_values(pixels, first_.pixel.samples, first_.type, choice_, out.subspan(static_cast<std::size_t>(y) * row, row));
        });
    }

private:
    std::vector<std::string> files_;
    Picture first_;
    PixelChoice choice_;
};

void add_notes(const Picture& picture, std::vector<std::string>& notes) {
    for (const std::string& note : picture.notes) {
        if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    }
}

/// first: of the first file.
std::unique_ptr<VolumeReader> picture_reader(VolumeInfo info, std::vector<std::string> files, const Picture& first,
                                             const OpenOptions& options) {
    const std::int64_t slices = std::ssize(files);
    info.encoding = first.kind == PictureKind::png ? "deflate" : first.kind == PictureKind::jpeg ? "DCT" : "raw";
    info.type = first.type;
    info.big_endian = first.type == ValueType::u16;
    info.extent = {.rank = slices == 1 ? 2 : 3, .size = {first.width, first.height, slices}};
    static_cast<void>(sample_bytes(info.path, info.extent, info.type));
    info.chunk = {first.width, first.height, 1};
    if (first.spacing[0] > 0 && first.spacing[1] > 0) {
        info.geometry.spacing = {first.spacing[0], first.spacing[1], first.spacing[0]};
        info.geometry.unit = "mm";
        if (slices > 1 && !options.spacing) info.notes.emplace_back("the files have no slice spacing: the pixel width was assumed");
    }
    const PixelChoice choice = choose_pixels(info.path, options, {""}, first.pixel, info).pixel;
    const auto reader = std::make_shared<PictureSlices>(std::move(files), first, choice);
    return make_chunk_reader(std::move(info), [reader](const Index3& chunk, std::span<std::byte> out) { reader->read(chunk[2], out); });
}

}  // namespace

const char* name_of(PictureKind kind) {
    switch (kind) {
        case PictureKind::png: return "PNG";
        case PictureKind::jpeg: return "JPEG";
        case PictureKind::bmp: break;
    }
    return "BMP";
}

std::string Picture::shape() const {
    const std::string several = pixel.samples > 1 ? ", " + std::to_string(pixel.samples) + " values per pixel" : "";
    return std::string("a ") + name_of(kind) + " picture of " + std::to_string(width) + " x " + std::to_string(height) + " " +
           isoatlas::name_of(type) + several;
}

void ColourTable::add(int red, int green, int blue) {
    colours_.push_back({static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue)});
}

bool ColourTable::is_grey() const {
    return std::ranges::all_of(colours_, [](const auto& colour) { return colour[0] == colour[1] && colour[1] == colour[2]; });
}

PixelKind ColourTable::pixel_kind() const {
    if (is_grey()) return {};
    return {.samples = 4, .is_rgb = true, .has_index = true};
}

bool ColourTable::look_up(std::span<const std::byte> indices, std::span<std::byte> out) const {
    const std::size_t samples = is_grey() ? 1 : 4;
    ISOATLAS_CHECK(out.size() == samples * indices.size());
    std::byte* to = out.data();
    for (const std::byte index : indices) {
        const auto number = std::to_integer<std::size_t>(index);
        if (number >= colours_.size()) return false;
        const std::array<std::uint8_t, 3>& colour = colours_[number];
        for (std::size_t i = 0; i < std::min<std::size_t>(samples, 3); ++i) *to++ = std::byte{colour[i]};
        if (samples > 1) *to++ = index;
    }
    return true;
}

bool looks_like_png(FirstBytes first, const std::string&) {
    constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    return first.size() >= kSignature.size() && std::memcmp(first.data(), kSignature.data(), kSignature.size()) == 0;
}

bool looks_like_jpeg(FirstBytes first, const std::string&) {
    const auto byte = [&](std::size_t i) { return std::to_integer<int>(first[i]); };
    return first.size() >= 4 && byte(0) == 0xFF && byte(1) == 0xD8 && byte(2) == 0xFF && byte(3) >= 0xC0 && byte(3) != 0xFF;
}

std::optional<PictureKind> picture_kind(FirstBytes first) {
    if (looks_like_png(first, "")) return PictureKind::png;
    if (looks_like_jpeg(first, "")) return PictureKind::jpeg;
    if (looks_like_bmp(first, "")) return PictureKind::bmp;
    return std::nullopt;
}

std::unique_ptr<VolumeReader> open_picture(const std::string& path, const OpenOptions& options) {
    const Picture picture = open_picture_file(path)->picture();
    VolumeInfo info;
    info.path = path;
    info.format = name_of(picture.kind);
    info.file_bytes = picture.file_bytes;
    info.notes.emplace_back("a single slice: read as a 2D image; of several, their folder is the volume");
    add_notes(picture, info.notes);
    return picture_reader(std::move(info), {path}, picture, options);
}

std::unique_ptr<VolumeReader> open_picture_folder(const std::string& path, const std::vector<std::string>& files, std::int64_t others,
                                                  const OpenOptions& options) {
    VolumeInfo info;
    std::vector<std::string> slices;
    Picture first;
    for (const std::string& name : files) {
        if (!is_slice(name, options.follow_links)) {
            ++others;
            continue;
        }
        if (!options.follow_links) require_inside(path, name);
        const Picture picture = open_picture_file(name)->picture();
        if (slices.empty()) first = picture;
        if (!picture.same_shape(first)) refuse_slice(name, picture.shape(), first.shape(), slices[0]);
        add_notes(picture, info.notes);
        info.file_bytes += picture.file_bytes;
        slices.push_back(name);
    }
    if (slices.empty()) return nullptr;
    info.path = path;
    info.format = std::string(name_of(first.kind)) + " slices";
    info.data_file = slices[0];
    if (slices.size() == 1) info.notes.emplace_back("the folder holds a single slice: read as a 2D image");
    if (others > 0) info.notes.push_back(std::to_string(others) + " other entries of the folder were ignored");
    return picture_reader(std::move(info), std::move(slices), first, options);
}

}  // namespace isoatlas

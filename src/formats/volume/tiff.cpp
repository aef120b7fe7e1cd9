// Multi-page TIFF: pages are slices along z; one page is an image of rank 2.
#include <cmath>

#include "base/check.h"
#include "formats/volume/formats.h"
#include "formats/volume/sample_reader.h"
#include "formats/volume/tiff_stack.h"

namespace isoatlas {

namespace {

constexpr double kMillimetresPerInch = 25.4;

/// Which pages of a file are the slices: first, first + stride, ...
struct PageChoice {
    std::int64_t first = 0, stride = 1, count = 1;
    bool is_image = false;  ///< one page of a series: rank 2
};

class TiffReader final : public VolumeReader {
public:
    TiffReader(VolumeInfo info, TiffFile file, const PageChoice& choice, std::int64_t contiguous)
        : file_(std::move(file)), choice_(choice), contiguous_(contiguous), page_bytes_(file_.pages()[0].bytes()) {
        info_ = std::move(info);
        tidy_texts(info_);
    }

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        ISOATLAS_CHECK(0 <= z_begin && z_begin <= z_end && z_end <= choice_.count);
        ISOATLAS_CHECK(static_cast<std::int64_t>(out.size()) == (z_end - z_begin) * page_bytes_);
        for (std::int64_t z = z_begin; z < z_end; ++z) {
            const auto begin = static_cast<std::size_t>((z - z_begin) * page_bytes_);
            read_page(choice_.first + z * choice_.stride, out.subspan(begin, static_cast<std::size_t>(page_bytes_)));
        }
    }

private:
    void read_page(std::int64_t page, std::span<std::byte> out) {
        if (contiguous_ < 0) return file_.read(page, out);
        file_.read_raw(contiguous_ + page * page_bytes_, out);
        if (needs_swap(info_.big_endian)) swap_bytes(out, size_of(info_.type));
    }

    TiffFile file_;
    PageChoice choice_;
    std::int64_t contiguous_;  ///< offset of page 0 when the pages are contiguous after a single directory, else -1
    std::int64_t page_bytes_;
};

/// ImageJ writes stacks above 4 GB as one directory followed by all pages. Their number, or 0 for an ordinary file.
std::int64_t pages_behind(TiffFile& file, const TiffDescription& description) {
    if (description.kind != TiffDescription::Kind::imagej || description.images < 2 || file.pages().size() != 1) return 0;
    const std::int64_t offset = file.contiguous_offset();
    if (offset < 0 || description.images > (file.bytes() - offset) / file.pages()[0].bytes()) return 0;
    return description.images;
}

PageChoice choose_pages(const std::string& path, const TiffDescription& description, std::int64_t pages, const OpenOptions& options,
                        std::vector<std::string>& notes) {
    if (description.channels > 1) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .what = "holds " + std::to_string(description.channels) + " channels",
                                             .expected = "one value per voxel",
                                             .next = "save one channel as a file, e.g. in Fiji: Image > Color > Split Channels"});
    }
    const std::int64_t slices = description.slices, frames = description.frames;
    const bool is_series = frames > 1 && frames <= pages && slices == pages / frames && pages % frames == 0;
    if (frames > 1 && !is_series) {
        notes.push_back("the description has " + std::to_string(slices) + " slices and " + std::to_string(frames) +
                        " time steps, the file has " + std::to_string(pages) + " pages: all pages are read as slices");
    }
    if (is_series && slices == 1 && !options.time_step) {
        notes.push_back("the " + std::to_string(frames) +
                        " time steps of one slice are read as the third axis (a time step chooses one of them)");
        return {.count = pages};
    }
    const TimeStep step = choose_time_step(path, options, is_series ? frames : 1);
    if (!is_series) return {.count = pages};
    if (description.frames_are_fastest) return {.first = step.index, .stride = frames, .count = slices, .is_image = slices == 1};
    return {.first = step.index * slices, .stride = 1, .count = slices, .is_image = slices == 1};
}

double usable_resolution(double resolution) { return std::isfinite(resolution) && resolution > 0 ? resolution : 0; }

}  // namespace

Geometry tiff_geometry(const TiffTags& tags, const TiffDescription& description, std::int64_t slices, std::vector<std::string>& notes) {
    Geometry geometry;
    const double x = usable_resolution(tags.x_resolution), y = usable_resolution(tags.y_resolution);
    Vec3 spacing = description.spacing;
    geometry.unit = description.unit;
    if (spacing[0] <= 0 && x > 0 && y > 0) {
        const bool has_unit = tags.resolution_unit == 2 || tags.resolution_unit == 3;
        if (description.kind == TiffDescription::Kind::imagej) {
            spacing = {1 / x, 1 / y, spacing[2]};
        } else if (has_unit) {
            const double length = tags.resolution_unit == 2 ? kMillimetresPerInch : 10.0;
            spacing = {length / x, length / y, spacing[2]};
            geometry.unit = "mm";
        } else {
            spacing = {1, x / y, spacing[2]};  // without a unit only the ratio is meaningful
        }
    }
    if (spacing[0] <= 0) spacing[0] = 1;
    if (spacing[1] <= 0) spacing[1] = spacing[0];
    if (spacing[2] <= 0) {
        spacing[2] = spacing[0];
        if (slices > 1 && spacing[0] != 1) notes.push_back("the file has no slice spacing: the pixel width was assumed");
    }
    const double factor = geometry.unit == "inch" ? kMillimetresPerInch : 1;
    if (geometry.unit == "inch") geometry.unit = "mm";
    for (int axis = 0; axis < 3; ++axis) {
        geometry.spacing[axis] = std::isfinite(spacing[axis] * factor) && spacing[axis] * factor > 0 ? spacing[axis] * factor : 1;
    }
    return geometry;
}

bool looks_like_tiff(FirstBytes first, const std::string&) {
    if (first.size() < 4) return false;
    const auto byte = [&](std::size_t i) { return std::to_integer<int>(first[i]); };
    const bool little = byte(0) == 'I' && byte(1) == 'I' && (byte(2) == 42 || byte(2) == 43) && byte(3) == 0;
    const bool big = byte(0) == 'M' && byte(1) == 'M' && byte(2) == 0 && (byte(3) == 42 || byte(3) == 43);
    return little || big;
}

std::unique_ptr<VolumeReader> open_tiff(const std::string& path, const OpenOptions& options) {
    TiffFile file(path, options.skip_rest);
    const TiffPage page = file.pages()[0];
    const TiffDescription description = parse_tiff_description(file.tags().description);
    const std::int64_t behind = pages_behind(file, description);
    VolumeInfo info;
    info.path = path;
    info.format = file.is_big_tiff() ? "BigTIFF" : "TIFF";
    info.encoding = file.encoding();
    info.type = page.type;
    info.big_endian = file.big_endian();
    const std::int64_t pages = behind > 0 ? behind : static_cast<std::int64_t>(file.pages().size());
    const PageChoice choice = choose_pages(path, description, pages, options, info.notes);
    info.extent = {.rank = pages == 1 || choice.is_image ? 2 : 3, .size = {page.width, page.height, choice.count}};
    (void)sample_bytes(path, info.extent, info.type);
    info.geometry = tiff_geometry(file.tags(), description, choice.count, info.notes);
    info.calibration = description.calibration;
    info.value_unit = description.value_unit;
    info.description = file.tags().description;
    info.slab_readable = true;  // every page can be decoded without the pages before it
    info.file_bytes = file.bytes();
    add_tiff_notes(file, info.notes);
    const std::int64_t contiguous = behind > 0 ? file.contiguous_offset() : -1;
    return std::make_unique<TiffReader>(std::move(info), std::move(file), choice, contiguous);
}

void add_tiff_notes(const TiffFile& file, std::vector<std::string>& notes) {
    if (file.tags().photometric == 0) notes.push_back("the file shows 0 as white; the stored values are used");
    if (file.tags().photometric == 3) notes.push_back("the file has a colour table; the stored values are used");
    if (file.previews() > 0) notes.push_back(std::to_string(file.previews()) + " reduced pages (previews, masks) were ignored");
}

}  // namespace isoatlas

// Multi-page TIFF, with the hyperstacks of ImageJ: pages are slices along z; one page is an image of rank 2.
#include <algorithm>
#include <cmath>

#include "formats/volume/formats.h"
#include "formats/volume/imagej_labels.h"
#include "formats/volume/ome_xml.h"
#include "formats/volume/tiff_stack.h"

namespace isoatlas {

namespace {

constexpr double kMillimetresPerInch = 25.4;

/// ImageJ writes stacks above 4 GB as one directory followed by all pages. Their number, or 0 for an ordinary file.
std::int64_t pages_behind(TiffFile& file, const TiffDescription& description, const TiffPage& page) {
    if (!description.is_imagej || description.images < 2 || file.chain().size() != 1) return 0;
    const std::int64_t offset = file.contiguous_offset(page), bytes = page.bytes() * page.pixel.samples;
    if (offset < 0 || description.images > (file.bytes() - offset) / bytes) return 0;
    return description.images;
}

/// The planes that the description says, or all pages as slices.
TiffPlanes planes_of(const TiffDescription& description, const TiffTags& tags, std::int64_t pages, std::vector<std::string>& notes) {
    const std::int64_t channels = description.channels, slices = description.slices, frames = description.frames;
    TiffPlanes planes{.slices = pages};
    if (channels == 1 && frames == 1) return planes;
    const bool is_possible =
        channels <= pages && frames <= pages / channels && slices == pages / channels / frames && pages == channels * frames * slices;
    if (!is_possible) {
        notes.push_back("the description has " + std::to_string(channels) + " channels, " + std::to_string(slices) + " slices and " +
                        std::to_string(frames) + " time steps, the file has " + std::to_string(pages) +
                        " pages: all pages are read as slices");
        return planes;
    }
    planes = {.slices = slices, .times = frames, .channels = channel_names_of(tags.labels, channels)};
    planes.time_increment = description.frame_interval;
    planes.time_unit = description.time_unit.empty() || description.time_unit == "sec" ? "s" : description.time_unit;
    return planes;
}

/// Also of the pages that are not read.
void require_one_shape(const std::string& path, const std::vector<TiffPage>& pages) {
    for (const TiffPage& page : pages) {
        if (page.same_shape(pages[0])) continue;
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "page " + std::to_string(page.number),
                                       .what = "the page is " + page.shape(),
                                       .expected = pages[0].shape() + " like page " + std::to_string(pages[0].number),
                                       .next = "split the file: all pages of a volume must have one size and type"});
    }
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
        if (description.is_imagej) {
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
    auto file = std::make_unique<TiffFile>(path, options.skip_rest);
    const TiffTags tags = file->tags();
    VolumeInfo info;
    info.path = path;
    info.format = file->is_big_tiff() ? "BigTIFF" : "TIFF";
    info.description = tags.description;
    info.file_bytes = file->bytes();
    add_tiff_notes(*file, info.notes);
    if (looks_like_ome(tags.description)) return open_ome_tiff(std::move(info), std::move(file), options);
    const std::vector<TiffPage> pages = file->pages();
    const TiffDescription description = parse_tiff_description(tags.description);
    const std::int64_t behind = pages_behind(*file, description, pages[0]);
    const std::int64_t count = behind > 0 ? behind : std::ssize(pages);
    const TiffPlanes planes = planes_of(description, tags, count, info.notes);
    const TiffChoice choice = choose_planes(path, options, planes, pages[0], info);
    info.calibration = description.calibration;
    info.value_unit = description.value_unit;
    TiffVolume volume{.files = {path}, .slices = {}, .pixel = choice.channel.pixel, .skip_rest = options.skip_rest};
    const std::int64_t contiguous = behind > 0 ? file->contiguous_offset(pages[0]) : -1, channels = std::ssize(planes.channels);
    for (std::int64_t i = 0; i < info.extent.size[2]; ++i) {
        const std::int64_t time = choice.is_along_time ? i : choice.time, slice = choice.is_along_time ? 0 : i;
        const std::int64_t number = choice.channel.plane + channels * (slice + planes.slices * time);
        const TiffPage& page = pages[static_cast<std::size_t>(behind > 0 ? 0 : number)];
        volume.slices.push_back({.directory = page.directory, .number = page.number});
        if (behind > 0) volume.slices.back().raw = contiguous + number * page.bytes() * page.pixel.samples;
    }
    const TiffPage& first = pages[static_cast<std::size_t>(behind > 0 ? 0 : choice.channel.plane + channels * planes.slices * choice.time)];
    if (behind == 0) require_one_shape(path, pages);
    info.geometry = tiff_geometry(tags, description, info.extent.size[2], info.notes);
    return make_tiff_reader(std::move(info), std::move(volume), std::move(file), first, options);
}

void add_tiff_notes(TiffFile& file, std::vector<std::string>& notes) {
    if (file.tags().photometric == 0) notes.push_back("the file shows 0 as white; the stored values are used");
    if (file.tags().photometric == 3) notes.push_back("the file has a colour table; the stored values are used");
    const auto previews = std::ranges::count_if(file.chain(), [](const TiffPage& page) { return page.is_preview && page.number > 0; });
    if (previews > 0) notes.push_back(std::to_string(previews) + " reduced pages (previews, masks) were ignored");
}

}  // namespace isoatlas

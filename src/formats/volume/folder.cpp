// A folder of TIFF files: all pages of all files, in the natural order of the names (slice2 before slice10), are one volume.
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "formats/common/natural_order.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/volume/formats.h"
#include "formats/volume/tiff_stack.h"

namespace isoatlas {

namespace {

namespace fs = std::filesystem;

struct Listing {
    std::vector<std::string> slices;  ///< TIFF files in natural order
    std::string other_image;          ///< the first one
    std::int64_t others = 0;          ///< files that are not TIFF
};

bool has_extension(const std::string& name, std::initializer_list<const char*> extensions) {
    return std::any_of(extensions.begin(), extensions.end(), [&](const char* end) { return ends_with_ignoring_case(name, end); });
}

Listing list_folder(const std::string& path) {
    Listing listing;
    std::error_code error;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with('.')) continue;
        std::error_code ignored;
        if (!entry->is_regular_file(ignored)) {
            ++listing.others;
        } else if (has_extension(name, {".tif", ".tiff"})) {
            listing.slices.push_back(entry->path().string());
        } else {
            ++listing.others;
            if (has_extension(name, {".png", ".jpg", ".jpeg", ".bmp"}) && listing.other_image.empty()) listing.other_image = name;
        }
    }
    if (error) {
        throw Error(
            ErrorKind::input,
            {.file = path, .what = "the folder cannot be listed: " + error.message(), .next = "check the path and its permissions"});
    }
    std::sort(listing.slices.begin(), listing.slices.end(), natural_less);
    return listing;
}

[[noreturn]] void no_slices(const std::string& path, const Listing& listing) {
    if (!listing.other_image.empty()) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .where = listing.other_image,
                                             .what = "is a folder of images that are not TIFF",
                                             .expected = "TIFF files",
                                             .next = "convert them, e.g. with `mogrify -format tif *.png`"});
    }
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the folder has no slices",
                                   .expected = "files named *.tif or *.tiff, or DICOM files",
                                   .next = "name the folder that holds the slices, or a volume file"});
}

[[noreturn]] void misfit(const std::string& path, const std::string& is, const std::string& wanted, const std::string& first_file) {
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the slice is " + is,
                                   .expected = wanted + " like " + fs::path(first_file).filename().string(),
                                   .next = "all slices of a folder must have one size and type: move other images elsewhere"});
}

/// Checks that the pages of a file match the first one and adds them to the volume.
void add_file(TiffFile& file, const TiffPage& first, TiffVolume& volume, VolumeInfo& info) {
    for (const TiffPage& page : file.pages()) {
        if (!page.same_shape(first)) misfit(file.path(), page.shape(), first.shape(), volume.files[0]);
        volume.slices.push_back(
            {.file = static_cast<std::uint32_t>(volume.files.size() - 1), .directory = page.directory, .number = page.number});
    }
    info.file_bytes += file.bytes();
}

void describe_first(TiffFile& file, VolumeInfo& info) {
    info.data_file = file.path();
    info.description = file.tags().description;
    const TiffDescription description = parse_tiff_description(info.description);
    info.geometry = tiff_geometry(file.tags(), description, 2, info.notes);
    info.calibration = description.calibration;
    info.value_unit = description.value_unit;
    add_tiff_notes(file, info.notes);
}

}  // namespace

std::unique_ptr<VolumeReader> open_folder(const std::string& path, const OpenOptions& options) {
    const Listing listing = list_folder(path);
    if (listing.slices.empty()) {
        std::unique_ptr<VolumeReader> dicom = open_dicom_folder(path, options);
        if (dicom) return dicom;
        no_slices(path, listing);
    }
    VolumeInfo info;
    info.path = path;
    info.format = "TIFF slices";
    TiffVolume volume{.files = {}, .slices = {}, .pixel = {}, .skip_rest = options.skip_rest};
    TiffPage first;
    for (const std::string& name : listing.slices) {
        if (!options.follow_links) require_inside(path, name);
        TiffFile file(name, options.skip_rest);
        volume.files.push_back(name);
        if (volume.slices.empty()) {
            describe_first(file, info);
            first = file.pages()[0];
        }
        add_file(file, first, volume, info);
    }
    const TiffPlanes planes{.slices = std::ssize(volume.slices)};
    volume.pixel = choose_planes(path, options, planes, first, info).channel.pixel;
    if (planes.slices == 1) info.notes.emplace_back("the folder holds a single slice: read as a 2D image");
    if (listing.others > 0) info.notes.push_back(std::to_string(listing.others) + " other entries of the folder were ignored");
    auto file = std::make_unique<TiffFile>(listing.slices[0], options.skip_rest);
    return make_tiff_reader(std::move(info), std::move(volume), std::move(file), first, options);
}

}  // namespace isoatlas

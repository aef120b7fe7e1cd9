// A folder of slices: all pages of all TIFF files, or DICOM, or pictures, in the natural order of the names (slice2 before slice10).
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "formats/common/natural_order.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/volume/formats.h"
#include "formats/volume/picture.h"
#include "formats/volume/slice_misfit.h"
#include "formats/volume/tiff_stack.h"

namespace isoatlas {

namespace {

namespace fs = std::filesystem;

struct Listing {
    std::vector<std::string> slices;  ///< TIFF files in natural order
    std::vector<std::string> files;   ///< the other files, in natural order
    std::int64_t others = 0;          ///< entries that are no files
};

Listing list_folder(const std::string& path) {
    Listing listing;
    std::error_code error;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with('.')) continue;
        std::error_code ignored;
        if (!entry->is_regular_file(ignored))
            ++listing.others;
        else if (ends_with_ignoring_case(name, ".tif") || ends_with_ignoring_case(name, ".tiff"))
            listing.slices.push_back(entry->path().string());
        else
            listing.files.push_back(entry->path().string());
    }
    if (error) {
        throw Error(
            ErrorKind::input,
            {.file = path, .what = "the folder cannot be listed: " + error.message(), .next = "check the path and its permissions"});
    }
    std::sort(listing.slices.begin(), listing.slices.end(), natural_less);
    std::sort(listing.files.begin(), listing.files.end(), natural_less);
    return listing;
}

/// DICOM files here and below come before pictures, which may be previews of them.
std::unique_ptr<VolumeReader> open_other_slices(const std::string& path, const Listing& listing, const OpenOptions& options) {
    std::unique_ptr<VolumeReader> dicom = open_dicom_folder(path, options);
    if (dicom) return dicom;
    std::unique_ptr<VolumeReader> pictures = open_picture_folder(path, listing.files, listing.others, options);
    if (pictures) return pictures;
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the folder has no slices",
                                   .expected = "TIFF files named *.tif or *.tiff, or files of DICOM, PNG, JPEG or BMP",
                                   .next = "name the folder that holds the slices, or a volume file"});
}

/// Checks that the pages of a file match the first one and adds them to the volume.
void add_file(TiffFile& file, const TiffPage& first, TiffVolume& volume, VolumeInfo& info) {
    for (const TiffPage& page : file.pages()) {
        if (!page.same_shape(first)) refuse_slice(file.path(), page.shape(), first.shape(), volume.files[0]);
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
    if (listing.slices.empty()) return open_other_slices(path, listing, options);
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
    const std::int64_t others = listing.others + std::ssize(listing.files);
    if (others > 0) info.notes.push_back(std::to_string(others) + " other entries of the folder were ignored");
    auto file = std::make_unique<TiffFile>(listing.slices[0], options.skip_rest);
    return make_tiff_reader(std::move(info), std::move(volume), std::move(file), first, options);
}

}  // namespace isoatlas

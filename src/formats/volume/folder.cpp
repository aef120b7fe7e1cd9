// A folder of TIFF files: all pages of all files, in the natural order of the names (slice2 before slice10), are one volume.
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/check.h"
#include "formats/common/byte_source.h"
#include "formats/common/natural_order.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/volume/formats.h"
#include "formats/volume/sample_reader.h"
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

class FolderReader final : public VolumeReader {
public:
    FolderReader(VolumeInfo info, std::vector<std::string> files, std::vector<std::int64_t> first_page, bool skip_rest)
        : files_(std::move(files)), first_page_(std::move(first_page)), skip_rest_(skip_rest) {
        info_ = std::move(info);
        tidy_texts(info_);
        page_bytes_ = info_.extent.slice() * static_cast<std::int64_t>(size_of(info_.type));
    }

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        ISOATLAS_CHECK(0 <= z_begin && z_begin <= z_end && z_end <= info_.extent.size[2]);
        ISOATLAS_CHECK(static_cast<std::int64_t>(out.size()) == (z_end - z_begin) * page_bytes_);
        for (std::int64_t z = z_begin; z < z_end; ++z) {
            const auto begin = static_cast<std::size_t>((z - z_begin) * page_bytes_);
            read_page(z, out.subspan(begin, static_cast<std::size_t>(page_bytes_)));
        }
    }

private:
    void read_page(std::int64_t z, std::span<std::byte> out) {
        const auto file = static_cast<std::size_t>(std::upper_bound(first_page_.begin(), first_page_.end(), z) - first_page_.begin()) - 1;
        if (!open_ || open_index_ != file) {
            open_ = std::make_unique<TiffFile>(files_[file], skip_rest_);
            open_index_ = file;
        }
        const std::int64_t page = z - first_page_[file];
        const std::vector<TiffPage>& pages = open_->pages();
        if (page >= static_cast<std::int64_t>(pages.size()) || pages[0].bytes() != page_bytes_ || pages[0].width != info_.extent.size[0]) {
            throw Error(
                ErrorKind::input,
                {.file = files_[file], .what = "the file has changed since the volume was opened", .next = "open the folder again"});
        }
        open_->read(page, out);
    }

    std::vector<std::string> files_;
    std::vector<std::int64_t> first_page_;  ///< of each file
    std::unique_ptr<TiffFile> open_;        ///< one file at a time, because of the limit of open files
    std::size_t open_index_ = 0;
    bool skip_rest_;
    std::int64_t page_bytes_ = 0;
};

/// Checks that a file matches the first one and adds it to the volume.
void add_file(const TiffFile& file, const std::string& first_file, VolumeInfo& info) {
    const TiffPage& page = file.pages()[0];
    const auto shape = [](std::int64_t width, std::int64_t height, ValueType type) {
        return std::to_string(width) + " x " + std::to_string(height) + " " + name_of(type);
    };
    const std::string is = shape(page.width, page.height, page.type), wanted = shape(info.extent.size[0], info.extent.size[1], info.type);
    if (is != wanted) {
        throw Error(ErrorKind::input, {.file = file.path(),
                                       .what = "the slice is " + is,
                                       .expected = wanted + " like " + fs::path(first_file).filename().string(),
                                       .next = "all slices of a folder must have one size and type: move other images elsewhere"});
    }
    info.extent.size[2] += static_cast<std::int64_t>(file.pages().size());
    info.file_bytes += file.bytes();
}

void describe_first(const TiffFile& file, VolumeInfo& info) {
    const TiffPage& page = file.pages()[0];
    info.encoding = file.encoding();
    info.data_file = file.path();
    info.type = page.type;
    info.big_endian = file.big_endian();
    info.extent = {.rank = 3, .size = {page.width, page.height, 0}};
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
    (void)choose_time_step(path, options, 1);
    VolumeInfo info;
    info.path = path;
    info.format = "TIFF slices";
    std::vector<std::int64_t> first_page;
    for (const std::string& name : listing.slices) {
        if (!options.follow_links) require_inside(path, name);
        const TiffFile file(name, options.skip_rest);
        if (first_page.empty()) describe_first(file, info);
        first_page.push_back(info.extent.size[2]);
        add_file(file, listing.slices[0], info);
    }
    (void)sample_bytes(path, info.extent, info.type);
    if (info.extent.size[2] == 1) {
        info.extent.rank = 2;
        info.notes.push_back("the folder holds a single slice: read as a 2D image");
    }
    info.slab_readable = true;
    if (listing.others > 0) info.notes.push_back(std::to_string(listing.others) + " other entries of the folder were ignored");
    return std::make_unique<FolderReader>(std::move(info), listing.slices, std::move(first_page), options.skip_rest);
}

}  // namespace isoatlas

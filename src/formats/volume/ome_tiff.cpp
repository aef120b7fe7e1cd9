// OME-TIFF: planes of an image by slice, channel and time, in this file and in files beside it.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "formats/common/file_access.h"
#include "formats/common/text.h"
#include "formats/volume/bad_header.h"
#include "formats/volume/choose.h"
#include "formats/volume/data_files.h"
#include "formats/volume/formats.h"
#include "formats/volume/ome_xml.h"
#include "formats/volume/tiff_stack.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxMissing = 1 << 24;  // planes of files that are not there
constexpr std::int64_t kMaxText = std::int64_t{64} << 20;

std::string file_name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// The pages of the files of a data set, by name; "" is the file that was opened. Each is listed once; one at a time is open.
class OmeFiles {
public:
    OmeFiles(std::string path, std::unique_ptr<TiffFile> own, const OpenOptions& options)
        : path_(std::move(path)), own_(std::move(own)), options_(options) {}

    [[nodiscard]] TiffFile& own() { return *own_; }
    [[nodiscard]] std::unique_ptr<TiffFile> take_own() { return std::move(own_); }
    [[nodiscard]] std::string path_of(const std::string& name) const {
        if (name.empty()) return path_;
        PayloadPlan plan;
        plan.header_path = path_;
        plan.files.names = {name};
        plan.follow_links = options_.follow_links;
        return data_file_path(plan, 0);
    }
    [[nodiscard]] const std::vector<TiffPage>& pages(const std::string& name) {
        if (name.empty()) return own_->chain();
        if (name != name_) {
            other_ = open_one(name)->chain();
            name_ = name;
        }
        return other_;
    }
    /// Throws Error{input} for a file that is missing.
    [[nodiscard]] std::unique_ptr<TiffFile> open_one(const std::string& name) const {
        const std::string path = path_of(name);
        if (!file_exists(path)) {
            throw Error(ErrorKind::input, {.file = path_,
                                           .where = "OME-XML",
                                           .what = "a file of the data set is missing: " + in_quotes(name),
                                           .expected = "all files of the data set in one folder",
                                           .next = "copy it beside this file"});
        }
        return std::make_unique<TiffFile>(path, options_.skip_rest);
    }

private:
    std::string path_;
    std::unique_ptr<TiffFile> own_;
    const OpenOptions& options_;
    std::string name_;
    std::vector<TiffPage> other_;
};

struct PlanePage {
    std::string file;
    std::int64_t page = 0;
};

class OmePlanes {
public:
    OmePlanes(const std::string& path, OmeImage image, OmeFiles& files) : path_(path), image_(std::move(image)), files_(files) {}

    /// The number of planes that the file gives, an upper bound: names and times are not more.
    void check_counts() {
        const std::int64_t planes = image_.planes();
        std::int64_t given = 0, listed = 0;
        std::set<std::string> seen;
        for (const OmePages& pages : image_.pages) {
            if (pages.count == 1) {
                ++given;
                continue;
            }
            if (is_missing(pages)) {
                listed += pages.count;
                if (listed > kMaxMissing) bad_field(path_, "OME-XML, TiffData", "names too many pages of missing files", "their files");
            } else if (seen.insert(pages.file).second) {
                listed += std::ssize(files_.pages(pages.file));
            }
            given += count_of(pages);
            if (given - std::ssize(image_.pages) > listed)
                bad_field(path_, "OME-XML, TiffData", "names more pages than there are", std::to_string(listed) + " pages");
        }
        if (planes > given) {
            bad_field(path_, "OME-XML, Pixels",
                      "the image has " + std::to_string(planes) + " planes, the file gives " + std::to_string(given),
                      "a page for each plane");
        }
    }

    /// Slices, or times, of a channel; times of the first slice.
    [[nodiscard]] std::vector<PlanePage> of(std::int64_t channel, std::int64_t time, bool is_along_time) {
        const std::int64_t count = is_along_time ? image_.times : image_.slices;
        std::vector<std::optional<PlanePage>> found(static_cast<std::size_t>(count));
        for (const OmePages& pages : image_.pages) {
            const std::int64_t first = first_plane(pages), number = count_of(pages);
            for (std::int64_t i = 0; i < number; ++i) {
                const auto [z, c, t] = image_.place(first + i);
                if (c != channel || (!is_along_time && t != time)) continue;
                std::optional<PlanePage>& place = found[static_cast<std::size_t>(is_along_time ? t : z)];
                if (!place) place = PlanePage{pages.file, pages.first + i};
            }
        }
        std::vector<PlanePage> planes;
        for (std::int64_t i = 0; i < count; ++i) {
            if (!found[static_cast<std::size_t>(i)]) {
                bad_field(path_, "OME-XML, TiffData",
                          std::string("no page is given for ") + (is_along_time ? "time step " : "slice ") + std::to_string(i),
                          "a page for each plane");
            }
            planes.push_back(*std::move(found[static_cast<std::size_t>(i)]));
        }
        return planes;
    }

    [[nodiscard]] const OmeImage& image() const { return image_; }
    [[nodiscard]] const TiffPage& page_of(const PlanePage& plane) {
        const std::vector<TiffPage>& pages = files_.pages(plane.file);
        if (plane.page >= std::ssize(pages)) {
            throw Error(ErrorKind::input, {.file = files_.path_of(plane.file),
                                           .where = "page " + std::to_string(plane.page),
                                           .what = "the file has " + std::to_string(pages.size()) + " pages; its OME-XML names this one",
                                           .next = "the file is truncated or its description is wrong: copy or export it again"});
        }
        const TiffPage& page = pages[static_cast<std::size_t>(plane.page)];
        if (page.problem) throw Error(*page.problem);
        return page;
    }

private:
    std::int64_t first_plane(const OmePages& pages) const {
        const std::int64_t channel =
            pages.channel >= image_.plane_channels() && image_.samples > 1 ? pages.channel / image_.samples : pages.channel;
        if (pages.z >= image_.slices || channel >= image_.plane_channels() || pages.time >= image_.times)
            bad_field(path_, "OME-XML, TiffData", "the first plane is not one of the image", "FirstZ, FirstC and FirstT below the sizes");
        return image_.plane({pages.z, channel, pages.time});
    }
    /// A file that is not there matters only when a plane of it is chosen.
    [[nodiscard]] bool is_missing(const OmePages& pages) const {
        return pages.count > 0 && !pages.file.empty() && !file_exists(files_.path_of(pages.file));
    }
    /// Planes of an element; those of a file as far as it has pages.
    std::int64_t count_of(const OmePages& pages) {
        if (pages.count == 1) return 1;
        const std::int64_t left = image_.planes() - first_plane(pages);
        const std::int64_t there = is_missing(pages) ? pages.count : std::ssize(files_.pages(pages.file)) - pages.first;
        if (pages.count == 0) return std::clamp<std::int64_t>(there, 0, left);
        if (pages.count > left)
            bad_field(path_, "OME-XML, TiffData", "names more planes than the image has", std::to_string(left) + " at most");
        if (pages.count > there)
            bad_field(path_, "OME-XML, TiffData", "names " + std::to_string(pages.first + pages.count) + " pages",
                      std::to_string(there + pages.first) + " pages, which the file has");
        return pages.count;
    }

    std::string path_;
    OmeImage image_;
    OmeFiles& files_;
};

/// The description, where that of this file names another file.
OmeXml read_ome(const std::string& path, OmeFiles& files) {
    const std::string name = file_name_of(path);
    OmeXml xml = parse_ome_xml(path, files.own().tags().description, name);
    if (xml.metadata_file.empty()) return xml;
    const std::string other = files.path_of(xml.metadata_file);
    if (!file_exists(other)) static_cast<void>(files.open_one(xml.metadata_file));  // says what is missing
    std::vector<std::byte> first(4);
    const std::unique_ptr<File> file = open_file(other);
    first.resize(read_available(*file, other, 0, first));
    std::string text;
    if (looks_like_tiff(first, other)) {
        text = files.open_one(xml.metadata_file)->tags().description;
    } else {
        if (file->size() > kMaxText) bad_field(other, "OME-XML", "is larger than 64 MiB", "a description of images");
        text.resize(static_cast<std::size_t>(file->size()));
        read_fully(*file, other, 0, std::as_writable_bytes(std::span(text)));
    }
    OmeXml description = parse_ome_xml(other, text, name, xml.uuid);
    if (!description.metadata_file.empty()) bad_field(other, "OME-XML, BinaryOnly", "names another file again", "a description of images");
    return description;
}

OmeImage choose_image(const std::string& path, const OpenOptions& options, std::vector<OmeImage> images, VolumeInfo& info) {
    info.volumes.has_series = images.size() > 1;
    if (images.size() == 1) return std::move(images[0]);
    std::vector<ErrorChoice> choices;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const OmeImage& image = images[i];
        const bool is_unique =
            !image.name.empty() && std::ranges::count_if(images, [&](const OmeImage& other) { return other.name == image.name; }) == 1;
        std::string about = std::to_string(image.width) + " x " + std::to_string(image.height) + " x " + std::to_string(image.slices);
        if (image.channels > 1) about += ", " + std::to_string(image.channels) + " channels";
        if (image.times > 1) about += ", " + std::to_string(image.times) + " time steps";
        choices.push_back({.word = is_unique ? image.name : std::to_string(i), .about = about});
    }
    return std::move(images[choose_series(path, options, choices)]);
}

/// Without a list of pages they follow each other.
void complete_pages(OmeImage& image, OmeFiles& files) {
    if (image.pages.empty()) image.pages.push_back({});
    const OmePages& first = image.pages[0];
    if (image.samples > 1 || image.channels == 1) return;
    const std::vector<TiffPage>& pages = files.pages(first.file);
    const bool is_there = first.first < std::ssize(pages) && !pages[static_cast<std::size_t>(first.first)].problem;
    const std::int64_t samples = is_there ? pages[static_cast<std::size_t>(first.first)].pixel.samples : 1;
    if (samples > 1 && image.channels % samples == 0) image.samples = samples;
}

std::vector<std::string> names_of(const OmeImage& image) {
    std::vector<std::string> names(static_cast<std::size_t>(image.plane_channels()));
    std::copy_n(image.channel_names.begin(), std::min(names.size(), image.channel_names.size()), names.begin());
    return names;
}

void check_size(const std::string& path, const OmeImage& image, const TiffPage& page) {
    const auto differs = [](std::int64_t said, std::int64_t is) { return said > 0 && said != is; };
    if (differs(image.width, page.width) || differs(image.height, page.height))
        bad_field(path, "OME-XML, Pixels", "says " + std::to_string(image.width) + " x " + std::to_string(image.height),
                  page.shape() + ", as its pages are");
}

TiffVolume slices_of(const std::vector<PlanePage>& planes, OmePlanes& set, const OmeFiles& files) {
    TiffVolume volume;
    std::map<std::string, std::uint32_t> numbers;
    for (const PlanePage& plane : planes) {
        const auto [place, is_new] = numbers.try_emplace(plane.file, static_cast<std::uint32_t>(volume.files.size()));
        if (is_new) volume.files.push_back(files.path_of(plane.file));
        const TiffPage& page = set.page_of(plane);
        volume.slices.push_back({.file = place->second, .directory = page.directory, .number = page.number});
    }
    return volume;
}

}  // namespace

std::unique_ptr<VolumeReader> open_ome_tiff(VolumeInfo info, std::unique_ptr<TiffFile> file, const OpenOptions& options) {
    const std::string path = info.path;
    const TiffTags tags = file->tags();
    OmeFiles files(path, std::move(file), options);
    OmeImage image = choose_image(path, options, read_ome(path, files).images, info);
    complete_pages(image, files);
    OmePlanes set(path, std::move(image), files);
    set.check_counts();
    const OmeImage& chosen = set.image();
    const std::vector<PlanePage> first_plane = set.of(0, 0, chosen.slices == 1 && chosen.times > 1 && !options.time_step);
    const TiffPage first = set.page_of(first_plane[0]);
    check_size(path, chosen, first);
    const TiffChoice choice = choose_planes(path, options,
                                            {.slices = chosen.slices,
                                             .times = chosen.times,
                                             .channels = names_of(chosen),
                                             .time_increment = chosen.time_increment,
                                             .time_unit = chosen.time_unit},
                                            first, info);
    const std::vector<PlanePage> planes = set.of(choice.channel.plane, choice.time, choice.is_along_time);
    TiffVolume volume = slices_of(planes, set, files);
    volume.pixel = choice.channel.pixel;
    volume.skip_rest = options.skip_rest;
    info.format = "OME-TIFF";
    info.geometry = tiff_geometry(tags, {.spacing = chosen.spacing, .unit = chosen.unit}, std::ssize(planes), info.notes);
    const TiffPage page = set.page_of(planes[0]);
    if (planes[0].file.empty()) return make_tiff_reader(std::move(info), std::move(volume), files.take_own(), page, options);
    info.data_file = volume.files[0];
    std::unique_ptr<TiffFile> other = files.open_one(planes[0].file);
    return make_tiff_reader(std::move(info), std::move(volume), std::move(other), page, options);
}

}  // namespace isoatlas

// DICOM: a folder of slices, or any file of a series. One file is open at a time; pictures are read slice by slice.
#include "formats/volume/dicom_stack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/check.h"
#include "formats/common/byte_source.h"
#include "formats/common/file_access.h"
#include "formats/common/natural_order.h"
#include "formats/common/own_folder.h"
#include "formats/common/text.h"
#include "formats/volume/choose.h"
#include "formats/volume/dicom_codec.h"
#include "formats/volume/formats.h"
#include "formats/volume/sample_reader.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMaxFiles = 200000;
constexpr int kMaxFolders = 4;  // PATIENT/STUDY/SERIES/FILE

/// What a note says about the values of the group; which calibration they have.
struct DicomScaling {
    bool is_converted = false;  ///< each slice has its own: samples are the reported values
    Calibration calibration;
};

class DicomReader final : public VolumeReader {
public:
    DicomReader(VolumeInfo info, std::vector<DicomFile> files, std::vector<DicomSlice> slices, bool is_converted)
        : files_(std::move(files)), slices_(std::move(slices)), is_converted_(is_converted) {
        info_ = std::move(info);
        tidy_texts(info_);
    }

    void read(std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) override {
        ISOATLAS_CHECK(0 <= z_begin && z_begin <= z_end && z_end <= info_.extent.size[2]);
        const auto bytes = static_cast<std::size_t>(info_.extent.slice()) * size_of(info_.type);
        ISOATLAS_CHECK(out.size() == static_cast<std::size_t>(z_end - z_begin) * bytes);
        for (std::int64_t z = z_begin; z < z_end; ++z)
            read_slice(slices_[static_cast<std::size_t>(z)], out.subspan(static_cast<std::size_t>(z - z_begin) * bytes, bytes));
    }

private:
    void read_slice(const DicomSlice& slice, std::span<std::byte> out) {
        const DicomFile& file = files_[slice.file];
        if (!frames_ || open_ != slice.file) {
            frames_.emplace(file.header, file.pixels);
            open_ = slice.file;
        }
        if (!is_converted_) return frames_->read(slice.frame, out);
        stored_.resize(static_cast<std::size_t>(file.pixels.frame_bytes()));
        frames_->read(slice.frame, stored_);
        visit_type(file.pixels.type, [&]<class T>(T) {
            if (info_.type == ValueType::f32) return convert<T, float>(slice, out);
            convert<T, double>(slice, out);
        });
    }
    template <class T, class To>
    void convert(const DicomSlice& slice, std::span<std::byte> out) const {
        for (std::size_t i = 0; i < stored_.size() / sizeof(T); ++i) {
            T stored{};
            std::memcpy(&stored, stored_.data() + i * sizeof(T), sizeof(T));
            const To value = static_cast<To>(slice.slope * static_cast<double>(stored) + slice.intercept);
            std::memcpy(out.data() + i * sizeof(To), &value, sizeof(To));
        }
    }

    std::vector<DicomFile> files_;
    std::vector<DicomSlice> slices_;
    bool is_converted_;
    std::optional<DicomFrames> frames_;
    std::size_t open_ = 0;
    std::vector<std::byte> stored_;
};

/// Regular files of a folder and those below it, in natural order; names with a dot in front and DICOMDIR are left out.
std::vector<std::string> list_files(const std::string& folder, int depth, bool follow_links) {
    std::vector<std::string> files;
    std::vector<std::pair<std::string, int>> folders{{folder, depth}};
    while (!folders.empty()) {
        const auto [here, left] = folders.back();
        folders.pop_back();
        for (const std::string& name : directory_entries(here, kMaxFiles + 1)) {
            if (name.starts_with('.') || lower(name) == "dicomdir") continue;
            const std::string path = here + (here.ends_with('/') ? "" : "/") + name;
            if (file_exists(path)) {
                files.push_back(path);
            } else if (left > 0 && is_directory(path) && (follow_links || file_system().link(path).empty())) {
                folders.emplace_back(path, left - 1);
            }
            if (files.size() + folders.size() > kMaxFiles) {
                throw Error(ErrorKind::unsupported, {.file = folder,
                                                     .what = "the folder has more than " + std::to_string(kMaxFiles) + " files",
                                                     .expected = "the slices of a few series",
                                                     .next = "name the folder of one series"});
            }
        }
    }
    std::ranges::sort(files, natural_less);
    return files;
}

bool is_dicom_file(const std::string& path) {
    constexpr std::int64_t kFirst = 512;
    return starts_like_dicom(read_header_bytes(path, kFirst));
}

/// Adds a file with a picture. Structured reports, presentation states and the like have none.
bool add_dicom_file(std::vector<DicomFile>& files, DicomHeader header) {
    if (header.pixel_tag == 0) return false;
    const DicomPixels pixels = dicom_pixels(header);
    files.push_back({std::move(header), pixels});
    return true;
}

/// The values of a group: all with one calibration, or converted.
DicomScaling scaling_of(const std::vector<DicomSlice>& slices, VolumeInfo& info, const DicomPixels& pixels) {
    const DicomSlice& first = slices.front();
    const auto is_same = [&](const DicomSlice& slice) { return slice.slope == first.slope && slice.intercept == first.intercept; };
    if (std::ranges::all_of(slices, is_same))
        return {.is_converted = false, .calibration = {.slope = first.slope, .intercept = first.intercept, .mirror = {}}};
    constexpr int kExactInFloat = 16;  // bits
    info.type = pixels.stored <= kExactInFloat && !is_floating(pixels.type) ? ValueType::f32 : ValueType::f64;
    info.notes.push_back(std::string("the slices have different slopes or intercepts: they are read as ") + name_of(info.type) +
                         " in the unit of the values");
    return {.is_converted = true, .calibration = {}};
}

std::string value_unit_of(const DicomHeader& header, bool is_scaled) {
    const std::string modality = header.values.text(kDicomModality), units = header.values.text(kDicomUnits),
                      dose = header.values.text(kDicomDoseUnits);
    const std::string type =
        header.values.text(kDicomRescaleType).empty() ? header.shared.text(kDicomRescaleType) : header.values.text(kDicomRescaleType);
    if (type == "HU" || (modality == "CT" && is_scaled && (type.empty() || type == "US"))) return "HU";
    if (modality == "PT" || modality == "NM") {
        static constexpr std::pair<std::string_view, const char*> kPet[] = {
            {"BQML", "Bq/mL"},       {"CNTS", "counts"},  {"GML", "g/mL"},       {"CPS", "counts/s"},
            {"PROPCPS", "counts/s"}, {"CM2ML", "cm2/mL"}, {"MLMING", "mL/min/g"}};
        const auto found = std::ranges::find(kPet, units, &std::pair<std::string_view, const char*>::first);
        return found == std::end(kPet) ? "" : found->second;
    }
    return dose == "GY" ? "Gy" : "";
}

void note_values(const DicomHeader& header, const DicomPixels& pixels, bool is_converted, VolumeInfo& info) {
    const std::string photometric = header.values.text(kDicomPhotometric);
    if (photometric == "MONOCHROME1")
        info.notes.emplace_back("the file shows low values as white (MONOCHROME1); the stored values are used");
    if (photometric == "PALETTE COLOR") info.notes.emplace_back("the file has a colour table; the stored values are used");
    if (pixels.stored < pixels.allocated && pixels.high_bit != pixels.stored - 1)
        info.notes.emplace_back("bits beside the samples (overlays) are left out");
    if (const std::optional<double> padding = header.values.number(kDicomPadding); padding && !is_converted) {
        const std::optional<double> limit = header.values.number(kDicomPaddingLimit);
        const auto whole = [](double value) { return std::to_string(static_cast<std::int64_t>(value)); };
        info.notes.push_back("samples of " + whole(*padding) + (limit ? " to " + whole(*limit) : "") +
                             " lie outside the picture (PixelPaddingValue); give that as the no-data value to leave them out");
    }
}

std::unique_ptr<VolumeReader> open_group(const std::string& path, const OpenOptions& options, std::vector<DicomFile> files,
                                         const DicomGroup& group) {
    DicomStack stack = dicom_stack(path, group, files);
    const TimeStep step = choose_time_step(path, options, static_cast<std::int64_t>(stack.steps.size()));
    std::vector<DicomSlice> slices = std::move(stack.steps[static_cast<std::size_t>(step.index)]);
    const DicomFile& first = files[slices[0].file];
    VolumeInfo info;
    info.path = path;
    info.format = "DICOM";
    info.encoding = first.header.syntax.encapsulated || first.header.syntax.deflated ? name_of_syntax(first.header.syntax.uid) : "raw";
    info.type = first.pixels.type;
    info.big_endian = first.header.syntax.big_endian;
    const auto count = static_cast<std::int64_t>(slices.size());
    info.extent = {.rank = count == 1 ? 2 : 3, .size = {first.pixels.columns, first.pixels.rows, count}};
    static_cast<void>(sample_bytes(path, info.extent, ValueType::f64));
    info.notes = std::move(stack.notes);
    info.geometry = dicom_geometry(path, slices, info.notes);
    const DicomScaling scaling = scaling_of(slices, info, first.pixels);
    info.calibration = scaling.calibration;
    info.value_unit = value_unit_of(first.header, scaling.is_converted || !scaling.calibration.is_linear_identity());
    note_values(first.header, first.pixels, scaling.is_converted, info);
    info.volumes.has_series = true;
    info.volumes.time_step = step.index;
    info.volumes.time_steps = step.count;
    info.volumes.times = std::move(stack.times);
    info.volumes.time_unit = std::move(stack.time_unit);
    info.slab_readable = true;
    std::vector<bool> is_counted(files.size(), false);
    for (const DicomSlice& slice : slices) {
        if (!is_counted[slice.file]) info.file_bytes += files[slice.file].header.file_bytes;
        is_counted[slice.file] = true;
    }
    return std::make_unique<DicomReader>(std::move(info), std::move(files), std::move(slices), scaling.is_converted);
}

std::unique_ptr<VolumeReader> choose_group(const std::string& path, const OpenOptions& options, std::vector<DicomFile> files,
                                           const std::vector<DicomGroup>& groups) {
    std::vector<ErrorChoice> choices;
    for (const DicomGroup& group : groups) choices.push_back({.word = printable(group.word), .about = about_group(group, files)});
    const DicomGroup& chosen = groups[choose_series(path, options, choices)];
    return open_group(path, options, std::move(files), chosen);
}

}  // namespace

bool looks_like_dicom(FirstBytes first, const std::string&) { return starts_like_dicom(first); }

std::unique_ptr<VolumeReader> open_dicom(const std::string& path, const OpenOptions& options) {
    std::vector<DicomFile> files;
    if (!add_dicom_file(files, read_dicom_header(path))) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .what = "the DICOM file holds no picture",
                                             .expected = "an image",
                                             .next = "name a file or folder of an image series"});
    }
    const std::string series = files[0].header.values.text(kDicomSeries);
    const std::string folder = beside(path, "");
    for (const std::string& name :
         series.empty() ? std::vector<std::string>{} : list_files(folder.empty() ? "." : folder, 0, options.follow_links)) {
        if (file_system().resolved(name) == file_system().resolved(path) || !is_dicom_file(name)) continue;
        DicomHeader header = read_dicom_header(name);
        if (header.values.text(kDicomSeries) != series) continue;
        if (!options.follow_links) require_own_folder(path, name);
        add_dicom_file(files, std::move(header));
    }
    std::vector<DicomGroup> groups = dicom_groups(files);
    if (!options.series) {  // the groups that the file is in
        std::erase_if(groups, [](const DicomGroup& group) {
            return std::ranges::none_of(group.slices, [](const DicomSlice& slice) { return slice.file == 0; });
        });
    }
    return choose_group(path, options, std::move(files), groups);
}

std::unique_ptr<VolumeReader> open_dicom_folder(const std::string& path, const OpenOptions& options) {
    std::vector<DicomFile> files;
    for (const std::string& name : list_files(path, kMaxFolders, options.follow_links)) {
        if (!is_dicom_file(name)) continue;
        if (!options.follow_links) require_inside(path, name);
        (void)add_dicom_file(files, read_dicom_header(name));
    }
    if (files.empty()) return nullptr;
    const std::vector<DicomGroup> groups = dicom_groups(files);
    return choose_group(path, options, std::move(files), groups);
}

}  // namespace isoatlas

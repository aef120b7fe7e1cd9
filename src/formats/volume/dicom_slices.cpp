#include "formats/volume/dicom_slices.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "formats/common/text.h"
#include "formats/volume/bad_header.h"
#include "isoatlas/text.h"

namespace isoatlas {
namespace {

/// The value of a frame, else the one that all frames share, else that of the file.
class FrameValues {
public:
    FrameValues(const DicomHeader& header, std::size_t frame)
        : header_(header), frame_(frame < header.frames.size() ? &header.frames[frame] : nullptr) {}

    [[nodiscard]] std::string text(DicomTag tag) const { return values_of(tag).text(tag); }
    [[nodiscard]] std::optional<double> number(DicomTag tag) const { return values_of(tag).number(tag); }
    /// Exactly so many numbers; nullopt: missing. Throws Error{input} for another value.
    template <std::size_t N>
    [[nodiscard]] std::optional<std::array<double, N>> take(DicomTag tag, const char* name) const {
        const std::string* text = values_of(tag).find(tag);
        if (text == nullptr || text->empty()) return std::nullopt;
        const std::optional<std::vector<double>> numbers = values_of(tag).numbers(tag);
        if (!numbers || numbers->size() != N) bad_header(header_.path, name, "is " + in_quotes(*text), std::to_string(N) + " numbers");
        std::array<double, N> taken{};
        std::copy(numbers->begin(), numbers->end(), taken.begin());
        return taken;
    }

private:
    [[nodiscard]] const DicomValues& values_of(DicomTag tag) const {
        if (frame_ != nullptr && frame_->find(tag) != nullptr) return *frame_;
        return header_.shared.find(tag) != nullptr ? header_.shared : header_.values;
    }

    const DicomHeader& header_;
    const DicomValues* frame_;
};

double dicom_length(const Vec3& v) { return std::sqrt(dot_product(v, v)); }

void take_orientation(const DicomHeader& header, const FrameValues& values, DicomSlice& slice) {
    const auto cosines = values.take<6>(kDicomOrientation, "ImageOrientationPatient");
    if (!cosines) return;
    const auto& c = *cosines;
    slice.row = {c[0], c[1], c[2]}, slice.column = {c[3], c[4], c[5]};
    const double row = dicom_length(slice.row), column = dicom_length(slice.column);
    constexpr double kRounding = 1e-2;
    if (!(std::abs(row - 1) < kRounding && std::abs(column - 1) < kRounding && std::abs(dot_product(slice.row, slice.column)) < kRounding))
        bad_header(header.path, "ImageOrientationPatient", "is not two perpendicular directions", "direction cosines");
    for (std::size_t k = 0; k < 3; ++k) slice.row[k] /= row, slice.column[k] /= column;
}

void take_spacing(const DicomHeader& header, const FrameValues& values, DicomSlice& slice) {
    auto spacing = values.take<2>(kDicomPixelSpacing, "PixelSpacing");
    if (!spacing) {
        spacing = values.take<2>(kDicomImagerSpacing, "ImagerPixelSpacing");
        slice.is_detector_spacing = spacing.has_value();
    }
    if (!spacing) return;
    constexpr double kMost = 1e9;
    for (const double distance : *spacing) {
        if (!(distance > 0 && distance < kMost))
            bad_header(header.path, "PixelSpacing", "is " + std::to_string(distance), "a positive distance");
    }
    slice.spacing = {(*spacing)[1], (*spacing)[0]};  // the file has that between rows first
}

void take_scaling(const DicomHeader& header, const FrameValues& values, DicomSlice& slice) {
    constexpr double kMost = 1e30;
    const double slope = values.number(kDicomSlope).value_or(header.values.number(kDicomDoseScaling).value_or(1));
    const double intercept = values.number(kDicomIntercept).value_or(0);
    if (std::abs(slope) > 1 / kMost && std::abs(slope) < kMost && std::abs(intercept) < kMost)
        slice.slope = slope, slice.intercept = intercept;
}

void take_keys(const FrameValues& values, DicomSlice& slice) {
    const auto first = [&](DicomTag tag, DicomTag other) {
        const std::string text = values.text(tag);
        return text.empty() ? values.text(other) : text;
    };
    slice.keys = {first(kDicomTemporalIndex, kDicomTemporalPosition),
                  first(kDicomEffectiveEchoTime, kDicomEchoTime),
                  values.text(kDicomTriggerTime),
                  values.text(kDicomBValue),
                  values.text(kDicomAcquisitionNumber),
                  values.text(kDicomAcquisitionTime),
                  values.text(kDicomImageType)};
}

/// Frames without places of their own lie along the normal: at offsets that the file lists, or at equal distances.
void place_frames(const DicomHeader& header, std::vector<DicomSlice>& slices) {
    if (slices.size() < 2 || !slices[0].position || !header.frames.empty()) return;
    const Vec3 normal = dicom_normal(slices[0]);
    const std::optional<std::vector<double>> offsets = header.values.numbers(kDicomFrameOffsets);
    const std::optional<double> distance = header.values.number(kDicomSpacingBetweenSlices);
    const bool has_offsets = offsets && offsets->size() == slices.size();
    if (!has_offsets && !(distance && *distance != 0)) {
        for (DicomSlice& slice : slices) slice.position.reset();
        return;
    }
    for (std::size_t i = 0; i < slices.size(); ++i) {
        // The first offset is 0, or the place along z itself.
        const double along = has_offsets ? (*offsets)[i] - (*offsets)[0] : *distance * static_cast<double>(i);
        for (std::size_t k = 0; k < 3; ++k) (*slices[i].position)[k] += along * normal[k];
    }
}

/// Rounded for comparisons: orientations that differ in their fourth digit are two.
std::array<std::int64_t, 6> rounded_orientation(const DicomSlice& slice) {
    constexpr double kSteps = 2000;
    std::array<std::int64_t, 6> rounded{};
    for (std::size_t k = 0; k < 3; ++k) {
        rounded[k] = std::llround(slice.row[k] * kSteps);
        rounded[k + 3] = std::llround(slice.column[k] * kSteps);
    }
    return rounded;
}

bool belongs(const DicomGroup& group, const DicomSlice& slice, const std::vector<DicomFile>& files) {
    const DicomSlice& first = group.slices[0];
    const DicomFile &a = files[first.file], &b = files[slice.file];
    if (!first.position || !slice.position) return first.file == slice.file && !first.position && !slice.position;
    if (!a.pixels.same_shape(b.pixels) || a.header.values.text(kDicomSeries) != b.header.values.text(kDicomSeries)) return false;
    constexpr double kSameDirection = 5e-4, kSameSpacing = 1e-3;
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(first.row[k] - slice.row[k]) > kSameDirection || std::abs(first.column[k] - slice.column[k]) > kSameDirection)
            return false;
    }
    if (first.spacing.has_value() != slice.spacing.has_value()) return false;
    if (!first.spacing) return true;
    for (std::size_t k = 0; k < 2; ++k) {
        if (std::abs((*first.spacing)[k] - (*slice.spacing)[k]) > kSameSpacing * (*first.spacing)[k]) return false;
    }
    return true;
}

auto order_of(const DicomGroup& group, const std::vector<DicomFile>& files) {
    const DicomSlice& first = group.slices[0];
    const DicomFile& file = files[first.file];
    return std::tuple(file.header.values.number(kDicomSeriesNumber).value_or(0), file.header.values.text(kDicomSeries), file.pixels.columns,
                      file.pixels.rows, file.pixels.type, rounded_orientation(first), first.position.value_or(Vec3{}),
                      file.header.values.text(kDicomInstance));
}

std::string short_number(double value) {
    std::array<char, 32> digits{};
    const int length = std::snprintf(digits.data(), digits.size(), "%.3g", value);
    return {digits.data(), static_cast<std::size_t>(std::max(length, 0))};
}

const char* name_of_plane(const Vec3& normal) {
    constexpr double kAlong = 0.95;
    static constexpr const char* kPlanes[] = {"sagittal", "coronal", "axial"};
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::abs(normal[k]) > kAlong) return kPlanes[k];
    }
    return "oblique";
}

/// The smaller one of the two middle distances of neighbours; 0: there are none.
double usual_distance(const DicomGroup& group) {
    std::vector<double> places, distances;
    for (const DicomSlice& slice : group.slices) places.push_back(slice.along);
    std::ranges::sort(places);
    constexpr double kSamePlace = 1e-3;
    for (std::size_t i = 1; i < places.size(); ++i) {
        if (places[i] - places[i - 1] > kSamePlace) distances.push_back(places[i] - places[i - 1]);
    }
    if (distances.empty()) return 0;
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) / 2);
    std::ranges::nth_element(distances, middle);
    return *middle;
}

}  // namespace

double dot_product(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 dicom_normal(const DicomSlice& slice) {
    const Vec3 &a = slice.row, &b = slice.column;
    Vec3 normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = dicom_length(normal);
    for (double& entry : normal) entry /= length;
    return normal;
}

std::vector<DicomSlice> dicom_slices(const DicomFile& file, std::size_t number) {
    std::vector<DicomSlice> slices;
    for (std::int64_t frame = 0; frame < file.pixels.frames; ++frame) {
        const FrameValues values(file.header, static_cast<std::size_t>(frame));
        DicomSlice slice{
            .file = number, .frame = frame, .position = values.take<3>(kDicomPosition, "ImagePositionPatient"), .spacing = {}, .keys = {}};
        constexpr double kFarthest = 1e9;
        if (slice.position && std::ranges::any_of(*slice.position, [](double place) { return std::abs(place) > kFarthest; }))
            bad_header(file.header.path, "ImagePositionPatient", "is " + in_quotes(values.text(kDicomPosition)), "a place in mm");
        take_orientation(file.header, values, slice);
        take_spacing(file.header, values, slice);
        take_scaling(file.header, values, slice);
        take_keys(values, slice);
        slices.push_back(std::move(slice));
    }
    place_frames(file.header, slices);
    return slices;
}

std::vector<DicomGroup> dicom_groups(const std::vector<DicomFile>& files) {
    std::vector<DicomGroup> groups;
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (DicomSlice& slice : dicom_slices(files[i], i)) {
            const auto found = std::ranges::find_if(groups, [&](const DicomGroup& group) { return belongs(group, slice, files); });
            if (found != groups.end()) {
                found->slices.push_back(std::move(slice));
            } else {
                groups.push_back({.slices = {std::move(slice)}, .word = ""});
            }
        }
    }
    for (DicomGroup& group : groups) {
        const Vec3 normal = dicom_normal(group.slices[0]);
        for (DicomSlice& slice : group.slices)
            slice.along = slice.position ? dot_product(*slice.position, normal) : static_cast<double>(slice.frame);
    }
    std::ranges::stable_sort(groups, [&](const DicomGroup& a, const DicomGroup& b) { return order_of(a, files) < order_of(b, files); });
    const auto series = [&](const DicomGroup& group) { return files[group.slices[0].file].header.values.text(kDicomSeries); };
    for (DicomGroup& group : groups) {
        const auto same = [&](const DicomGroup& other) { return series(other) == series(group); };
        group.word = series(group);
        if (std::ranges::count_if(groups, same) > 1) group.word += "/" + std::to_string(std::count_if(groups.data(), &group, same));
    }
    return groups;
}

std::string about_group(const DicomGroup& group, const std::vector<DicomFile>& files) {
    const DicomSlice& first = group.slices[0];
    const DicomFile& file = files[first.file];
    const std::size_t count = group.slices.size();
    std::string text = file.header.values.text(kDicomModality);
    if (!text.empty()) text += ", ";
    text += std::to_string(count) + (count == 1 ? " slice, " : " slices, ") + std::to_string(file.pixels.columns) + " x " +
            std::to_string(file.pixels.rows);
    if (first.spacing) {
        text += ", " + short_number((*first.spacing)[0]) + " x " + short_number((*first.spacing)[1]);
        const double distance = usual_distance(group);
        if (first.position && distance > 0) text += " x " + short_number(distance);
        text += " mm";
    }
    if (first.position) text += std::string(", ") + name_of_plane(dicom_normal(first));
    const std::string description = file.header.values.text(kDicomSeriesDescription);
    return header_text(description.empty() ? text : text + ", " + description);
}

}  // namespace isoatlas

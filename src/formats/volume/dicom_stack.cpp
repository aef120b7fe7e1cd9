#include "formats/volume/dicom_stack.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "formats/common/text.h"

namespace isoatlas {
namespace {

constexpr std::size_t kShownPlaces = 5;

std::string short_mm(double value) {
    std::array<char, 32> digits{};
    const int length = std::snprintf(digits.data(), digits.size(), "%.6g", value);
    return {digits.data(), static_cast<std::size_t>(std::max(length, 0))};
}

std::string place_text(const DicomSlice& slice) {
    const Vec3& p = *slice.position;
    return "(" + short_mm(p[0]) + ", " + short_mm(p[1]) + ", " + short_mm(p[2]) + ")";
}

std::string list_places(const std::vector<const DicomSlice*>& slices) {
    std::string text;
    for (std::size_t i = 0; i < std::min(slices.size(), kShownPlaces); ++i) text += (i > 0 ? ", " : "") + place_text(*slices[i]);
    return text + (slices.size() > kShownPlaces ? ", ..." : "") + " mm";
}

/// Slices at one place are neighbours of the same number.
std::vector<std::size_t> number_places(const std::vector<DicomSlice>& slices) {
    constexpr double kSamePlace = 1e-3;  // of a pixel
    const double tolerance = kSamePlace * (slices[0].spacing ? std::min((*slices[0].spacing)[0], (*slices[0].spacing)[1]) : 1);
    std::vector<std::size_t> places(slices.size(), 0);
    for (std::size_t i = 1; i < slices.size(); ++i) {
        const bool is_same = slices[i].along - slices[i - 1].along <= tolerance;
        places[i] = places[i - 1] + (is_same ? 0 : 1);
    }
    return places;
}

/// Copies of one instance, at the same place with the same keys: the first one stays.
std::size_t drop_copies(std::vector<DicomSlice>& slices, const std::vector<DicomFile>& files) {
    std::map<std::tuple<std::string, std::int64_t, Vec3>, std::array<std::string, kDicomKeys.size()>> seen;
    return std::erase_if(slices, [&](const DicomSlice& slice) {
        const std::string instance = files[slice.file].header.values.text(kDicomInstance);
        if (instance.empty() || !slice.position) return false;
        const auto [at, is_new] = seen.try_emplace({instance, slice.frame, *slice.position}, slice.keys);
        return !is_new && at->second == slice.keys;
    });
}

/// The steps by one key, if each of its values has every place once.
std::vector<std::vector<DicomSlice>> split_by_key(const std::vector<DicomSlice>& slices, const std::vector<std::size_t>& places,
                                                  std::size_t key) {
    std::map<std::pair<double, std::string>, std::vector<DicomSlice>> steps;
    std::map<std::pair<double, std::string>, std::vector<std::size_t>> taken;
    for (std::size_t i = 0; i < slices.size(); ++i) {
        const std::string& value = slices[i].keys[key];
        const std::pair<double, std::string> name{parse_number(value).value_or(0), value};
        std::vector<std::size_t>& of_step = taken[name];
        if (!of_step.empty() && of_step.back() == places[i]) return {};
        of_step.push_back(places[i]);
        steps[name].push_back(slices[i]);
    }
    std::vector<std::vector<DicomSlice>> result;
    for (auto& [name, of_step] : steps) {
        if (of_step.size() != places.back() + 1) return {};
        result.push_back(std::move(of_step));
    }
    return result;
}

/// Places with fewer or more slices than most places have.
[[noreturn]] void refuse_doubles(const std::string& path, const std::vector<DicomSlice>& slices, const std::vector<std::size_t>& places) {
    std::vector<std::size_t> counts(places.back() + 1, 0);
    for (const std::size_t place : places) ++counts[place];
    std::map<std::size_t, std::size_t> frequency;
    for (const std::size_t count : counts) ++frequency[count];
    const auto usual = std::ranges::max_element(frequency, {}, [](const auto& entry) { return entry.second; })->first;
    const bool all_equal = frequency.size() == 1;
    std::vector<const DicomSlice*> odd;
    for (std::size_t i = 0; i < slices.size(); ++i) {
        const bool is_first = i == 0 || places[i] != places[i - 1];
        if (is_first && (all_equal || counts[places[i]] != usual)) odd.push_back(&slices[i]);
    }
    throw Error(ErrorKind::input,
                {.file = path,
                 .where = "places " + list_places(odd),
                 .what = all_equal ? "each place has " + std::to_string(usual) + " slices, and nothing tells whether they are time steps"
                                   : std::to_string(odd.size()) + (odd.size() == 1 ? " place has" : " places have") +
                                         " more or fewer slices than the others",
                 .expected = std::to_string(usual > 1 && !all_equal ? usual : 1) + (usual > 1 && !all_equal ? " slices" : " slice") +
                             " at each place",
                 .next = "move the slices of one acquisition into a folder of their own"});
}

void name_times(DicomStack& stack, std::size_t key, const std::vector<DicomFile>& files) {
    const std::string name = kDicomKeys[key];
    stack.notes.push_back("the " + std::to_string(stack.steps.size()) + " time steps are the values of " + name);
    constexpr std::size_t kTemporalKey = 0, kLastTime = 2;  // echo and trigger times are in ms
    const std::optional<double> resolution = files[stack.steps[0][0].file].header.values.number(kDicomTemporalResolution);
    for (std::size_t step = 0; step < stack.steps.size(); ++step) {
        std::optional<double> time = parse_number(stack.steps[step][0].keys[key]);
        if (key == kTemporalKey)
            time = resolution && *resolution > 0 ? std::optional(*resolution * static_cast<double>(step)) : std::nullopt;
        if (key <= kLastTime && time && std::isfinite(*time)) stack.times.push_back(*time);
    }
    if (stack.times.size() != stack.steps.size()) stack.times.clear();
    if (!stack.times.empty()) stack.time_unit = "ms";
}

/// How far from the line through the first and the last slice the others lie, at most, in mm.
double distance_from_line(const std::vector<DicomSlice>& slices) {
    const DicomSlice &first = slices.front(), &last = slices.back();
    double farthest = 0;
    for (const DicomSlice& slice : slices) {
        const double part = (slice.along - first.along) / (last.along - first.along);
        double squares = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double on_line = (*first.position)[k] + part * ((*last.position)[k] - (*first.position)[k]);
            squares += ((*slice.position)[k] - on_line) * ((*slice.position)[k] - on_line);
        }
        farthest = std::max(farthest, std::sqrt(squares));
    }
    return farthest;
}

void refuse_gaps(const std::string& path, const std::vector<DicomSlice>& slices, double usual) {
    std::vector<const DicomSlice*> before;
    std::string gaps;
    std::int64_t missing = 0;
    constexpr double kNearMultiple = 0.1;
    for (std::size_t i = 1; i < slices.size(); ++i) {
        const double steps = (slices[i].along - slices[i - 1].along) / usual, whole = std::round(steps);
        if (whole < 2 || std::abs(steps - whole) > kNearMultiple) continue;
        missing += static_cast<std::int64_t>(whole) - 1;
        if (before.size() < kShownPlaces)
            gaps += (before.empty() ? "" : "; ") + std::string("between ") + place_text(slices[i - 1]) + " and " + place_text(slices[i]) +
                    " mm";
        before.push_back(&slices[i - 1]);
    }
    if (before.empty()) return;
    throw Error(ErrorKind::input, {.file = path,
                                   .where = gaps + (before.size() > kShownPlaces ? "; ..." : ""),
                                   .what = std::to_string(missing) + (missing == 1 ? " slice is missing" : " slices are missing"),
                                   .expected = "a slice every " + short_mm(usual) + " mm",
                                   .next = "get the missing files, or move the slices of one side of the gap elsewhere"});
}

/// Third axis of a stack: from the first slice to the last.
void take_third_axis(const std::string& path, const std::vector<DicomSlice>& slices, Geometry& geometry, std::vector<std::string>& notes) {
    const DicomSlice &first = slices.front(), &last = slices.back();
    const auto count = static_cast<double>(slices.size() - 1);
    const double pixel = std::min(geometry.spacing[0], geometry.spacing[1]);
    Vec3 way{};
    for (std::size_t k = 0; k < 3; ++k) way[k] = (*last.position)[k] - (*first.position)[k];
    const double length = std::sqrt(dot_product(way, way)), height = last.along - first.along;
    std::vector<double> distances;
    for (std::size_t i = 1; i < slices.size(); ++i) distances.push_back(slices[i].along - slices[i - 1].along);
    std::ranges::sort(distances);
    refuse_gaps(path, slices, distances[(distances.size() - 1) / 2]);
    const double astray = distance_from_line(slices);
    if (astray > pixel) {
        throw Error(ErrorKind::input, {.file = path,
                                       .where = "places " + place_text(first) + " to " + place_text(last) + " mm",
                                       .what = "the slices do not lie on one line: " + short_mm(astray) + " mm away from it",
                                       .expected = "less than a pixel, " + short_mm(pixel) + " mm",
                                       .next = "resample them to a regular grid with the program of the scanner"});
    }
    constexpr double kSideways = 0.1;  // pixels over the whole stack
    const Vec3 normal = dicom_normal(first);
    Vec3 sideways{};
    for (std::size_t k = 0; k < 3; ++k) sideways[k] = way[k] - height * normal[k];
    const double shift = std::sqrt(dot_product(sideways, sideways));
    const bool is_tilted = shift > kSideways * pixel && shift > 1e-3 * height;
    const double along = is_tilted ? length : height;
    if (is_tilted)
        notes.push_back("the slices are displaced sideways (gantry tilt of " +
                        short_mm(std::atan2(shift, height) * 180 / std::numbers::pi) + " degrees): the third axis is oblique");
    for (std::size_t k = 0; k < 3; ++k) geometry.direction[k][2] = is_tilted ? way[k] / length : normal[k];
    geometry.spacing[2] = along / count;
    constexpr double kUneven = 0.01;
    const double even = height / count, most = std::max(distances.back() - even, even - distances.front());
    if (most <= kUneven * even) return;
    notes.push_back("the distances of the slices differ, from " + short_mm(distances.front()) + " to " + short_mm(distances.back()) +
                    " mm: each slice keeps its place");
    for (const DicomSlice& slice : slices) geometry.coordinates[2].push_back((slice.along - first.along) * (along / height));
}

}  // namespace

DicomStack dicom_stack(const std::string& path, const DicomGroup& group, const std::vector<DicomFile>& files) {
    DicomStack stack;
    std::vector<DicomSlice> slices = group.slices;
    const std::size_t copies = drop_copies(slices, files);
    if (copies > 0) stack.notes.push_back(std::to_string(copies) + " slices are copies of others (of the same instance) and were left out");
    std::ranges::stable_sort(slices, {}, &DicomSlice::along);
    const std::vector<std::size_t> places = number_places(slices);
    if (places.back() + 1 == slices.size()) {
        stack.steps.push_back(std::move(slices));
        return stack;
    }
    for (std::size_t key = 0; key < kDicomKeys.size(); ++key) {
        std::vector<std::vector<DicomSlice>> steps = split_by_key(slices, places, key);
        if (steps.empty()) continue;
        stack.steps = std::move(steps);
        name_times(stack, key, files);
        return stack;
    }
    refuse_doubles(path, slices, places);
}

Geometry dicom_geometry(const std::string& path, const std::vector<DicomSlice>& slices, std::vector<std::string>& notes) {
    const DicomSlice& first = slices.front();
    Geometry geometry;
    if (first.spacing) {
        geometry.spacing = {(*first.spacing)[0], (*first.spacing)[1], 1};
        geometry.unit = "mm";
        if (first.is_detector_spacing)
            notes.emplace_back("the spacing is that at the detector (ImagerPixelSpacing); the object is magnified");
    } else {
        notes.emplace_back("the size of the pixels is not given: 1 was assumed");
    }
    if (!first.position) {
        if (slices.size() > 1)
            notes.emplace_back("the places of the frames are not given: they are the third axis in their order, at a distance of 1");
        if (slices.size() > 1) geometry.unit.clear();
        return geometry;
    }
    geometry.space = "LPS";
    geometry.origin = *first.position;
    const Vec3 normal = dicom_normal(first);
    for (std::size_t k = 0; k < 3; ++k) geometry.direction[k] = {first.row[k], first.column[k], normal[k]};
    if (slices.size() > 1) take_third_axis(path, slices, geometry, notes);
    return geometry;
}

}  // namespace isoatlas

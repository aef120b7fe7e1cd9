#include "isoatlas/survey.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cancel.h"
#include "base/phase.h"
#include "features/noise.h"
#include "features/sample_counter.h"
#include "isoatlas/environment.h"
#include "isoatlas/filter.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kSlab = 16 << 20, kReadPart = 32 << 20;  // bytes
constexpr double kFarFromKnown = 0.1, kFarFromAny = 1, kPlateau = 0.01;
constexpr std::size_t kFewest = 10;

constexpr std::array<double, 15> kKnown{-999,  -9999, -99999,       -32767,     -2000,       -2048,   -3024,   -32768,
                                        32767, 65535, -2147483648., 2147483647, 4294967295., -999999, -9999999};
constexpr std::array<double, 3> kKnownPowers{1e15, 1e20, 1e30};
constexpr double kGreat = 9.96e36;  // netCDF has 9.96921e36, other programs the largest of the type

bool is_usual(double value, const VolumeInfo& info) {
    if (size_of(info.type) == 1) return false;
    const auto close = [](double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); };  // float32 has 1.00000002e20
    for (const double number : {value, info.calibration.reported(value)}) {
        if (std::ranges::find(kKnown, number) != kKnown.end() || std::abs(number) >= kGreat) return true;
        if (std::ranges::any_of(kKnownPowers, [&](double power) { return close(std::abs(number), power); })) return true;
    }
    return false;
}

struct Found {
    FillValue fill;
    double far = 0;  ///< distance from the others, in ranges of the others
};

/// end: of which the value may be a fill value; other: the farthest of the remaining ones.
std::optional<Found> fill_at(const RangeEnd& end, double other, const SampleSurvey& survey, const VolumeInfo& info) {
    const double range = std::abs(other - end.next), gap = std::abs(end.next - end.value);
    if (end.value == 0 || !std::isfinite(end.next) || !(range > 0)) return std::nullopt;
    const double far = gap / range;
    const bool is_known = is_usual(end.value, info);
    const bool is_plateau = static_cast<double>(end.count) >= kPlateau * static_cast<double>(survey.samples);
    if (!(is_known ? far > kFarFromKnown : is_plateau && far > kFarFromAny)) return std::nullopt;
    return Found{{end.value, end.count, std::min(end.next, other), std::max(end.next, other), is_known}, far};
}

/// Slices [first, first + count) with as few missing samples as possible.
Volume some_slices(VolumeReader& reader, const SampleSurvey& survey, const std::optional<FillValue>& fill) {
    const VolumeInfo& info = reader.info();
    const std::int64_t slice = info.extent.slice() * static_cast<std::int64_t>(size_of(info.type));
    const std::int64_t count = std::clamp<std::int64_t>(kReadPart / slice, 1, info.extent.size[2]);
    Extent extent = info.extent;
    extent.size[2] = count;
    Volume part = make_volume(extent, info.type, info.geometry);
    const std::int64_t first = (info.extent.size[2] - count) / 2;
    reader.read(first, first + count, part.bytes);
    visit_type(info.type, [&]<class T>(T) {
        const auto other = static_cast<T>(fill ? fill->low : survey.low.value);
        for (T& sample : part.samples<T>()) {
            const auto value = static_cast<double>(sample);
            if (!std::isfinite(value) || (fill && value == fill->value)) sample = other;
        }
    });
    return part;
}

}  // namespace

SampleSurvey survey_samples(VolumeReader& reader, const Context& context) {
    const EnvironmentScope scope(context);
    const VolumeInfo& info = reader.info();
    const std::int64_t slice = info.extent.slice() * static_cast<std::int64_t>(size_of(info.type));
    const std::int64_t slices = info.extent.size[2], step = std::clamp<std::int64_t>(kSlab / slice, 1, slices);
    std::vector<std::byte> slab(static_cast<std::size_t>(step * slice));
    SampleCounter counter;
    for (std::int64_t z = 0; z < slices; z += step) {
        stop_if_cancelled(context);
        const std::int64_t count = std::min(step, slices - z);
        const std::span<std::byte> bytes = std::span(slab).first(static_cast<std::size_t>(count * slice));
        reader.read(z, z + count, bytes);
        visit_type(info.type, [&]<class T>(T) {
            const std::span<const T> samples(reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T));
            const auto row = static_cast<std::size_t>(info.extent.size[0]);
            for (std::size_t first = 0; first < samples.size(); first += row) counter.look(samples.subspan(first, row));
        });
        report(context, only_phase("survey"), static_cast<double>(z + count) / static_cast<double>(slices));
    }
    return counter.survey();
}

std::optional<FillValue> fill_value(const SampleSurvey& survey, const VolumeInfo& info) {
    if (survey.samples == 0 || survey.likeness.are_labels || (survey.values > 0 && survey.values < kFewest)) return std::nullopt;
    const std::optional<Found> low = fill_at(survey.low, survey.high.value, survey, info);
    const std::optional<Found> high = fill_at(survey.high, survey.low.value, survey, info);
    if (!low && !high) return std::nullopt;
    return !high || (low && low->far > high->far) ? low->fill : high->fill;
}

double independent_noise(VolumeReader& reader, const SampleSurvey& survey, const std::optional<FillValue>& fill) {
    if (survey.samples == 0 || (survey.values > 0 && survey.values < kFewest)) return 0;
    const Volume part = some_slices(reader, survey, fill);
    return std::min(estimate_noise(part), finest_noise(part));
}

double noise_left_by(const VolumeInfo& info, double sigma) {
    const Index3 radius = gaussian_radius(info, sigma);
    double left = 1;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(info.extent.rank); ++axis) {
        double sum = 1, squares = 1;
        for (std::int64_t d = 1; d <= radius[axis]; ++d) {
            const double distance = static_cast<double>(d) * info.geometry.spacing[axis] / sigma,
                         weight = std::exp(-distance * distance / 2);
            sum += 2 * weight, squares += 2 * weight * weight;
        }
        left *= std::sqrt(squares) / sum;
    }
    return left;
}

double advised_sigma(const VolumeInfo& info, double noise, double range) {
    constexpr double kLeft = 0.0075;  // of the range
    const bool is_even = std::ranges::all_of(info.geometry.coordinates, [](const auto& axis) { return axis.empty(); });
    if (!is_even || !(range > 0) || noise <= kNoisy * range) return 0;
    double smallest = info.geometry.spacing[0];
    for (int axis = 1; axis < info.extent.rank; ++axis) smallest = std::min(smallest, info.geometry.spacing[axis]);
    for (const double voxels : {0.5, 0.75, 1.0, 1.25, 1.5, 1.75}) {
        if (noise * noise_left_by(info, voxels * smallest) <= kLeft * range) return voxels * smallest;
    }
    return 2 * smallest;
}

}  // namespace isoatlas

#include "formats/common/missing.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace isoatlas {
namespace {

template <class T>
std::span<const T> as_samples(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

/// The shortest text that reads back as the same number.
std::string text_of(double value) {
    char buffer[32];
    const std::to_chars_result end = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end.ptr};
}

/// Whether a value survives being stored in the type; floating types round, integers must match.
template <class T>
bool storable(double value) {
    if constexpr (std::is_floating_point_v<T>) return std::isfinite(static_cast<T>(value));
    return value >= static_cast<double>(std::numeric_limits<T>::lowest()) && value <= static_cast<double>(std::numeric_limits<T>::max()) &&
           value == std::floor(value);
}

}  // namespace

MissingScan::MissingScan(const VolumeInfo& info, const MissingPolicy& policy, bool calibrated)
    : info_(info), policy_(policy), calibrated_(calibrated), value_(calibrated ? info.calibration.reported(policy.value) : policy.value) {
    if (policy.action != MissingPolicy::Action::replace) return;
    const ValueType type = calibrated ? ValueType::f64 : info.type;
    const bool fits = std::isfinite(value_) && visit_type(type, [&](auto zero) { return storable<decltype(zero)>(value_); });
    if (fits) return;
    throw Error(ErrorKind::usage, {.file = info.path,
                                   .what = "for missing samples: " + text_of(policy.value) + " is not a value of " + name_of(type),
                                   .expected = is_floating(type) ? "a finite number" : "a whole number in the range of the type",
                                   .next = "give another value, or treat missing samples as background",
                                   .reason = Reason::replacement_not_stored});
}

template <class T>
bool MissingScan::is_missing(T sample) const {
    if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(sample)) return true;
        // A no-data value such as 1e20 is the nearest float.
        return !calibrated_ && policy_.no_data && sample == static_cast<T>(*policy_.no_data);
    }
    return !calibrated_ && policy_.no_data && static_cast<double>(sample) == *policy_.no_data;
}

template <class T>
bool MissingScan::any_missing(std::span<const T> samples) const {
    const bool compare = !calibrated_ && policy_.no_data.has_value();
    const double no_data = compare ? *policy_.no_data : 0;
    int found = 0;  // no early exit, so that the loop is vectorised; it is memory-bound then
    for (const T sample : samples) {
        if constexpr (std::is_floating_point_v<T>) {
            found |= !(std::abs(sample) <= std::numeric_limits<T>::max());
            found |= compare && sample == static_cast<T>(no_data);
        } else {
            found |= compare && static_cast<double>(sample) == no_data;
        }
    }
    return found != 0;
}

template <class T>
void MissingScan::look_at(std::span<const T> samples, std::int64_t first) {
    constexpr std::size_t kBlock = 4096;  // stays in the L1 cache for the second pass
    for (std::size_t begin = 0; begin < samples.size(); begin += kBlock) {
        const std::span<const T> block = samples.subspan(begin, std::min(kBlock, samples.size() - begin));
        const bool needs_extremes = policy_.action == MissingPolicy::Action::below || policy_.action == MissingPolicy::Action::above;
        if (needs_extremes || any_missing(block)) {
            look_closely(block, first + static_cast<std::int64_t>(begin));
        }
    }
}

template <class T>
void MissingScan::look_closely(std::span<const T> samples, std::int64_t first) {
    T smallest = std::numeric_limits<T>::max(), largest = std::numeric_limits<T>::lowest();
    std::int64_t missing = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (is_missing(samples[i])) {
            if (policy_.action == MissingPolicy::Action::error) {
                report(first + static_cast<std::int64_t>(i), static_cast<double>(samples[i]),
                       std::isfinite(static_cast<double>(samples[i])));
            }
            ++missing;
        } else {
            smallest = std::min(smallest, samples[i]), largest = std::max(largest, samples[i]);
        }
    }
    count_ += missing;
    if (missing == static_cast<std::int64_t>(samples.size())) return;
    smallest_ = std::min(smallest_, static_cast<double>(smallest)), largest_ = std::max(largest_, static_cast<double>(largest));
}

void MissingScan::look(ValueType type, std::span<const std::byte> samples, std::int64_t first) {
    if (!is_floating(type) && !policy_.no_data) return;  // nothing can be missing
    visit_type(type, [&](auto zero) { look_at(as_samples<decltype(zero)>(samples), first); });
}

void MissingScan::calibrate(ValueType type, std::span<const std::byte> samples, const Calibration& calibration,
                            std::span<double> out) const {
    visit_type(type, [&](auto zero) {
        using T = decltype(zero);
        const std::span<const T> in = as_samples<T>(samples);
        for (std::size_t i = 0; i < in.size(); ++i) {
            bool no_data = false;
            if (policy_.no_data) {
                no_data = std::is_floating_point_v<T> ? in[i] == static_cast<T>(*policy_.no_data)
                                                      : static_cast<double>(in[i]) == *policy_.no_data;
            }
            out[i] = no_data ? std::numeric_limits<double>::quiet_NaN() : calibration.reported(static_cast<double>(in[i]));
        }
    });
}

template <class T>
T MissingScan::replacement() const {
    if (policy_.action == MissingPolicy::Action::replace) return static_cast<T>(value_);
    if (smallest_ == std::numeric_limits<double>::infinity()) {
        throw Error(ErrorKind::input, {.file = info_.path,
                                       .what = "every sample is missing (NaN, infinite or the no-data value)",
                                       .expected = "at least one finite sample",
                                       .next = "check the file and the no-data value",
                                       .reason = Reason::only_missing_samples});
    }
    using Limits = std::numeric_limits<T>;
    if (policy_.action == MissingPolicy::Action::above) {
        const T largest = static_cast<T>(largest_);
        if (largest == Limits::max()) no_room(std::string("no ") + name_of(value_type_of<T>) + " lies above the largest", largest_);
        if constexpr (std::is_floating_point_v<T>) return std::nextafter(largest, Limits::infinity());
        return static_cast<T>(largest + 1);
    }
    const T smallest = static_cast<T>(smallest_);
    if (smallest == Limits::lowest()) no_room(std::string("no ") + name_of(value_type_of<T>) + " lies below the smallest", smallest_);
    if constexpr (std::is_floating_point_v<T>) return std::nextafter(smallest, -Limits::infinity());
    return static_cast<T>(smallest - 1);
}

void MissingScan::no_room(const std::string& what, double end) const {
    throw Error(ErrorKind::input, {.file = info_.path,
                                   .what = what + " sample, " + text_of(end),
                                   .expected = "room for one beyond all others",
                                   .next = "give a value for missing samples instead: " + text_of(end),
                                   .reason = Reason::no_value_below,
                                   .value = text_of(end)});
}

template <class T>
void MissingScan::replace_in(std::span<T> samples) const {
    const T value = replacement<T>();
    for (T& sample : samples) {
        if (is_missing(sample)) sample = value;
    }
}

void MissingScan::replace(VolumeInfo& info, std::span<std::byte> samples) const {
    if (count_ == 0) return;
    visit_type(info.type, [&](auto zero) {
        using T = decltype(zero);
        const T value = replacement<T>();
        replace_in(std::span(reinterpret_cast<T*>(samples.data()), samples.size() / sizeof(T)));
        info.notes.push_back(std::to_string(count_) + " missing samples were replaced by " + text_of(static_cast<double>(value)));
    });
}

void MissingScan::report(std::int64_t index, double value, bool is_no_data) const {
    const Index3 voxel = info_.extent.voxel(index);
    const std::string position = "(" + std::to_string(voxel[0]) + ", " + std::to_string(voxel[1]) + ", " + std::to_string(voxel[2]) + ")";
    const std::string shown = calibrated_ && !is_no_data ? "NaN, infinite or the no-data value" : text_of(value);
    throw Error(ErrorKind::input, {.file = info_.path,
                                   .where = "voxel " + position,
                                   .what = "the sample is " + shown + (is_no_data ? ", the no-data value" : ""),
                                   .expected = "finite samples",
                                   .next = "treat such samples as background, or put a value in their place",
                                   .reason = Reason::missing_samples});
}

}  // namespace isoatlas

// Missing samples: NaN, infinities and optionally a no-data value. Found while slabs are read, replaced at the end.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Usage: look() at every slab in any order, then replace() once.
/// MissingPolicy::value and no_data are stored values (before the calibration), as info and the file show them.
class MissingScan {
public:
    /// Throws Error{usage} when the replacement value cannot be stored in the type, is not finite, or is the no-data value.
    MissingScan(const VolumeInfo& info, const MissingPolicy& policy, bool calibrated);

    /// Counts missing samples and keeps the smallest and the largest other one; `first` is the index of samples[0].
    /// Throws Error{input} that names the first missing voxel of the slab under Action::error.
    void look(ValueType type, std::span<const std::byte> samples, std::int64_t first);

    /// out[i] = calibrated samples[i]; missing samples become NaN (look() is then to be called with f64).
    void calibrate(ValueType type, std::span<const std::byte> samples, const Calibration& calibration, std::span<double> out) const;

    /// Was one of the samples that look() has seen missing?
    [[nodiscard]] bool has_missing() const { return count_ > 0; }

    /// Replaces every missing sample and adds a note with their number.
    /// Throws Error{input} under Action::below (above) when every sample is missing or the type has nothing below the smallest (above the
    /// largest) one.
    void replace(VolumeInfo& info, std::span<std::byte> samples) const;

private:
    template <class T>
    [[nodiscard]] bool is_missing(T sample) const;
    template <class T>
    [[nodiscard]] bool any_missing(std::span<const T> samples) const;
    template <class T>
    void look_closely(std::span<const T> samples, std::int64_t first);
    template <class T>
    void look_at(std::span<const T> samples, std::int64_t first);
    template <class T>
    [[nodiscard]] T replacement() const;
    [[noreturn]] void no_room(const std::string& what, double end) const;
    template <class T>
    void replace_in(std::span<T> samples) const;
    [[noreturn]] void report(std::int64_t index, double value, bool is_no_data) const;

    const VolumeInfo info_;  // of the file
    const MissingPolicy policy_;
    const bool calibrated_;  // samples are checked after the calibration, when no-data values are NaN
    double value_ = 0;       // of the replacement, in the units of the checked samples
    std::int64_t count_ = 0;
    double smallest_ = std::numeric_limits<double>::infinity();  // exact: every sample type fits in double
    double largest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace isoatlas

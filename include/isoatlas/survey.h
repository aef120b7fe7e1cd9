// Survey: what the samples of a file look like before they are analysed: fill values, labels, noise
// (docs/decisions/0036-what-is-assumed-is-said.md).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "isoatlas/volume.h"

namespace isoatlas {

/// An end of the range of the samples.
struct RangeEnd {
    double value;            ///< the lowest (highest) sample, stored
    std::int64_t count = 0;  ///< samples that are equal to it
    double next;             ///< the nearest other value; infinite when there is none
};

/// How like a label volume the samples are. Neighbours are those along x.
struct LabelLikeness {
    double equal = 0;         ///< part of the pairs of neighbours that are equal
    double equal_inside = 0;  ///< the same without the pairs of which both have the commonest value, the background
    double skipping = 0;      ///< part of the unequal pairs between whose values lies another value of the volume
    bool are_labels = false;
};

/// Counts over the finite samples.
struct SampleSurvey {
    static constexpr std::size_t kMostValues = 256;

    std::int64_t samples = 0;  ///< finite ones
    std::int64_t missing = 0;  ///< NaN and infinite
    RangeEnd low{std::numeric_limits<double>::infinity(), 0, std::numeric_limits<double>::infinity()};
    RangeEnd high{-std::numeric_limits<double>::infinity(), 0, -std::numeric_limits<double>::infinity()};
    std::size_t values = 0;  ///< different ones; 0: more than kMostValues, and then there is no likeness
    /// The rule for labels: 3 to 256 different whole numbers, none negative; more than 95 % of the neighbours are equal, of those outside
    /// the background more than half, and at least a tenth of the unequal ones skip a value: a field of few values changes step by step,
    /// labels do not.
    LabelLikeness likeness;
};

/// Reads the whole file once, slab by slab; compressed files forwards. Throws as VolumeReader::read(), cancelled.
/// Cost: reads the file; O(1) memory beyond a slab.
[[nodiscard]] SampleSurvey survey_samples(VolumeReader& reader, const Context& context = {});

/// A value that stands for "no value here".
struct FillValue {
    double value = 0;          ///< stored
    std::int64_t count = 0;    ///< samples
    double low = 0, high = 0;  ///< of the other samples, stored
    bool is_known = false;     ///< one of the usual numbers
};

/// The rule. The lowest or the highest sample v is a fill value when it is not 0, the samples have at least 10 different values, and either
/// v is one of the usual numbers (stored or calibrated: 1e15, 1e20, 1e30, 9.96921e36 and what is greater, the same below 0; -999, -9999,
/// -99999, -32767, -2000, -2048, -3024; the least and the largest of int16, int32, uint16, uint32) and lies farther from the nearest other
/// sample than a tenth of the range of the others; or at least 1 % of all samples are v and it lies farther from them than their whole
/// range. Of two, the one that lies farther, measured by the range of the others. 8-bit samples have no usual numbers; labels no fill
/// value. Measured on 51 volumes: docs/decisions/0036-what-is-assumed-is-said.md. Cost: O(1).
[[nodiscard]] std::optional<FillValue> fill_value(const SampleSurvey& survey, const VolumeInfo& info);

/// The standard deviation of independent noise: the smaller of the estimates of docs/theory/8-noise-and-stability.md#one-number and of the
/// finest second difference, which structure does not reach (#how-much-to-smooth). From all samples, or of volumes of more than 32 MiB from
/// that many in the middle slices. Missing samples and fill values count as the lowest of the others; 0 where there are fewer than 10
/// different values. Throws as VolumeReader::read().
[[nodiscard]] double independent_noise(VolumeReader& reader, const SampleSurvey& survey, const std::optional<FillValue>& fill);

/// Above this part of the range of values, noise makes objects ragged and joins them: smoothing is advised.
inline constexpr double kNoisy = 0.03;

/// The least sigma for gaussian_filter() that leaves at most 0.75 % of the range of independent noise, among quarters of the smallest
/// spacing from 1/2 to 2; 0 when the noise is at most kNoisy of the range, or the grid is rectilinear.
/// (docs/theory/8-noise-and-stability.md#how-much-to-smooth) Cost: O(1).
[[nodiscard]] double advised_sigma(const VolumeInfo& info, double noise, double range);

/// What part of the standard deviation of independent noise gaussian_filter() leaves, away from the borders. sigma > 0.
[[nodiscard]] double noise_left_by(const VolumeInfo& info, double sigma);

}  // namespace isoatlas

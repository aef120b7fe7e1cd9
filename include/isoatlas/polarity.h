// Polarity: objects of high values, or of low ones.
//
// At tau an object of high values is a connected set of samples >= tau, one of low values a connected set of samples <= tau. What lies
// outside the volume belongs to neither, so a region of low values that reaches the border is an object as any other (a cavity, in
// contrast, is enclosed). Objects of low values are those of high values of the negated samples, connected in the same way inside cells:
// docs/theory/9-low-values.md. So everything that takes a Volume works on them: negate it once, behind all filters.
#pragma once

#include <cstdint>

#include "isoatlas/volume.h"

namespace isoatlas {

enum class Polarity : std::uint8_t { high, low };
[[nodiscard]] const char* name_of(Polarity polarity);  ///< "high", "low"

/// One side, or both.
enum class PolarityChoice : std::uint8_t { high, low, both };
[[nodiscard]] const char* name_of(PolarityChoice choice);  ///< "high", "low", "both"
[[nodiscard]] bool holds(PolarityChoice choice, Polarity polarity);

/// low: the samples were negated.
[[nodiscard]] Polarity polarity_of(const VolumeInfo& info);

/// What is added to the negative of a sample of a type: the sum of its lowest and its highest value for integers, so that no value is lost;
/// 0 for floats.
[[nodiscard]] double mirror_of(ValueType type);

/// The volume with its samples negated: `mirror_of(type) - sample`, of the same type. Its calibration maps back, so all reported values are
/// those of the file; polarity_of() is the other one. Applied twice it gives the volume again, bit for bit. Cost: O(volume), no memory.
[[nodiscard]] Volume negated(Volume volume);
/// The header of the same.
[[nodiscard]] VolumeInfo negated(VolumeInfo info);

}  // namespace isoatlas

// Units of lengths and of sample values: one name for each, and what the user says instead of the header.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "isoatlas/volume.h"

namespace isoatlas {

/// One name for each unit of length that files name in several ways: "um", "micron", "micrometres" and both letters mu become "µm" (with
/// the micro sign), "millimeter" becomes "mm", "angstrom" "Å"; "pixel" and "voxel" become "" (no unit). Others stay as they are, without
/// blanks around them. Idempotent.
[[nodiscard]] std::string unit_name(std::string_view name);

/// The same for headers that are ASCII: "um", "angstrom"; other units as they are.
[[nodiscard]] std::string ascii_unit(std::string_view name);

/// The name of the cube (square in 2D) of a unit of length: "mm³", "µm²". Without a unit "voxels" where the samples have no spacing either,
/// else "units³".
[[nodiscard]] std::string measure_unit_name(const Geometry& geometry, int rank);
/// The unit of lengths: as in the file; without one "voxels" or "units", likewise.
[[nodiscard]] std::string length_unit_name(const Geometry& geometry);

/// What the user knows better than the header. Unset members leave what the header says.
struct Corrections {
    std::optional<Vec3> spacing{};  ///< positive, or negative to turn the axis around; steps become even
    std::optional<Vec3> origin{};   ///< of sample (0, 0, 0)
    std::optional<std::string> unit{}, value_unit{};
    [[nodiscard]] bool is_empty() const { return !spacing && !origin && !unit && !value_unit; }
    bool operator==(const Corrections&) const = default;
};

/// Replaces spacing, origin and units; numbers are not converted: unit "µm" says what the numbers of the header mean. Adds a note for each
/// change to info.notes. Throws Error{usage} when a spacing is 0 or not finite.
void correct(VolumeInfo& info, const Corrections& corrections);

}  // namespace isoatlas

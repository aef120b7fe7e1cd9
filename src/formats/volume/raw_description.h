// Description of a RAW file by its sidecar and its name.
//
// Sidecar: a JSON object in foo.raw.json or foo.json beside foo.raw. Keys, all optional:
//   "dims":    [nx, ny] or [nx, ny, nz], x fastest         "endian":  "little" or "big"
//   "type":    "uint8" "int8" "uint16" "int16" "uint32" "int32" "float32" "float64" (or "u8" ... "f64", "float", "double")
//   "skip":    bytes before the samples                    "spacing": [sx, sy] or [sx, sy, sz]
//   "origin":  [ox, oy] or [ox, oy, oz]                    "unit":    of lengths, "mm"
//   "space":   what the axes mean, "LPS", "RAS", ...     "value_unit": of samples, "HU"
//
// Name: words between '_', '-' and '.', for example foo_512x512x512_float32.raw or foo_256x256x128_uint16_big.raw: sizes joined by 'x',
// a type as above, "le" / "little" / "be" / "big".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

struct RawDescription {
    std::optional<std::vector<std::int64_t>> dims;
    std::optional<ValueType> type;
    std::optional<bool> big_endian;
    std::optional<std::int64_t> skip_bytes;
    std::optional<Vec3> spacing, origin;
    std::string unit, value_unit, space;
    std::vector<std::string> notes;
};

/// The type of a name like "uint8", "u8", "float" or "float32", in any case.
[[nodiscard]] std::optional<ValueType> find_value_type(std::string_view name);

/// The description in the file name; members without one are empty.
[[nodiscard]] RawDescription description_from_name(const std::string& path);

/// Path of the sidecar of a RAW file, if there is one.
[[nodiscard]] std::optional<std::string> find_sidecar(const std::string& path);

/// Reads a sidecar. Throws Error{input} when it is not a JSON object or a key has the wrong kind of value; unknown keys become notes.
[[nodiscard]] RawDescription read_sidecar(const std::string& sidecar_path);

}  // namespace isoatlas

// Encoding of samples for a viewer: a slice as stored, a volume in one byte a value. Everything is little endian.
//
// A slice:                                                    A volume:
//   0   "ias1"                                                  0   "iav1"
//   4   columns, rows: uint32 each                              4   cubes along x, y, z: uint32 each
//   12  step between samples: uint32                            16  samples along the edge of a cube: uint32
//   16  type of a sample: uint32, 0 uint8, 1 int8, 2 uint16,    20  zero: uint32
//       3 int16, 4 uint32, 5 int32, 6 float32, 7 float64        24  low, high: float64 each, in units of the file: byte b stands for
//   20  zero: uint32                                                low + b / 255 (high - low)
//   24  slope, intercept: float64 each; a value in units of     40  a byte for each cube, the mean of its samples, x fastest
//       the file is slope * sample + intercept
//   40  samples, columns fastest
#pragma once

#include <string>

#include "isoatlas/atlas.h"

namespace isoatlas {

/// slice: a volume one sample thick along an axis, of every step-th sample. Columns run along the lower one of the other axes.
[[nodiscard]] std::string wire_slice(const Volume& slice, int axis, std::int64_t step);
/// range: the stored values of bytes 0 and 255; other values are clamped.
[[nodiscard]] std::string wire_volume(const CoarseVolume& volume, std::array<double, 2> range, const Calibration& calibration);

}  // namespace isoatlas

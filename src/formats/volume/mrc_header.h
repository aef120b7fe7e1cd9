// The header of MRC and CCP4 maps (electron microscopy, crystallography). Source: the MRC2014 format,
// https://www.ccpem.ac.uk/mrc-format/mrc2014/.
//
// Notation: columns are the fastest axis of the file, then rows, then sections. X, Y, Z are axes of space; axis[0] says along which of them
// the columns run: 0 is X.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace isoatlas {

inline constexpr std::int64_t kMrcHeaderBytes = 1024;

struct MrcHeader {
    bool big_endian = false;
    std::array<std::int64_t, 3> size{};   ///< columns, rows, sections
    int mode = 0;                         ///< type of the samples
    std::array<std::int64_t, 3> start{};  ///< of the first column, row and section, in samples
    std::array<std::int64_t, 3> cells{};  ///< samples along X, Y, Z of the unit cell (MX, MY, MZ)
    std::array<double, 3> cell{};         ///< its sides along X, Y, Z, in angstrom
    std::array<double, 3> angles{};       ///< its angles, in degrees
    std::array<int, 3> axis{};            ///< X, Y or Z of columns, rows, sections; -1: the field is not 1, 2 or 3
    int space_group = 0;                  ///< 0: a stack of images; 401 and above: a stack of volumes
    std::int64_t extended_bytes = 0;      ///< between this header and the samples
    std::array<double, 3> origin{};       ///< of the first sample, X, Y, Z in angstrom
    bool unsigned_bytes = false;          ///< IMOD: samples of mode 0
    std::string label;                    ///< the first one
};

/// The header in the first bytes of a file, in the byte order in which it makes sense: sizes from 1, a mode that exists. nullopt: there is
/// none. needs_mark: only with the letters MAP, which files before 2000 lack.
[[nodiscard]] std::optional<MrcHeader> decode_mrc(std::span<const std::byte> bytes, bool needs_mark);

}  // namespace isoatlas

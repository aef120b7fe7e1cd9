// The data arrays of VTK XML files: ascii, base64, appended raw and appended base64, each with or without blocks of zlib or LZ4.
// Source: "VTK File Formats" (Kitware), XML formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/file_system.h"
#include "formats/common/byte_source.h"
#include "formats/common/wide_integers.h"
#include "isoatlas/volume.h"

namespace isoatlas {

enum class VtkFormat : std::uint8_t { ascii, binary, appended };

enum class VtkCompressor : std::uint8_t { none, zlib, lz4 };

/// Properties of all arrays of a file.
struct VtkFile {
    std::string path;                             ///< for messages
    std::function<std::unique_ptr<File>()> open;  ///< the file, or bytes in memory
    bool big_endian = false;
    bool wide_headers = false;  ///< header_type UInt64 instead of UInt32
    VtkCompressor compressor = VtkCompressor::none;
    std::int64_t appended = -1;   ///< offset of the appended section; -1: none
    bool appended_is_raw = true;  ///< else base64
    bool skip_rest = false;       ///< an array may hold more samples than the extent
};

struct VtkArray {
    std::string name, type;  ///< as the file has them
    VtkFormat format = VtkFormat::ascii;
    std::int64_t begin = 0, end = 0;  ///< bytes of the file with the text (ascii, binary)
    std::int64_t offset = 0;          ///< in the appended section
};

/// `count` samples of this type, which the array is known to have, in the byte order of the file (ascii: of this machine). Random access
/// for appended raw. Throws Error{input}, before allocating that size, when the array cannot hold exactly `count` samples (with skip_rest:
/// at least that many). wide: the samples are integers, type is f64.
[[nodiscard]] std::unique_ptr<ByteSource> open_vtk_array(const VtkFile& file, const VtkArray& array, ValueType type, std::int64_t count,
                                                         WideInteger wide = WideInteger::none);

/// The values of an array of any numeric type. Integers are exact.
struct VtkValues {
    std::vector<double> reals;           ///< of Float32 and Float64
    std::vector<std::int64_t> integers;  ///< of the other types
    bool is_real = false;
    [[nodiscard]] std::size_t size() const { return is_real ? reals.size() : integers.size(); }
};
/// All values of an array. budget: how many values the arrays of the file may still have; bounds the memory. Throws Error: input, also for
/// more values than that; unsupported (type).
[[nodiscard]] VtkValues read_vtk_values(const VtkFile& file, const VtkArray& array, std::int64_t& budget);

/// How many bytes one compressed byte can become at most. Source: the longest match of each code over its shortest symbol.
[[nodiscard]] std::int64_t largest_vtk_ratio(VtkCompressor compressor);

/// "ascii", "base64", "raw", "raw zlib", ...: for the user.
[[nodiscard]] std::string vtk_encoding(const VtkFile& file, const VtkArray& array);

}  // namespace isoatlas

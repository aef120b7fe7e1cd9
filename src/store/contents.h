// The contents of a store: its volume, build parameters, and the location of its arrays.
//
// A store is an HDF5 file, so that other programs can open its arrays. isoatlas reads it without HDF5: the first 512 bytes (the "user
// block", which HDF5 skips) locate the contents, and the contents locate every array. docs/format.md describes both.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "isoatlas/interpolant.h"
#include "isoatlas/polarity.h"
#include "isoatlas/volume.h"
#include "store/fingerprint.h"

namespace isoatlas {

inline constexpr int kStoreVersion = 5;
inline constexpr int kFirstExactVersion = 3;  // since this version values of saddles are rounded once (critical/element_values.h)
inline constexpr int kFirstRawVersion = 5;    // since this version bricks may be raw (codec/brick_codec.h)

/// Numbers in a row of bytes, little endian, first index slowest.
struct StoredArray {
    std::string name;                 ///< path in the file, such as "tree/value"
    std::string type;                 ///< "uint8" ... "uint64", "int8" ... "int64", "float32", "float64"
    std::vector<std::int64_t> shape;  ///< no entry is negative
    std::int64_t offset = 0;          ///< of the first byte in the file
    std::int64_t block = 0;           ///< bytes under one checksum (the last block may be shorter); 0: the array has checksums of its own
    std::int64_t checksums = 0;       ///< offset of its checksums, 8 bytes a block; covered by the checksum `sum`
    std::uint64_t sum = 0;
    /// 0, or numbers in a chunk: the array is compressed chunk by chunk (codec/chunk_codec.h), a block is a chunk, and `checksums` is the
    /// offset of a StoredChunk per chunk instead.
    std::int64_t chunk = 0;

    [[nodiscard]] std::int64_t count() const;  ///< of numbers
    [[nodiscard]] std::int64_t bytes() const;
    [[nodiscard]] std::int64_t blocks() const { return block == 0 ? 0 : (bytes() + block - 1) / block; }
    /// Bytes of its block table.
    [[nodiscard]] std::int64_t index_bytes() const { return blocks() * (chunk == 0 ? 8 : 24); }
};

/// Location of a compressed chunk.
struct StoredChunk {
    std::uint64_t offset, bytes, checksum;
};

/// Build parameters of a store. The same volume and parameters give the same bytes.
struct Parameters {
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;
    std::uint64_t samples_checksum = 0;  ///< of the samples of the volume, little endian
};

struct Contents {
    int version = kStoreVersion;
    VolumeInfo volume;  ///< extent, type, geometry, calibration, value unit; path is the name of the source
    Parameters parameters;
    Fingerprint fingerprint;                           ///< empty in stores of versions 1 and 2
    bool is_replaceable = false;                       ///< built beside a page and replaceable (BuildOptions::is_replaceable)
    PolarityChoice polarities = PolarityChoice::high;  ///< whose trees and tables it holds
    std::vector<StoredArray> arrays;

    /// Throws Error{input} when there is no array of that name and type.
    [[nodiscard]] const StoredArray& array(std::string_view name, std::string_view type) const;
    [[nodiscard]] bool has_array(std::string_view name) const;
    /// Would this version compute the same numbers from the same samples? In versions 1 and 2 face and body points were rounded
    /// differently, and tables followed other rules.
    [[nodiscard]] bool has_present_values() const;
    /// The same of all but the tables of objects and cavities, whose isovalues follow the rules of their version.
    [[nodiscard]] bool has_present_trees() const;
};

/// Arrays about the negated samples have this before the names that they have of the samples.
inline constexpr std::string_view kLowGroup = "low/";
/// The contents as those of a store of one polarity alone: `low/NAME` is named NAME, and the samples count as negated. Throws Error:
/// unsupported when it does not hold that polarity.
[[nodiscard]] Contents contents_of(const Contents& whole, Polarity polarity);

/// Bytes of one number of a type; 0: no such type.
[[nodiscard]] std::int64_t size_of_type(std::string_view type);

[[nodiscard]] std::string to_json(const Contents& contents);
/// Throws Error{input} when the text is not that of a store, unsupported for a later version. Checks that every array lies inside the file.
[[nodiscard]] Contents contents_of_json(std::string_view text, const std::string& path, std::int64_t file_size);

}  // namespace isoatlas

// Headers that describe a file of samples beside them: .dat of volume libraries and Inviwo, .xml of MIPAV.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/volume/data_files.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct RawHeader {
    std::vector<std::string> files{};   ///< of time steps of equal size, or one that holds them all
    std::vector<std::int64_t> sizes{};  ///< x y z
    std::int64_t time_steps = 1, components = 1;
    std::optional<ValueType> type{};
    std::optional<bool> big_endian{};
    std::int64_t offset = 0;      ///< of the samples in each file
    std::optional<Mat3> steps{};  ///< row a: from one sample to the next along axis a
    Vec3 origin{0, 0, 0};         ///< of the first sample
    std::string unit{}, value_unit{}, description{};
    std::vector<std::string> notes{};
};

/// Throws Error: input, unsupported.
[[nodiscard]] RawHeader read_dat_header(const std::string& path);
[[nodiscard]] RawHeader read_mipav_header(const std::string& path);

/// A header beside a file (NAME.dat, NAME.xml) that describes this file alone. Throws what reading such a header does.
[[nodiscard]] std::optional<std::string> find_raw_header(const std::string& path);
/// The volume of a header of either kind.
[[nodiscard]] std::unique_ptr<VolumeReader> open_raw_header(const std::string& path, const OpenOptions& options);

}  // namespace isoatlas

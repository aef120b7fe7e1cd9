// HDF5 reads its files through the file system of the environment, and opens no file that it may not.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "base/file_system.h"
#include "formats/common/hdf5_handle.h"
#include "isoatlas/error.h"

namespace isoatlas {

/// Where HDF5 would read samples.
struct Hdf5Range {
    File* file = nullptr;
    std::uint64_t begin = 0, bytes = 0;
};

/// What one HDF5 file may open beside itself, and why the last call failed.
struct Hdf5Access {
    std::string path;
    bool follow_links = false;       ///< files outside the folder of `path` may be opened
    std::optional<Error> failure{};  ///< a file that may not be opened, is cut off, or lies on a disk that fails
    std::optional<Error> missing{};  ///< a file that cannot be opened: HDF5 looks for it in several folders
    bool is_main_open = false;
    std::map<unsigned long, std::string> names{};  ///< of all files opened so far, by the number that HDF5 gives them
    Hdf5Range* noted = nullptr;                    ///< samples are not read: where they lie is noted
    void forget() { failure.reset(), missing.reset(); }
};

/// Properties with which HDF5 opens a file, and all files that it links to. `access` must outlive them. The caller holds hdf5_mutex().
[[nodiscard]] Hdf5Handle hdf5_access_properties(Hdf5Access& access);

/// The file of the system in which an opened file of HDF5 lies, as long as that is open; nullptr: HDF5 fails.
[[nodiscard]] File* file_of_hdf5(hid_t file);

}  // namespace isoatlas

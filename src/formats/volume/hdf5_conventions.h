// Conventions of HDF5 files: where the samples of a volume are, and where they lie in space.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/volume/hdf5_file.h"

namespace isoatlas {

/// A file with the options for it. Each open_X returns nullptr when the file does not follow the convention, or options.dataset names an
/// array beside it.
struct Hdf5Request {
    std::shared_ptr<const Hdf5File> file;
    const OpenOptions& options;

    [[nodiscard]] const std::string& path() const { return file->path(); }
    /// path, file_bytes and format of the description of a volume.
    [[nodiscard]] VolumeInfo info(const char* format) const;
};

[[nodiscard]] std::unique_ptr<VolumeReader> open_imaris(const Hdf5Request& request);
[[nodiscard]] std::unique_ptr<VolumeReader> open_big_data_viewer(const Hdf5Request& request);
[[nodiscard]] std::unique_ptr<VolumeReader> open_openpmd(const Hdf5Request& request);
[[nodiscard]] std::unique_ptr<VolumeReader> open_vtkhdf_image(const Hdf5Request& request);
/// NeXus, and arrays without any convention. Never nullptr.
[[nodiscard]] std::unique_ptr<VolumeReader> open_hdf5_array(const Hdf5Request& request);

/// All arrays of numbers beneath a group, each object once, those near the root first. Links that lead nowhere, or out of the folder of the
/// file without permission, are left out, with a note.
struct Hdf5Walk {
    std::vector<Hdf5Array> arrays{};
    std::vector<std::string> notes{};
};
[[nodiscard]] Hdf5Walk walk_hdf5(const Hdf5File& file, const std::string& root);

/// Spacing, origin, directions and unit from the attributes of a mesh of openPMD, and from gridUnit, gridOrigin and gridDirection, which
/// isoatlas writes beside them. component: what has the position within the cell.
void set_openpmd_geometry(const Hdf5File& file, const std::string& mesh, const std::string& component, VolumeInfo& info);
/// "512 x 512 x 100 uint16", x first.
[[nodiscard]] std::string shape_of(const Hdf5Array& array);
/// Sizes from the one of x on.
[[nodiscard]] Index3 size_of_volume(const Hdf5Array& array);
/// The number behind a beginning: 7 of "TimePoint 7", for "TimePoint ". nullopt: none, or something else follows.
[[nodiscard]] std::optional<std::int64_t> number_behind(const std::string& name, const std::string& beginning);
/// Whether all numbers are finite, and as many as wanted.
[[nodiscard]] bool are_numbers(const std::vector<double>& numbers, std::size_t count);

}  // namespace isoatlas

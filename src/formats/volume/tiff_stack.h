// How pages of TIFF files form a volume: shared by single files, OME-TIFF data sets and folders.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "formats/volume/pixel_choice.h"
#include "formats/volume/tiff_description.h"
#include "formats/volume/tiff_file.h"

namespace isoatlas {

/// Where a slice is.
struct TiffSlice {
    std::uint32_t file = 0;       ///< among the files of the volume
    std::uint64_t directory = 0;  ///< byte offset
    std::int64_t number = 0;      ///< of the page, for messages
    std::int64_t raw = -1;        ///< byte offset of its pixels where they stand behind a single directory; else -1
};

/// Planes that differ in slice, channel and time.
struct TiffPlanes {
    std::int64_t slices = 1, times = 1;
    std::vector<std::string> channels{""};  ///< their names
    double time_increment = 0;              ///< 0: not known
    std::string time_unit{};
};
/// The chosen channel and time step; along time: all time steps of single slices are the third axis.
struct TiffChoice {
    ChannelChoice channel;
    std::int64_t time = 0;
    bool is_along_time = false;
};

/// Chooses channel, time step and value of a pixel; sets info.volumes and the extent along z. Throws Error{usage}.
[[nodiscard]] TiffChoice choose_planes(const std::string& path, const OpenOptions& options, const TiffPlanes& planes, const TiffPage& page,
                                       VolumeInfo& info);

struct TiffVolume {
    std::vector<std::string> files;
    std::vector<TiffSlice> slices;
    PixelChoice pixel;
    bool skip_rest = false;
};
/// Reads the slices, of which `page` is the first one; each is checked. Chooses the level, sets type, extent, chunk and geometry of it.
/// first: the file of the first slice, opened. Throws Error: input (slices of different size or type), usage (no such level).
[[nodiscard]] std::unique_ptr<VolumeReader> make_tiff_reader(VolumeInfo info, TiffVolume volume, std::unique_ptr<TiffFile> first,
                                                             const TiffPage& page, const OpenOptions& options);

/// The size of a reduced image gives its spacing and where its first sample lies.
[[nodiscard]] Geometry geometry_of_level(Geometry geometry, const Index3& whole, const Index3& level);

/// Voxel size from the description, else from the resolution tags, else 1. Assumptions become notes.
[[nodiscard]] Geometry tiff_geometry(const TiffTags& tags, const TiffDescription& description, std::int64_t slices,
                                     std::vector<std::string>& notes);
/// Adds notes about ignored data: colour tables, previews.
void add_tiff_notes(TiffFile& file, std::vector<std::string>& notes);

/// An OME-TIFF data set: images in this file and in files beside it.
[[nodiscard]] std::unique_ptr<VolumeReader> open_ome_tiff(VolumeInfo info, std::unique_ptr<TiffFile> file, const OpenOptions& options);

}  // namespace isoatlas

// OME-XML, the description of the images of an OME-TIFF file: https://docs.openmicroscopy.org/ome-model
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

/// A TiffData element: consecutive pages that are consecutive planes, in the order of the image's dimensions.
struct OmePages {
    std::int64_t first = 0;                     ///< page, from 0
    std::int64_t count = 0;                     ///< 0: all that there are
    std::int64_t z = 0, channel = 0, time = 0;  ///< of the first plane
    std::string file;                           ///< name of another file; empty: this one
};

struct OmeImage {
    std::string name;
    std::int64_t width = 0, height = 0;  ///< 0: not given
    std::int64_t slices = 1, channels = 1, times = 1;
    std::int64_t samples = 1;     ///< per pixel: of these channels in one plane
    std::string order = "XYZCT";  ///< of the dimensions, the fastest first
    Vec3 spacing{0, 0, 0};        ///< 0: missing
    std::string unit;             ///< of the spacing
    double time_increment = 0;    ///< 0: missing
    std::string time_unit;
    std::vector<std::string> channel_names;  ///< of the planes, as far as they are named
    std::vector<OmePages> pages;             ///< empty: the file does not say

    [[nodiscard]] std::int64_t plane_channels() const { return channels / samples; }
    [[nodiscard]] std::int64_t planes() const { return slices * plane_channels() * times; }
    /// The number of a plane, and back: slice, channel, time.
    [[nodiscard]] std::int64_t plane(const std::array<std::int64_t, 3>& at) const;
    [[nodiscard]] std::array<std::int64_t, 3> place(std::int64_t plane) const;
};

struct OmeXml {
    std::vector<OmeImage> images;
    std::string metadata_file;  ///< another file has the description
    std::string uuid;           ///< of this file
};

[[nodiscard]] bool looks_like_ome(std::string_view text);
/// own_name: of the file that the pages are in, own_uuid: where the text is that of another file. No entities are expanded.
/// Throws Error{input}: not well formed, sizes that are none, no image; a page of another file without a name.
[[nodiscard]] OmeXml parse_ome_xml(const std::string& path, std::string_view text, const std::string& own_name,
                                   const std::string& own_uuid = {});

}  // namespace isoatlas

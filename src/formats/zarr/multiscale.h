// Images of OME-NGFF (OME-Zarr), versions 0.1 to 0.5: https://ngff.openmicroscopy.org
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/zarr/key_store.h"
#include "formats/zarr/zarr_array.h"

namespace isoatlas {

/// Which axis of an array is which; -1: there is none.
struct ZarrAxes {
    int time = -1, channel = -1;
    std::array<int, 3> space{-1, -1, -1};  ///< x, y, z
    [[nodiscard]] int rank() const { return space[2] < 0 ? 2 : 3; }
};

/// Coordinates along an axis of an array: scale * index + translation.
struct LevelScale {
    double scale = 1, translation = 0;
};

struct MultiscaleLevel {
    std::string path;                  ///< of the array, in the hierarchy
    std::vector<LevelScale> scales{};  ///< of each axis; empty: the file does not say
};

struct Multiscale {
    std::string name;
    ZarrAxes axes;
    std::vector<std::string> units;       ///< of each axis
    std::vector<MultiscaleLevel> levels;  ///< at least one
    std::vector<std::string> channels;    ///< labels that the image has for its channels, if any
    Json remainder;                       ///< what isoatlas writes besides OME-Zarr, or null
    bool is_one_of_many = false;          ///< the group has several images; this is the first
};

/// The image of a group, from its attributes (ome_of()). rank: axes of its arrays, for versions that name no axes.
/// Throws Error: input, unsupported.
[[nodiscard]] Multiscale read_multiscale(const KeyStore& store, const std::string& group, const Json& ome, std::size_t rank);
/// The paths of its arrays, the finest first; empty: there are none.
[[nodiscard]] std::vector<std::string> level_paths(const std::string& group, const Json& ome);
/// Axes by their names alone: t, c, z, y, x, or "time" and "channel"; nullopt: there are others, or x and y are missing.
[[nodiscard]] std::optional<ZarrAxes> axes_of_names(const std::vector<std::string>& names);
/// Axes without names: y, x; z, y, x; t, z, y, x; t, c, z, y, x. nullopt: others.
[[nodiscard]] std::optional<ZarrAxes> axes_of_rank(std::size_t rank);

}  // namespace isoatlas

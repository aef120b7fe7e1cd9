// Filling a volume from a function of the voxel.
#pragma once

#include "isoatlas/volume.h"

namespace isoatlas {

/// A volume whose sample at (x, y, z) is value(x, y, z) rounded to T.
template <class T, class Function>
Volume fill(std::int64_t nx, std::int64_t ny, std::int64_t nz, Function&& value, const Geometry& geometry = {}) {
    const Extent extent{3, {nx, ny, nz}};
    Volume volume = make_volume(extent, value_type_of<T>, geometry);
    const std::span<T> samples = volume.samples<T>();
    std::size_t i = 0;
    for (std::int64_t z = 0; z < nz; ++z) {
        for (std::int64_t y = 0; y < ny; ++y) {
            for (std::int64_t x = 0; x < nx; ++x) samples[i++] = static_cast<T>(value(x, y, z));
        }
    }
    return volume;
}

}  // namespace isoatlas

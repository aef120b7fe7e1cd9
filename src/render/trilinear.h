// Trilinear interpolation of samples and of their central differences, at eight places at a time.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "isoatlas/volume.h"
#include "render/ray_segments.h"
#include "render/transfer.h"

namespace isoatlas {

/// The samples of a volume, and what a place among them is computed with.
template <class T>
struct PlacedSamples {
    const T* first;
    std::array<float, 3> last;
    std::array<std::int32_t, 3> last_cell;
    std::array<std::int64_t, 3> stride;  ///< between samples
    std::array<std::int64_t, 3> step;    ///< the same, 0 along an axis of one sample
};

/// Places are in samples, inside of the volume (to rounding); in single precision, as are the values, less the zero of the scale: a
/// hundred thousandth of a voxel, or of the range, is not seen. At most 2^24 samples along an axis.
template <class T>
class Trilinear {
public:
    Trilinear(const Volume& volume, const Transfer::Scale& scale);

    /// At the ends of kLanes segments of a ray, from `segment` on: t, and the place of the value in the scale.
    void places(const RaySegments& ray, std::int64_t segment, std::span<double, kLanes> t, std::span<float, kLanes> found) const;
    /// Negative central difference along each axis, over two samples; over one at the border.
    void fall(const Vec3& place, Vec3& difference) const;

private:
    PlacedSamples<T> samples_;
    Transfer::Scale scale_;
};

}  // namespace isoatlas

// Trilinear interpolation of samples and of their central differences, at eight places at a time.
#pragma once

#include <array>
#include <cstdint>

#include <span>

#include "isoatlas/volume.h"
#include "render/ray_segments.h"
#include "render/transfer.h"

namespace isoatlas {

inline constexpr std::size_t kLanes = 8;
/// A number at each of eight places. In single precision: a hundred thousandth of a voxel, or of the values, is not seen.
using EightNumbers = std::array<float, kLanes>;
/// Along x, y and z.
using EightPlaces = std::array<EightNumbers, 3>;

/// Places are in samples, inside of the volume (to rounding). Every lane is computed: those that are not needed must hold a place too.
template <class T>
class Trilinear {
public:
    /// scale: of the values that places() finds.
    Trilinear(const Volume& volume, const Transfer::Scale& scale);

    /// Values less the zero of the scale: so they keep their digits.
    void values(const EightPlaces& places, EightNumbers& found) const;
    /// At the ends of kLanes segments of a ray, from `segment` on: t and the place of the value in the scale.
    void places(const RaySegments& ray, std::int64_t segment, std::span<double, kLanes> t, std::span<float, kLanes> found) const;
    /// Negative central difference along each axis, over two samples; over one at the border.
    void fall(const Vec3& place, Vec3& difference) const;

private:
    const T* samples_;
    Transfer::Scale scale_;
    std::array<float, 3> last_;
    std::array<std::int32_t, 3> last_cell_;
    std::array<std::int64_t, 3> stride_;  ///< between samples
    std::array<std::int64_t, 3> step_;    ///< the same, 0 along an axis of one sample
};

}  // namespace isoatlas

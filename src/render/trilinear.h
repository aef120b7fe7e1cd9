// Trilinear interpolation of samples and of their central differences.
#pragma once

#include <algorithm>
#include <cstdint>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Positions are in samples, inside of the volume (to rounding).
template <class T>
class Trilinear {
public:
    explicit Trilinear(const Volume& volume) : samples_(volume.samples<T>().data()) {
        const Extent& extent = volume.info.extent;
        const std::int64_t strides[3] = {1, extent.size[0], extent.slice()};
        for (int a = 0; a < 3; ++a) {
            last_[a] = static_cast<double>(extent.size[a] - 1);
            last_cell_[a] = std::max<std::int64_t>(0, extent.size[a] - 2);
            stride_[a] = strides[a];
            step_[a] = extent.size[a] > 1 ? strides[a] : 0;
        }
    }

    [[nodiscard]] double value(const Vec3& voxel) const {
        const Place at = place(voxel);
        return interpolated(at, [&](const T* p) { return static_cast<double>(*p); });
    }

    /// Negative central difference along each axis.
    [[nodiscard]] Vec3 fall(const Vec3& voxel) const {
        const Place at = place(voxel);
        Vec3 differences{};
        for (int a = 0; a < 3; ++a) {
            if (at.cell[a] > 0 && at.cell[a] < last_cell_[a]) {
                const std::int64_t s = stride_[a];
                differences[a] =
                    interpolated(at, [&](const T* p) { return 0.5 * (static_cast<double>(p[-s]) - static_cast<double>(p[s])); });
                continue;
            }
            Vec3 before = voxel, behind = voxel;
            before[a] = std::max(0.0, voxel[a] - 1), behind[a] = std::min(last_[a], voxel[a] + 1);
            differences[a] = 0.5 * (value(before) - value(behind));
        }
        return differences;
    }

private:
    struct Place {
        const T* corner;
        std::int64_t cell[3];
        double part[3];  ///< position within the cell, 0 to 1
    };

    [[nodiscard]] Place place(const Vec3& voxel) const {
        Place at{samples_, {}, {}};
        for (int a = 0; a < 3; ++a) {
            at.cell[a] = std::min(static_cast<std::int64_t>(voxel[a]), last_cell_[a]);
            at.part[a] = voxel[a] - static_cast<double>(at.cell[a]);
            at.corner += at.cell[a] * stride_[a];
        }
        return at;
    }

    /// Interpolates the values `of` the corners of a cell.
    template <class Of>
    [[nodiscard]] double interpolated(const Place& at, const Of& of) const {
        const auto row = [&](const T* p) {
            const double low = of(p);
            return low + at.part[0] * (of(p + step_[0]) - low);
        };
        const auto plane = [&](const T* p) {
            const double low = row(p);
            return low + at.part[1] * (row(p + step_[1]) - low);
        };
        const double low = plane(at.corner);
        return low + at.part[2] * (plane(at.corner + step_[2]) - low);
    }

    const T* samples_;
    double last_[3];
    std::int64_t last_cell_[3];
    std::int64_t stride_[3];  ///< stride to the next sample
    std::int64_t step_[3];    ///< the same, 0 along an axis of one sample
};

}  // namespace isoatlas

#include "formats/volume/axes.h"

#include <algorithm>
#include <cmath>

namespace isoatlas {
namespace {

bool usable(double length) { return std::isfinite(length) && length > 0; }

/// Exact for axis-aligned steps, which std::hypot is not.
double length_of(const Vec3& step) {
    const double largest = std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2])});
    if (!usable(largest)) return largest;
    const double x = step[0] / largest, y = step[1] / largest, z = step[2] / largest;
    return largest * std::sqrt(x * x + y * y + z * z);
}

void note_unusable(VolumeInfo& info, int axis) {
    info.notes.push_back("the spacing of axis " + std::string(1, "xyz"[axis]) + " is zero or not a number: 1 was assumed");
}

}  // namespace

void set_axis_step(VolumeInfo& info, int axis, const Vec3& step) {
    const double length = length_of(step);
    if (!usable(length)) return note_unusable(info, axis);
    info.geometry.spacing[axis] = length;
    for (int row = 0; row < 3; ++row) info.geometry.direction[row][axis] = step[row] / length;
}

void set_axis_spacing(VolumeInfo& info, int axis, double spacing) {
    if (!usable(std::abs(spacing))) return note_unusable(info, axis);
    info.geometry.spacing[axis] = std::abs(spacing);
    if (spacing > 0) return;
    for (int row = 0; row < 3; ++row) {
        double& entry = info.geometry.direction[row][axis];
        entry = entry == 0 ? 0 : -entry;
    }
}

void require_frame(VolumeInfo& info) {
    constexpr double kFlattest = 1e-6;  // volume of the parallelepiped of the unit vectors; real gantry tilts stay above 0.5
    const Mat3& m = info.geometry.direction;
    const double volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    if (std::abs(volume) > kFlattest) return;
    info.geometry.direction = Geometry{}.direction;
    info.notes.push_back("the directions of the axes do not span space: the unit vectors were assumed");
}

void complete_normal(Geometry& geometry) {
    Mat3& m = geometry.direction;
    const Vec3 normal{m[1][0] * m[2][1] - m[2][0] * m[1][1], m[2][0] * m[0][1] - m[0][0] * m[2][1], m[0][0] * m[1][1] - m[1][0] * m[0][1]};
    const double length = length_of(normal);
    if (!usable(length)) return;
    for (int row = 0; row < 3; ++row) m[row][2] = normal[row] / length;
}

void set_calibration(VolumeInfo& info, double slope, double intercept) {
    if (std::isfinite(slope) && slope != 0 && std::isfinite(intercept)) {
        info.calibration = {slope, intercept};
        return;
    }
    info.notes.push_back("the calibration of the file (slope or intercept) is unusable and was ignored");
}

}  // namespace isoatlas

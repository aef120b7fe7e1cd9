// Volumes in every kind of space, and what other programs are told of it: by own arithmetic, not by the code under test.
#pragma once

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace placed_volumes {

using isoatlas::Geometry;
using isoatlas::Mat3;
using isoatlas::Vec3;

struct Placed {
    const char* name;
    Geometry geometry;
    double metres;  ///< in one unit; unknown units: a millimetre
};

/// Oblique, left-handed, sheared and unit-less, in LPS, RAS, LAS and none.
inline std::vector<Placed> placed_geometries() {
    const double c = std::cos(0.4), s = std::sin(0.4), d = std::cos(1.1), e = std::sin(1.1);
    const Mat3 straight{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const Mat3 oblique{{{c, -s * d, s * e}, {s, c * d, -c * e}, {0, e, d}}};  // a rotation
    Mat3 left_handed = oblique;
    for (Vec3& row : left_handed) row[1] = -row[1];
    const Mat3 permuted{{{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}};
    const Mat3 half_turns{{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}};  // quaternions with a = 0
    const Mat3 sheared{{{1, 0.2 / std::hypot(1, 0.2), 0}, {0, 1 / std::hypot(1, 0.2), 0}, {0, 0, 1}}};
    const auto in = [](const char* space, const char* unit, const Mat3& direction, const Vec3& origin) {
        return Geometry{
            .spacing = {0.5, 0.75, 2.5}, .origin = origin, .direction = direction, .coordinates = {}, .space = space, .unit = unit};
    };
    return {{"lps oblique", in("LPS", "mm", oblique, {-10, 20, 30.25}), 1e-3},
            {"ras oblique", in("RAS", "mm", oblique, {-10, 20, 30.25}), 1e-3},
            {"ras left-handed", in("RAS", "mm", left_handed, {100.5, -70, 3}), 1e-3},
            {"las", in("LAS", "mm", straight, {4, 5, 6}), 1e-3},
            {"las oblique", in("LAS", "um", oblique, {4, 5, 6}), 1e-6},
            {"lps permuted", in("LPS", "cm", permuted, {1, 2, 3}), 1e-2},
            {"ras half turns", in("RAS", "m", half_turns, {1, 2, 3}), 1},
            {"lps sheared", in("LPS", "mm", sheared, {1, 2, 3}), 1e-3},
            {"far away", in("RAS", "mm", straight, {1e6 + 0.1, -2e6 - 0.3, 3e6 + 0.7}), 1e-3},
            {"unit-less", in("unknown", "", left_handed, {-10, 20, 30.25}), 1e-3},
            {"nothing known", Geometry{}, 1e-3},
            {"nanometres", in("unknown", "nm", straight, {0, 0, 0}), 1e-9}};
}

/// Rows of four numbers: from voxels to physical coordinates.
using Affine = std::array<std::array<double, 4>, 3>;

inline Affine affine_of(const Geometry& geometry) {
    Affine rows{};
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) rows[row][axis] = geometry.direction[row][axis] * geometry.spacing[axis];
        rows[row][3] = geometry.origin[row];
    }
    return rows;
}

/// The same in another space of three letters, where the geometry has one.
inline Affine affine_in(const Geometry& geometry, const std::string& space) {
    Affine rows = affine_of(geometry);
    if (geometry.space.size() != 3) return rows;
    for (std::size_t row = 0; row < 3; ++row) {
        for (double& x : rows[row]) x = geometry.space[row] == space[row] ? x : -x;
    }
    return rows;
}

/// From voxels to glTF: x is left, y superior, z anterior, in metres; unknown spaces like LPS.
inline Affine affine_in_gltf(const Placed& placed) {
    const Affine lps = affine_in(placed.geometry, "LPS");
    Affine rows{};
    for (std::size_t i = 0; i < 4; ++i) {
        rows[0][i] = placed.metres * lps[0][i];
        rows[1][i] = placed.metres * lps[2][i];
        rows[2][i] = -placed.metres * lps[1][i];
    }
    return rows;
}

/// As a list of lists, for Python.
inline std::string python_text(const Affine& rows) {
    std::ostringstream text;
    text.precision(17);
    text << "[";
    for (const auto& row : rows) text << "[" << row[0] << "," << row[1] << "," << row[2] << "," << row[3] << "],";
    text << "[0,0,0,1]]";
    return text.str();
}

/// The voxel position of a physical point.
inline Vec3 voxel_of(const Affine& a, const Vec3& p) {
    const auto det = [](const Vec3& u, const Vec3& v, const Vec3& w) {
        return u[0] * (v[1] * w[2] - v[2] * w[1]) - v[0] * (u[1] * w[2] - u[2] * w[1]) + w[0] * (u[1] * v[2] - u[2] * v[1]);
    };
    std::array<Vec3, 4> columns{};  // of the three axes, and from the origin to p
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t i = 0; i < 3; ++i) columns[i][row] = a[row][i];
        columns[3][row] = p[row] - a[row][3];
    }
    const double whole = det(columns[0], columns[1], columns[2]);
    return {det(columns[3], columns[1], columns[2]) / whole, det(columns[0], columns[3], columns[2]) / whole,
            det(columns[0], columns[1], columns[3]) / whole};
}

/// A ball with a cavity in 9 x 8 x 7 samples.
inline isoatlas::Volume ball(const Geometry& geometry) {
    isoatlas::Volume volume = isoatlas::make_volume({.rank = 3, .size = {9, 8, 7}}, isoatlas::ValueType::f32, geometry);
    const auto samples = volume.samples<float>();
    for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) {
        const isoatlas::Index3 v = volume.info.extent.voxel(i);
        const double r = std::hypot(static_cast<double>(v[0]) - 4.1, static_cast<double>(v[1]) - 3.4, static_cast<double>(v[2]) - 2.9);
        samples[static_cast<std::size_t>(i)] = static_cast<float>(r < 1 ? r : 2.6 - r);
    }
    return volume;
}

}  // namespace placed_volumes

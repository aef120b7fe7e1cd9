#include "formats/volume/nifti_geometry.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/vectors.h"

namespace isoatlas {

namespace {

constexpr double kSameAngle = 1e-3;  ///< float headers are accurate to about 1e-6; scanners round more
constexpr double kSmallest = 1e-30;

bool finite(const Vec3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

/// Geometry from the columns of a voxel-to-world matrix. nullopt: not finite or singular.
std::optional<Geometry> from_columns(std::array<Vec3, 3> columns, const Vec3& origin, int rank) {
    if (rank == 2 && dot(columns[2], columns[2]) == 0) columns[2] = cross(columns[0], columns[1]);
    Geometry geometry;
    geometry.origin = origin;
    geometry.space = "RAS";
    for (int axis = 0; axis < 3; ++axis) {
        const double length = std::hypot(columns[axis][0], columns[axis][1], columns[axis][2]);
        if (!finite(columns[axis]) || !finite(origin) || !std::isfinite(length) || length < kSmallest) return std::nullopt;
        geometry.spacing[axis] = length;
        for (int row = 0; row < 3; ++row) geometry.direction[row][axis] = columns[axis][row] /= length;
    }
    const double volume = dot(columns[0], cross(columns[1], columns[2]));
    if (std::abs(volume) < 1e-6) return std::nullopt;
    return geometry;
}

bool is_sheared(const Geometry& geometry) {
    for (int axis = 0; axis < 3; ++axis) {
        double product = 0;
        for (int row = 0; row < 3; ++row) product += geometry.direction[row][axis] * geometry.direction[row][(axis + 1) % 3];
        if (std::abs(product) > kSameAngle) return true;
    }
    return false;
}

std::optional<Geometry> from_sform(const NiftiHeader& header, int rank) {
    std::array<Vec3, 3> columns{};
    Vec3 origin{};
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis) columns[axis][row] = header.rows[row][axis];
        origin[row] = header.rows[row][3];
    }
    return from_columns(columns, origin, rank);
}

double usable_spacing(double value) { return std::isfinite(value) && std::abs(value) > kSmallest ? std::abs(value) : 0; }

std::optional<Geometry> from_qform(const NiftiHeader& header, int rank) {
    const std::optional<std::array<Vec3, 3>> rotation = rotation_of_qform(header.quaternion, header.pixdim[0] < 0);
    if (!rotation) return std::nullopt;
    std::array<Vec3, 3> columns = *rotation;
    for (int axis = 0; axis < 3; ++axis) {
        double spacing = usable_spacing(header.pixdim[static_cast<std::size_t>(axis) + 1]);
        if (spacing == 0) spacing = 1;
        for (double& part : columns[axis]) part *= spacing;
    }
    return from_columns(columns, header.offset, rank);
}

/// The largest difference of the steps along an axis and of the origins, in voxels.
bool agree(const Geometry& a, const Geometry& b) {
    const double scale = *std::min_element(a.spacing.begin(), a.spacing.end());
    double difference = 0;
    for (int row = 0; row < 3; ++row) {
        difference = std::max(difference, std::abs(a.origin[row] - b.origin[row]));
        for (int axis = 0; axis < 3; ++axis) {
            difference =
                std::max(difference, std::abs(a.direction[row][axis] * a.spacing[axis] - b.direction[row][axis] * b.spacing[axis]));
        }
    }
    return difference <= 10 * kSameAngle * scale;
}

Geometry from_pixdim(const NiftiHeader& header, int rank, std::vector<std::string>& notes) {
    Geometry geometry;
    for (int axis = 0; axis < rank; ++axis) {
        const double spacing = usable_spacing(header.pixdim[static_cast<std::size_t>(axis) + 1]);
        if (spacing == 0) notes.push_back("the voxel size of axis " + std::to_string(axis) + " is not given: 1 was assumed");
        geometry.spacing[axis] = spacing == 0 ? 1 : spacing;
    }
    return geometry;
}

}  // namespace

Geometry nifti_geometry(const NiftiHeader& header, int rank, std::vector<std::string>& notes) {
    const std::optional<Geometry> sform = header.sform_code > 0 ? from_sform(header, rank) : std::nullopt;
    const std::optional<Geometry> qform = header.qform_code > 0 ? from_qform(header, rank) : std::nullopt;
    if (header.sform_code > 0 && !sform) notes.push_back("the sform of the file is singular and was ignored");
    if (header.qform_code > 0 && !qform) notes.push_back("the qform of the file is not usable and was ignored");
    if (sform && qform && !agree(*sform, *qform)) notes.push_back("sform and qform of the file differ: the sform is used");
    Geometry geometry = sform ? *sform : qform ? *qform : from_pixdim(header, rank, notes);
    if (!sform && !qform) notes.push_back("the file has no orientation: the stored axes are used");
    if (is_sheared(geometry)) notes.push_back("the axes of the file are not perpendicular (sheared sform); they are kept");
    static constexpr const char* kUnit[] = {"", "m", "mm", "um"};
    const int unit = header.units & 7;
    geometry.unit = unit <= 3 ? kUnit[unit] : "";
    return geometry;
}

std::optional<std::array<Vec3, 3>> rotation_of_qform(const Vec3& quaternion, bool is_mirrored) {
    double b = quaternion[0], c = quaternion[1], d = quaternion[2];
    const double squares = b * b + c * c + d * d;
    if (!std::isfinite(squares)) return std::nullopt;
    if (squares > 1) {
        const double length = std::sqrt(squares);
        b /= length, c /= length, d /= length;
    }
    const double a = squares > 1 ? 0 : std::sqrt(1 - squares);
    std::array<Vec3, 3> columns{{{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
                                 {2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
                                 {2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c}}};
    for (double& part : columns[2]) part *= is_mirrored ? -1 : 1;
    return columns;
}

std::optional<NiftiRotation> nifti_rotation(const Mat3& direction) {
    constexpr double kPerpendicular = 1e-6;  // a quaternion of float32 is no more accurate
    Geometry geometry;
    geometry.direction = direction;
    for (int axis = 0; axis < 3; ++axis) {
        double product = 0, squares = 0;
        for (int row = 0; row < 3; ++row) {
            product += direction[row][axis] * direction[row][(axis + 1) % 3];
            squares += direction[row][axis] * direction[row][axis];
        }
        if (!(std::abs(product) < kPerpendicular) || !(std::abs(squares - 1) < kPerpendicular)) return std::nullopt;
    }
    NiftiRotation rotation{{}, handedness(geometry) < 0};
    Mat3 r = direction;
    for (Vec3& row : r) row[2] *= rotation.is_mirrored ? -1 : 1;
    // The largest of the four numbers is at least a half: dividing by it is safe.
    const std::array<double, 4> squares{1 + r[0][0] + r[1][1] + r[2][2], 1 + r[0][0] - r[1][1] - r[2][2], 1 + r[1][1] - r[0][0] - r[2][2],
                                        1 + r[2][2] - r[0][0] - r[1][1]};
    const auto largest = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
    const double x = std::sqrt(squares[largest]) / 2, s = 1 / (4 * x);
    std::array<double, 4> q{};
    switch (largest) {
        case 0: q = {x, s * (r[2][1] - r[1][2]), s * (r[0][2] - r[2][0]), s * (r[1][0] - r[0][1])}; break;
        case 1: q = {s * (r[2][1] - r[1][2]), x, s * (r[0][1] + r[1][0]), s * (r[0][2] + r[2][0])}; break;
        case 2: q = {s * (r[0][2] - r[2][0]), s * (r[0][1] + r[1][0]), x, s * (r[1][2] + r[2][1])}; break;
        default: q = {s * (r[1][0] - r[0][1]), s * (r[0][2] + r[2][0]), s * (r[1][2] + r[2][1]), x}; break;
    }
    const double sign = q[0] < 0 ? -1 : 1;
    rotation.quaternion = {sign * q[1], sign * q[2], sign * q[3]};
    return rotation;
}

}  // namespace isoatlas

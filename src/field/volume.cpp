// The value types, extents and geometry of include/isoatlas/volume.h (everything there that reads no file).
#include "isoatlas/volume.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "base/error_free.h"

namespace isoatlas {
namespace {

double determinant_of(const Mat3& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

}  // namespace

std::size_t size_of(ValueType type) {
    static constexpr std::size_t kSize[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSize[static_cast<int>(type)];
}

const char* name_of(ValueType type) {
    static constexpr const char* kName[] = {"uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64"};
    return kName[static_cast<int>(type)];
}

bool is_floating(ValueType type) { return type == ValueType::f32 || type == ValueType::f64; }

Vec3 to_physical(const Geometry& geometry, const Vec3& voxel_position) {
    Vec3 scaled{};
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double>& coordinates = geometry.coordinates[axis];
        const double p = voxel_position[axis];
        if (coordinates.size() < 2) {
            scaled[axis] = coordinates.empty() ? geometry.spacing[axis] * p : coordinates[0] + geometry.spacing[axis] * p;
            continue;
        }
        const double last = static_cast<double>(coordinates.size() - 2);
        const auto low = static_cast<std::size_t>(std::clamp(p, 0.0, last));  // outside: the first or last interval, extrapolated
        scaled[axis] = coordinates[low] + (p - static_cast<double>(low)) * (coordinates[low + 1] - coordinates[low]);
    }
    Vec3 physical = geometry.origin;
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis) physical[row] += geometry.direction[row][axis] * scaled[axis];
    }
    return physical;
}

int handedness(const Geometry& geometry) { return determinant_of(geometry.direction) < 0 ? -1 : 1; }

double skew_of(const Geometry& geometry, int rank) {
    const Mat3& m = geometry.direction;
    const auto minor = [&m](int p, int q) { return m[p][0] * m[q][1] - m[q][0] * m[p][1]; };  // of the first two axes
    const double skew = rank == 3 ? std::abs(determinant_of(m)) : std::hypot(minor(0, 1), minor(1, 2), minor(2, 0));
    return std::abs(skew - 1) < 1e-6 ? 1 : skew;
}

double mirrored(double mirror, double value) {
    const TwoDoubles difference = two_difference(mirror, value);
    return difference.low > 0 ? std::nextafter(difference.high, std::numeric_limits<double>::infinity()) : difference.high;
}

double voxel_measure(const Geometry& geometry, const Extent& extent, std::int64_t index) {
    const Index3 position = extent.voxel(index);
    double measure = skew_of(geometry, extent.rank);
    for (int axis = 0; axis < extent.rank; ++axis) {
        const std::vector<double>& c = geometry.coordinates[axis];
        if (c.size() < 2) {
            measure *= geometry.spacing[axis];
            continue;
        }
        const auto i = static_cast<std::size_t>(position[axis]);
        const double before = i > 0 ? c[i] - c[i - 1] : c[1] - c[0];
        const double after = i + 1 < c.size() ? c[i + 1] - c[i] : c[i] - c[i - 1];
        measure *= (before + after) / 2;
    }
    return measure;
}

double Volume::value(std::int64_t index) const {
    return visit_samples(*this, [index](auto samples) { return static_cast<double>(samples[static_cast<std::size_t>(index)]); });
}

namespace {

/// A volume without samples; voxels: receives how many there are.
Volume described_volume(const Extent& extent, ValueType type, const Geometry& geometry, std::int64_t& voxels) {
    voxels = 1;
    for (const std::int64_t size : extent.size) {
        if (size < 1 || voxels > std::numeric_limits<std::int64_t>::max() / 8 / size) {
            throw Error(ErrorKind::usage, {.what = "the extent of a volume must be positive and its size must fit in 63 bits"});
        }
        voxels *= size;
    }
    Volume volume;
    volume.info.extent = extent;
    volume.info.type = type;
    volume.info.geometry = geometry;
    volume.info.format = "memory";
    volume.info.encoding = "raw";
    return volume;
}

}  // namespace

Volume make_volume(const Extent& extent, ValueType type, const Geometry& geometry) {
    std::int64_t voxels = 0;
    Volume volume = described_volume(extent, type, geometry, voxels);
    volume.bytes.resize(static_cast<std::size_t>(voxels) * size_of(type));
    return volume;
}

Volume borrow_volume(const Extent& extent, ValueType type, std::span<const std::byte> samples, std::shared_ptr<const void> owner,
                     const Geometry& geometry) {
    std::int64_t voxels = 0;
    Volume volume = described_volume(extent, type, geometry, voxels);
    if (samples.size() != static_cast<std::size_t>(voxels) * size_of(type))
        throw Error(ErrorKind::usage, {.what = "the number of samples does not match the extent"});
    if (reinterpret_cast<std::uintptr_t>(samples.data()) % size_of(type) != 0)
        throw Error(ErrorKind::usage, {.what = "the samples are not aligned for their type", .next = "copy them"});
    volume.bytes = SampleBytes(samples, std::move(owner));
    return volume;
}

}  // namespace isoatlas

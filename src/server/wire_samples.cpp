#include "server/wire_samples.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace isoatlas {
namespace {

struct SliceHeader {
    std::array<char, 4> magic{'i', 'a', 's', '1'};
    std::uint32_t columns = 0, rows = 0, step = 0, type = 0, zero = 0;
    double slope = 1, intercept = 0;
};
static_assert(sizeof(SliceHeader) == 40);

struct VolumeHeader {
    std::array<char, 4> magic{'i', 'a', 'v', '1'};
    std::array<std::uint32_t, 3> size{};
    std::uint32_t step = 0, zero = 0;
    double low = 0, high = 0;
};
static_assert(sizeof(VolumeHeader) == 40);

template <class Header>
std::string begun_with(const Header& header, std::size_t more) {
    std::string bytes(sizeof header + more, '\0');
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
}

}  // namespace

std::string wire_slice(const Volume& slice, int axis, std::int64_t step) {
    const Index3& size = slice.info.extent.size;
    SliceHeader header;
    header.columns = static_cast<std::uint32_t>(size[axis == 0 ? 1 : 0]);
    header.rows = static_cast<std::uint32_t>(size[axis == 2 ? 1 : 2]);
    header.step = static_cast<std::uint32_t>(step);
    header.type = static_cast<std::uint32_t>(slice.info.type);
    const Calibration& scale = slice.info.calibration;
    header.slope = scale.mirror ? -scale.slope : scale.slope;
    header.intercept = scale.intercept + scale.slope * scale.mirror.value_or(0);
    std::string bytes = begun_with(header, slice.bytes.size());
    std::memcpy(bytes.data() + sizeof header, slice.bytes.data(), slice.bytes.size());
    return bytes;
}

std::string wire_volume(const CoarseVolume& volume, std::array<double, 2> range, const Calibration& calibration) {
    VolumeHeader header;
    for (std::size_t a = 0; a < 3; ++a) header.size[a] = static_cast<std::uint32_t>(volume.extent.size[a]);
    header.step = static_cast<std::uint32_t>(volume.step);
    const auto [low, high] = calibration.reported_interval(range[0], range[1]);
    header.low = low, header.high = high;
    const double per_value = range[1] > range[0] ? 255 / (range[1] - range[0]) : 0;
    std::string bytes = begun_with(header, volume.mean.size());
    for (std::size_t i = 0; i < volume.mean.size(); ++i) {
        const double place = std::clamp((static_cast<double>(volume.mean[i]) - range[0]) * per_value, 0.0, 255.0);
        bytes[sizeof header + i] = static_cast<char>(static_cast<unsigned char>(std::lround(calibration.mirror ? 255 - place : place)));
    }
    return bytes;
}

}  // namespace isoatlas

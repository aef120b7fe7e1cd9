#include "render/scene_box.h"

#include <span>

namespace isoatlas {

namespace {

/// Range of visible sample positions.
template <class T>
SceneBox shown_samples(std::span<const T> samples, const Extent& extent, const std::vector<std::array<double, 2>>& values) {
    SceneBox box;
    const auto shown = [&](T sample) {
        const auto value = static_cast<double>(sample);
        return std::any_of(values.begin(), values.end(), [&](const auto& range) { return value >= range[0] && value <= range[1]; });
    };
    for (std::int64_t z = 0; z < extent.size[2]; ++z) {
        for (std::int64_t y = 0; y < extent.size[1]; ++y) {
            const std::span<const T> row = samples.subspan(extent.index(0, y, z), extent.size[0]);
            const auto first = std::find_if(row.begin(), row.end(), shown);
            if (first == row.end()) continue;
            const auto last = std::find_if(row.rbegin(), row.rend(), shown);
            const auto yz = std::array<double, 2>{static_cast<double>(y), static_cast<double>(z)};
            box.take({static_cast<double>(first - row.begin()), yz[0], yz[1]});
            box.take({static_cast<double>(row.rend() - last) - 1, yz[0], yz[1]});
        }
    }
    return box;
}

/// The rendered volume extends beyond the last visible sample, at most to the next one.
std::vector<Vec3> physical_corners(const SceneBox& box, const VolumeInfo& info) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        Vec3 corner{};
        for (int a = 0; a < 3; ++a) {
            const double reached = (i >> a & 1) != 0 ? box.high[a] + 1 : box.low[a] - 1;
            corner[a] = std::clamp(reached, 0.0, static_cast<double>(info.extent.size[a] - 1));
        }
        corners.push_back(to_physical(info.geometry, corner));
    }
    return corners;
}

}  // namespace

std::vector<Vec3> corners_of(const SceneVolume& volume) {
    if (volume.volume == nullptr) return {};
    const auto& size = volume.volume->info.extent.size;
    SceneBox box;
    box.take({0, 0, 0});
    box.take({static_cast<double>(size[0] - 1), static_cast<double>(size[1] - 1), static_cast<double>(size[2] - 1)});
    return physical_corners(box, volume.volume->info);
}

std::vector<Vec3> shown_corners_of(const SceneVolume& volume) {
    if (volume.volume == nullptr) return {};
    const VolumeInfo& info = volume.volume->info;
    const SceneBox box =
        visit_samples(*volume.volume, [&](auto samples) { return shown_samples(samples, info.extent, visible_values(volume)); });
    return box.empty() ? corners_of(volume) : physical_corners(box, info);
}

SceneBox box_of(const Scene& scene) {
    SceneBox box;
    for_each_outline_point(scene, [&](const Vec3& point) { box.take(point); });
    for (const Vec3& corner : corners_of(scene.volume)) box.take(corner);
    if (box.empty()) {
        throw Error(ErrorKind::not_found, {.what = "nothing to draw: no object has a surface at its isovalue",
                                           .next = "choose an isovalue between the lowest and the highest sample"});
    }
    return box;
}

}  // namespace isoatlas

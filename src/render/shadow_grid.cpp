#include "render/shadow_grid.h"

#include <algorithm>

#include "base/parallel.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kStep = 4;  // samples between two points of the grid

}  // namespace

ShadowGrid::ShadowGrid(const Extent& extent, const std::function<double(const Vec3&)>& light_at, int threads) {
    for (int a = 0; a < 3; ++a) count_[a] = (extent.size[a] - 1) / kStep + 2;
    light_.resize(count_.product());
    for_each_block(threads, count_[1] * count_[2], [&](std::int64_t row) {
        for (std::int64_t x = 0; x < count_[0]; ++x) {
            const std::int64_t at[3] = {x, row % count_[1], row / count_[1]};
            Vec3 voxel{};
            for (int a = 0; a < 3; ++a) voxel[a] = static_cast<double>(std::min(at[a] * kStep, extent.size[a] - 1));
            light_[row * count_[0] + x] = static_cast<float>(light_at(voxel));
        }
    });
}

double ShadowGrid::light(const Vec3& voxel) const {
    if (light_.empty()) return 1;
    std::int64_t i[3];
    double f[3];
    for (int a = 0; a < 3; ++a) {
        const double x = std::clamp(voxel[a] / kStep, 0.0, static_cast<double>(count_[a] - 1) - 1e-6);
        i[a] = std::min(static_cast<std::int64_t>(x), count_[a] - 2);
        f[a] = x - static_cast<double>(i[a]);
    }
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
        const std::int64_t at = (i[0] + (c & 1)) + count_[0] * ((i[1] + (c >> 1 & 1)) + count_[1] * (i[2] + (c >> 2)));
        sum += ((c & 1) != 0 ? f[0] : 1 - f[0]) * ((c & 2) != 0 ? f[1] : 1 - f[1]) * ((c & 4) != 0 ? f[2] : 1 - f[2]) * light_[at];
    }
    return sum;
}

}  // namespace isoatlas

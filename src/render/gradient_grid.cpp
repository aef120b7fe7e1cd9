#include "render/gradient_grid.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/target_clones.h"
#include "isoatlas/vec3.h"

namespace isoatlas {
namespace {

using Fall = float __attribute__((vector_size(16)));

template <class T>
void find_row(std::span<const T> samples, const Extent& extent, std::int64_t row, std::array<float, 4>* found) {
    const Index3 stride{1, extent.size[0], extent.slice()};
    Index3 at{0, row % extent.size[1], row / extent.size[1]};
    for (; at[0] < extent.size[0]; ++at[0]) {
        const T* sample = samples.data() + extent.index(at);
        for (int a = 0; a < 3; ++a) {
            const std::int64_t before = at[a] > 0 ? -stride[a] : 0, after = at[a] + 1 < extent.size[a] ? stride[a] : 0;
            const double difference = static_cast<double>(sample[before]) - static_cast<double>(sample[after]);
            found[at[0]][static_cast<std::size_t>(a)] = static_cast<float>(0.5 * difference);
        }
        found[at[0]][3] = 0;
    }
}

}  // namespace

GradientGrid::GradientGrid(const Volume& volume, int threads) : size_(volume.info.extent.size) {
    falls_.resize(volume.info.extent.voxels());  // touched by all threads
    visit_samples(volume, [&](auto samples) {
        for_each_block(threads, size_[1] * size_[2],
                       [&](std::int64_t row) { find_row(samples, volume.info.extent, row, falls_.data() + row * size_[0]); });
    });
}

ISOATLAS_TARGET_CLONES void GradientGrid::fall(const Vec3& place, Vec3& found) const {
    std::array<float, 3> part;
    std::array<std::int64_t, 3> step;
    std::int64_t corner = 0, stride = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t last = size_[static_cast<int>(a)] - 1;
        const auto at = std::clamp(static_cast<float>(place[static_cast<int>(a)]), 0.0F, static_cast<float>(last));
        const std::int64_t cell = std::min<std::int64_t>(static_cast<std::int32_t>(at), std::max<std::int64_t>(0, last - 1));
        part[a] = at - static_cast<float>(cell);
        corner += stride * cell, step[a] = last > 0 ? stride : 0;
        stride *= last + 1;
    }
    const std::array<float, 4>* first = falls_.data() + corner;
    const auto row = [&](std::int64_t offset) __attribute__((always_inline)) {
        const auto low = __builtin_bit_cast(Fall, first[offset]), high = __builtin_bit_cast(Fall, first[offset + step[0]]);
        return low + part[0] * (high - low);
    };
    const Fall front_low = row(0), front = front_low + part[1] * (row(step[1]) - front_low);
    const Fall back_low = row(step[2]), back = back_low + part[1] * (row(step[1] + step[2]) - back_low);
    const Fall fall = front + part[2] * (back - front);
    for (int c = 0; c < 3; ++c) found[c] = static_cast<double>(fall[c]);
}

}  // namespace isoatlas

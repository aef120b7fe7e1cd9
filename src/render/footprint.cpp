#include "render/footprint.h"

#include <cmath>

namespace isoatlas {
namespace {

/// Blocks in groups of at most kGroups along an axis.
class BlockGroups {
public:
    BlockGroups(const EmptySpaceGrid& blocks, const Extent& extent) : blocks_(blocks), extent_(extent) {
        const Index3& count = blocks.count();
        side_ = (std::ranges::max(count) + kGroups - 1) / kGroups;
        for (int a = 0; a < 3; ++a) groups_[a] = (count[a] + side_ - 1) / side_;
    }
    [[nodiscard]] const Index3& count() const { return groups_; }
    [[nodiscard]] bool visible(const Index3& group) const {
        const Index3& count = blocks_.count();
        const auto end = [&](int a) { return std::min(count[a], (group[a] + 1) * side_); };
        for (std::int64_t z = group[2] * side_; z < end(2); ++z) {
            for (std::int64_t y = group[1] * side_; y < end(1); ++y) {
                for (std::int64_t x = group[0] * side_; x < end(0); ++x) {
                    if (blocks_.visible({x, y, z})) return true;
                }
            }
        }
        return false;
    }
    /// The sample at a corner of groups: `corner` groups after the first sample.
    [[nodiscard]] Vec3 sample(const Index3& corner) const {
        Vec3 place{};
        for (int a = 0; a < 3; ++a) place[a] = static_cast<double>(std::min(extent_.size[a] - 1, corner[a] * side_ * BlockRanges::kSide));
        return place;
    }

private:
    static constexpr std::int64_t kGroups = 32;
    const EmptySpaceGrid& blocks_;
    const Extent& extent_;
    std::int64_t side_ = 1;  ///< blocks
    Index3 groups_{};
};

}  // namespace

void Footprint::mark(double left, double top, double right, double bottom) {
    const auto square = [](double pixel, std::int64_t count) {
        return static_cast<std::int64_t>(std::clamp(std::floor(pixel / static_cast<double>(kSide)), -1.0, static_cast<double>(count)));
    };
    if (!(left <= right && top <= bottom)) return mark_all();
    const std::int64_t first = std::max<std::int64_t>(0, square(left - 1, across_)),
                       last = std::min(across_ - 1, square(right + 1, across_));
    const std::int64_t end = std::min(down_ - 1, square(bottom + 1, down_));
    if (first > last) return;
    for (std::int64_t row = std::max<std::int64_t>(0, square(top - 1, down_)); row <= end; ++row)
        std::fill_n(marked_.begin() + row * across_ + first, last - first + 1, std::uint8_t{1});
}

Footprint footprint_of(const EmptySpaceGrid& blocks, const VolumeInfo& info, const CameraRays& camera) {
    Footprint found(camera.width(), camera.height());
    const BlockGroups groups(blocks, info.extent);
    const Index3 count = groups.count(), corners{count[0] + 1, count[1] + 1, count[2] + 1};
    const auto corner = [&](std::int64_t x, std::int64_t y, std::int64_t z) { return x + corners[0] * (y + corners[1] * z); };
    std::vector<Vec3> projected(corners.product());
    for (std::int64_t i = 0; i < corners.product(); ++i) {
        const Index3 at{i % corners[0], i / corners[0] % corners[1], i / corners[0] / corners[1]};
        projected[i] = camera.project(to_physical(info.geometry, groups.sample(at)));
    }
    for (std::int64_t i = 0; i < count.product(); ++i) {
        const Index3 at{i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
        if (!groups.visible(at)) continue;
        Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
        for (int k = 0; k < 8; ++k) {
            const Vec3& point = projected[corner(at[0] + (k & 1), at[1] + (k >> 1 & 1), at[2] + (k >> 2))];
            for (int a = 0; a < 3; ++a) low[a] = std::min(low[a], point[a]), high[a] = std::max(high[a], point[a]);
        }
        if (!(high[2] < 0.999 * camera.eye_depth())) found.mark_all();
        found.mark(low[0], low[1], high[0], high[1]);
    }
    return found;
}

}  // namespace isoatlas

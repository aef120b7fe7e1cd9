// Which pixels can show anything of a medium: the others are not traced.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "render/camera_rays.h"
#include "render/empty_space.h"

namespace isoatlas {

/// Squares of pixels of a picture; one is marked if something may be seen in it.
class Footprint {
public:
    Footprint(std::int64_t width, std::int64_t height)
        : across_(squares(width)), down_(squares(height)), marked_(static_cast<std::size_t>(across_ * down_), 0) {}

    /// Marks the squares of a rectangle of pixels, and those a pixel around it. Not a number: all.
    void mark(double left, double top, double right, double bottom);
    void mark_all() { std::ranges::fill(marked_, std::uint8_t{1}); }
    [[nodiscard]] bool shows(std::int64_t x, std::int64_t y) const { return marked_[x / kSide + across_ * (y / kSide)] != 0; }

private:
    static constexpr std::int64_t kSide = 4;  ///< pixels
    static std::int64_t squares(std::int64_t pixels) { return (pixels + kSide - 1) / kSide; }

    std::int64_t across_, down_;
    std::vector<std::uint8_t> marked_;
};

/// The pixels whose rays may pass a block in which something is visible; all if one is beside or behind the eye. Cost: O(blocks).
Footprint footprint_of(const EmptySpaceGrid& blocks, const VolumeInfo& info, const CameraRays& camera);

}  // namespace isoatlas

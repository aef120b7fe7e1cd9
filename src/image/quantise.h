// Colour quantisation: a palette of 255 colours for some pictures.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isoatlas/image.h"

namespace isoatlas {

class Quantiser {
public:
    /// Median cut over all frames: the box of colours with the largest variance is cut at its mean until there are 255.
    explicit Quantiser(std::span<const Image> frames);

    [[nodiscard]] const std::vector<std::array<std::uint8_t, 3>>& colours() const { return colours_; }
    /// Palette index of a pixel at (x, y). Ordered dithering, so that static parts do not flicker.
    [[nodiscard]] std::uint8_t index(const std::uint8_t* pixel, std::int64_t x, std::int64_t y) const;

private:
    std::vector<std::array<std::uint8_t, 3>> colours_;
    std::vector<std::uint8_t> nearest_;  ///< for every colour of 5 bits a channel
    double spread_ = 0;                  ///< of the dithering
};

}  // namespace isoatlas

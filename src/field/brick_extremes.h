// Places of the extremes of a brick: with them representatives of components are found without its samples.
// In the literature: min-max blocks (Wilhelms, Van Gelder, Octrees for faster isosurface generation, 1992).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace isoatlas {

/// Places among the samples of a brick, x fastest. Ties as in the total order (field/order.h): of the highest the last, of the lowest the
/// first one.
struct ExtremePlaces {
    std::uint16_t highest = 0, lowest = 0;
    friend bool operator==(const ExtremePlaces&, const ExtremePlaces&) = default;
};

/// At most 65536 samples, at least one.
template <class T>
[[nodiscard]] ExtremePlaces extreme_places(std::span<const T> samples) {
    std::size_t highest = 0, lowest = 0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i] >= samples[highest]) highest = i;
        if (samples[i] < samples[lowest]) lowest = i;
    }
    return {static_cast<std::uint16_t>(highest), static_cast<std::uint16_t>(lowest)};
}

}  // namespace isoatlas

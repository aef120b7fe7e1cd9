// Tunnels through cells by shape (docs/theory/6-interior.md): counting them in a volume, making cells that have one.
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include "isoatlas/volume.h"

namespace oracle {

/// By the numbers of the cases of Marching Cubes 33.
inline constexpr std::array<const char*, 6> kTunnelShapes{"4", "6", "12.1", "10.1", "13.5", "7.4"};

/// How many cells have an open tunnel of each shape at tau.
std::array<std::int64_t, 6> count_tunnels(const isoatlas::Volume& volume, double tau);

/// A cell with a tunnel that is open for low < tau <= high, and of the wanted shape in the middle. Its samples lie in -1..1.
struct TunnelSample {
    std::array<double, 8> value;
    double low, high;
};
TunnelSample random_tunnel(int shape, bool joins_highs, std::mt19937_64& random);

}  // namespace oracle

// The dissertation's running example (figures 3.10 and 12.1): two rings that become plates, pillars, walls, a cavity.
#include <algorithm>
#include <array>
#include <cmath>

#include "phantom/fill.h"
#include "phantom/makers.h"

namespace isoatlas {
namespace {

bool within(std::int64_t v, std::int64_t low, std::int64_t high) { return low <= v && v <= high; }

/// A ring of two sticks and two connectors around a plate; `lower` is how much darker the lower ring is.
int ring_value(std::int64_t x, std::int64_t y, int lower) {
    int value = 56 - (lower / 2);
    if (within(y, 15, 17)) value = 58 - (lower / 2);
    if (within(y, 6, 8)) value = 60 - (lower / 2);
    if (within(x, 15, 17)) value = 90 - lower;
    if (within(x, 6, 8)) value = 100 - lower;
    return value;
}

int plateau_value(std::int64_t x, std::int64_t y, std::int64_t z) {
    const bool ring = within(x, 6, 17) && within(y, 6, 17);
    if (ring && within(z, 6, 7)) return ring_value(x, y, 0);
    if (ring && within(z, 16, 17)) return ring_value(x, y, 20);
    if (within(z, 8, 15)) {
        if (within(y, 10, 13) && within(x, 6, 8)) return 40;
        if (within(y, 10, 13) && within(x, 15, 17)) return 38;
        if (within(x, 9, 14) && within(y, 9, 14)) return 20;
    }
    return within(x, 4, 19) && within(y, 4, 19) && within(z, 6, 17) ? 30 : 0;
}

/// A box (possibly flat) whose value is height + slope . |distance from the middle of the box, per axis| on it and falls by 20
/// per voxel of L1 distance from it.
struct Feature {
    std::array<int, 3> low, high;
    double height;
    std::array<double, 3> slope;
};

constexpr double kOn = 0.1;  // gentle slope along a feature

// Sticks fall from their middle, connectors and plates rise from theirs: one maximum, saddle or disc-closing point each.
// The pillars' walls fall sideways from the pillar and stay above the front and back wall that they frame.
constexpr std::array<Feature, 14> kFeatures{{
    {{6, 6, 8}, {6, 24, 8}, 100, {0, -kOn, 0}},
    {{24, 6, 8}, {24, 24, 8}, 90, {0, -kOn, 0}},
    {{6, 6, 22}, {6, 24, 22}, 80, {0, -kOn, 0}},
    {{24, 6, 22}, {24, 24, 22}, 70, {0, -kOn, 0}},
    {{6, 6, 8}, {24, 6, 8}, 60, {kOn, 0, 0}},
    {{6, 24, 8}, {24, 24, 8}, 58, {kOn, 0, 0}},
    {{6, 6, 22}, {24, 6, 22}, 50, {kOn, 0, 0}},
    {{6, 24, 22}, {24, 24, 22}, 48, {kOn, 0, 0}},
    {{6, 6, 8}, {24, 24, 8}, 56, {kOn, kOn, 0}},
    {{6, 6, 22}, {24, 24, 22}, 46, {kOn, kOn, 0}},
    {{6, 6, 8}, {6, 24, 22}, 40, {0, -0.3, kOn}},
    {{24, 6, 8}, {24, 24, 22}, 38, {0, -0.3, kOn}},
    {{6, 6, 8}, {24, 6, 22}, 30, {kOn, 0, kOn}},
    {{6, 24, 8}, {24, 24, 22}, 29.5, {kOn, 0, kOn}},
}};

double feature_value(const Feature& feature, const std::array<double, 3>& p) {
    double value = feature.height;
    for (int a = 0; a < 3; ++a) {
        const double low = feature.low[a], high = feature.high[a];
        const double nearest = std::clamp(p[a], low, high);
        value += feature.slope[a] * std::fabs(nearest - (low + high) / 2) - 20 * std::fabs(p[a] - nearest);
    }
    return value;
}

double smooth_value(const std::array<double, 3>& p) {
    double value = feature_value(kFeatures[0], p);
    for (const Feature& feature : kFeatures) value = std::max(value, feature_value(feature, p));
    const bool inside = p[0] > 6 && p[0] < 24 && p[1] > 6 && p[1] < 24 && p[2] > 8 && p[2] < 22;
    if (inside) value = std::max(value, 20 + 0.2 * (std::fabs(p[0] - 15) + std::fabs(p[1] - 15) + std::fabs(p[2] - 15)));
    return value + 1e-3 * (1.3 * p[0] + 0.71 * p[1] + 0.37 * p[2]);  // no two values of the figure are equal
}

}  // namespace

Volume figure_plateau() { return fill<std::uint8_t>(24, 24, 24, plateau_value); }

Volume figure_smooth() {
    return fill<float>(32, 32, 32, [](std::int64_t x, std::int64_t y, std::int64_t z) {
        return smooth_value({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    });
}

}  // namespace isoatlas

// Transfer function derived from the table of objects.
#include <algorithm>
#include <cmath>

#include "isoatlas/render.h"

namespace isoatlas {

namespace {

constexpr double kWidth = 0.10;                       // width of a tent, in parts of the range
constexpr double kBefore = 0.15;                      // of it lies below the isovalue: an object is what is at or above its isovalue
constexpr double kRamp = 0.3;                         // of it rises, and as much falls
constexpr double kLeastDense = 0.05, kDensest = 1.0;  // extinction per voxel of the tents of the lowest and the highest isovalue
constexpr double kBodyDepth = 0.5;                    // optical depth of a cube of a body as large as the object

/// An object of the table at its best isovalue.
struct Best {
    double tau, next;  ///< range of its own values
    double size;       ///< edge of a cube as large as the object, physical
    std::int64_t rank;
};

/// The lowest isovalue above tau of another entry of the table; the maximum of the object, if there is none.
double next_above(const ObjectTable& table, const ObjectEntry& entry) {
    double next = entry.appears;
    const auto consider = [&](double tau) {
        if (tau > entry.best_tau) next = std::min(next, tau);
    };
    for (const ObjectEntry& other : table.entries) consider(other.best_tau);
    for (const RecommendedIsovalue& isovalue : isovalues_of(table.isovalues, entry.branch_top.number())) consider(isovalue.tau);
    return next;
}

/// By ascending isovalue.
std::vector<Best> best_isovalues(const ObjectTable& table, const Extent& extent, double range) {
    std::vector<Best> best;
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const ObjectEntry& entry = table.entries[i];
        const bool known =
            std::any_of(best.begin(), best.end(), [&](const Best& b) { return std::abs(b.tau - entry.best_tau) < kWidth / 2 * range; });
        if (known || (table.entries.size() > 1 && is_background(table, i, extent))) continue;
        best.push_back({.tau = entry.best_tau,
                        .next = next_above(table, entry),
                        .size = std::cbrt(entry.measure),
                        .rank = static_cast<std::int64_t>(best.size())});
    }
    std::sort(best.begin(), best.end(), [](const Best& a, const Best& b) { return a.tau < b.tau; });
    return best;
}

/// ramp: in values.
OpacityTent bump_between(double low, double high, double ramp, double density, const Best& of, std::int64_t first_colour) {
    return {.low = low,
            .high = high,
            .colour = palette(first_colour + of.rank),
            .density = density,
            .ramp = std::min(0.5, ramp / (high - low)),
            .tau = of.tau};
}

}  // namespace

std::vector<OpacityTent> propose_transfer(const ObjectTable& table, const VolumeInfo& info, std::array<double, 2> range,
                                          std::int64_t first_colour) {
    const double width = kWidth * (range[1] - range[0]), ramp = kRamp * width;
    const std::vector<Best> best = best_isovalues(table, info.extent, range[1] - range[0]);
    const double voxel = std::min({info.geometry.spacing[0], info.geometry.spacing[1], info.geometry.spacing[2]});
    std::vector<OpacityTent> tents;
    for (std::size_t i = 0; i < best.size(); ++i) {
        const bool last = i + 1 == best.size();
        const double part = best.size() > 1 ? static_cast<double>(i) / static_cast<double>(best.size() - 1) : 0.5;
        const double low = best[i].tau - kBefore * width, skin = low + width;
        // The last one has no inner entry: it is solid.
        const double high = last ? std::max(skin, range[1] + ramp) : std::min(skin, best[i + 1].tau);
        const double density = kLeastDense * std::pow(kDensest / kLeastDense, part) / voxel;
        tents.push_back(bump_between(low, high, ramp, density, best[i], first_colour));
        const double body = std::min(density, kBodyDepth / best[i].size);
        if (best[i].next > high + ramp) tents.push_back(bump_between(low, best[i].next, ramp, body, best[i], first_colour));
    }
    return tents;
}

}  // namespace isoatlas

#include "render/transfer.h"

#include <algorithm>
#include <cmath>

#include "render/colours.h"

namespace isoatlas {
namespace render {

Transfer::Transfer(std::span<const TransferBump> bumps, double length_unit) {
    for (const TransferBump& bump : bumps) {
        const double ramp = std::clamp(bump.ramp, 0.0, 0.5) * (bump.high - bump.low);
        parts_.push_back({bump.low, bump.low + ramp, bump.high - ramp, bump.high, bump.density * length_unit, linear(bump.colour)});
    }
}

double Transfer::Part::at(double value) const {
    if (value < low || value > high) return 0;
    if (value < rise) return density * (value - low) / (rise - low);
    return value > fall ? density * (high - value) / (high - fall) : density;
}

double Transfer::Part::integral(double value) const {
    const double v = std::clamp(value, low, high);
    double sum = 0;
    if (v > low) sum += rise > low ? (std::min(v, rise) - low) * (std::min(v, rise) - low) / (2 * (rise - low)) : 0;
    if (v > rise) sum += std::min(v, fall) - rise;
    if (v > fall && high > fall) sum += ((high - fall) * (high - fall) - (high - v) * (high - v)) / (2 * (high - fall));
    return density * sum;
}

Matter Transfer::mean(double a, double b) const {
    Matter matter;
    const double low = std::min(a, b), high = std::max(a, b);
    for (const Part& part : parts_) {
        if (high < part.low || low > part.high) continue;
        const bool flat = high - low < 1e-9 * (part.high - part.low);
        const double extinction = flat ? part.at((low + high) / 2) : (part.integral(high) - part.integral(low)) / (high - low);
        matter.extinction += extinction;
        matter.glow = along(matter.glow, extinction, part.colour);
    }
    return matter;
}

bool Transfer::visible(double low, double high) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return high >= part.low && low <= part.high; });
}

}  // namespace render

std::vector<TransferBump> propose_transfer(const ObjectTable& table, const VolumeInfo& info, std::array<double, 2> range) {
    struct Best {
        double tau;
        std::int64_t rank;
    };
    constexpr double kWidth = 0.05, kThinnest = 0.06, kDensest = 1.2;  // of the range; per voxel
    std::vector<Best> best;
    for (const ObjectEntry& entry : table.entries) {
        const bool known = std::any_of(best.begin(), best.end(),
                                       [&](const Best& b) { return std::abs(b.tau - entry.best_tau) < kWidth * (range[1] - range[0]); });
        if (!known) best.push_back({entry.best_tau, static_cast<std::int64_t>(best.size())});
    }
    std::sort(best.begin(), best.end(), [](const Best& a, const Best& b) { return a.tau < b.tau; });
    const double voxel = std::min({info.geometry.spacing[0], info.geometry.spacing[1], info.geometry.spacing[2]});
    std::vector<TransferBump> bumps;
    for (std::size_t i = 0; i < best.size(); ++i) {
        const double part = best.size() > 1 ? static_cast<double>(i) / static_cast<double>(best.size() - 1) : 0.5;
        const double half = kWidth * (range[1] - range[0]);
        const bool last = i + 1 == best.size();
        bumps.push_back({.low = best[i].tau - half,
                         .high = last ? std::max(best[i].tau + half, range[1]) : best[i].tau + half,
                         .colour = palette(best[i].rank),
                         .density = kThinnest * std::pow(kDensest / kThinnest, part) / voxel,
                         .ramp = last ? std::min(0.5, half / (std::max(best[i].tau + half, range[1]) - best[i].tau + half)) : 0.5});
    }
    return bumps;
}

}  // namespace isoatlas

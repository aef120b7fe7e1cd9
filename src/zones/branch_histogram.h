// Counts of voxels by height along one branch: how its volume depends on the isovalue.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace isoatlas {

/// 256 bins. Integer samples with a small range get one bin a value, cut half way between values.
struct BranchHistogram {
    std::int64_t branch;
    double low, high;
    std::vector<double> added;  ///< per bin: voxels that join its object there, going down

    BranchHistogram(std::int64_t of, double from, double to, bool integer) : branch(of), low(from), high(to), added(kBins, 0) {
        if (!integer || to - from > static_cast<double>(kBins)) return;
        low += 0.5, high += 0.5;
        added.assign(static_cast<std::size_t>(std::max(1.0, to - from)), 0);
    }
    void add(double height, double count) { added[bin(height)] += count; }
    [[nodiscard]] std::size_t bin(double height) const {
        const double range = high - low;  // 0: a constant volume
        const double bin = range > 0 && std::isfinite(range) ? (height - low) / range * static_cast<double>(added.size()) : 0;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(added.size() - 1)));
    }
    [[nodiscard]] double width() const { return (high - low) / static_cast<double>(added.size()); }

private:
    static constexpr std::size_t kBins = 256;
};

}  // namespace isoatlas

// Counts of voxels by height along one branch: how its volume depends on the isovalue.
// In the literature: the volume curve of a contour spectrum, of one branch (Bajaj, Pascucci, Schikore, The contour spectrum, 1997).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "field/axis_scale.h"
#include "isoatlas/id.h"

namespace isoatlas {

/// Equal steps of heights (analysis/object_tree.h), as equal steps of isovalues are.
struct HeightAxis {
    double lowest = 0;  ///< stored value
    double bend = 0;    ///< as in AxisScale; 0: positions are heights
    double sign = 1;    ///< of ObjectTree

    HeightAxis(const AxisScale& scale, double of_side) : lowest(scale.low), bend(scale.bend), sign(of_side) {}
    [[nodiscard]] double position(double height) const { return bend > 0 ? sign * std::asinh((sign * height - lowest) / bend) : height; }
    [[nodiscard]] double height(double position) const { return bend > 0 ? sign * (lowest + bend * std::sinh(sign * position)) : position; }
};

/// 256 bins, equal on the axis. Integer samples with a small range get one bin a value, cut half way between values.
struct BranchHistogram {
    BranchId branch;
    HeightAxis axis;
    double low, high;           ///< positions on the axis
    std::vector<double> added;  ///< per bin: voxels that join its object there, going down

    /// from, to: heights.
    BranchHistogram(BranchId of, double from, double to, bool integer, const HeightAxis& on) : branch(of), axis(on), added(kBins, 0) {
        if (integer && to - from <= static_cast<double>(kBins)) {
            axis.bend = 0;
            low = from + 0.5, high = to + 0.5;
            added.assign(static_cast<std::size_t>(std::max(1.0, to - from)), 0);
            return;
        }
        if (integer) straighten(from, to);
        low = axis.position(from), high = axis.position(to);
    }
    void add(double height, double count) { added[bin(height)] += count; }
    [[nodiscard]] std::size_t bin(double height) const {
        const double range = high - low;  // 0: a constant volume
        const double bin =
            range > 0 && std::isfinite(range) ? (axis.position(height) - low) / range * static_cast<double>(added.size()) : 0;
        return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(added.size() - 1)));
    }
    /// Of what is counted, with each bin in its middle: sum of (its height - that height).
    [[nodiscard]] double hypervolume_above(double height) const {
        double sum = 0;
        for (std::size_t i = bin(height); i < added.size(); ++i)
            sum += added[i] * std::max(0.0, axis.height(low + (static_cast<double>(i) + 0.5) * width()) - height);
        return sum;
    }
    [[nodiscard]] double width() const { return (high - low) / static_cast<double>(added.size()); }

private:
    static constexpr std::size_t kBins = 256;

    /// So that no bin is narrower than the step from one value to the next: gaps between values are no boundaries.
    void straighten(double from, double to) {
        while (axis.bend > 0 && axis.bend * (axis.position(to) - axis.position(from)) < static_cast<double>(kBins)) axis.bend *= 2;
    }
};

}  // namespace isoatlas

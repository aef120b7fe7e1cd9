// Equal steps along the axis of isovalues: linear, or finer towards the low end where nearly all samples lie (PET).
#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "field/volume_view.h"
#include "isoatlas/bounds.h"

namespace isoatlas {

/// Linear; or, where nearly all samples lie in a small part of the range, equal steps of asinh((tau - low) / bend): linear near the low
/// end, logarithmic beyond the bend.
struct AxisScale {
    double low = 0, high = 0;  ///< stored values
    double bend = 0;           ///< 0: linear

    /// 0 at low, 1 at high.
    [[nodiscard]] double position(double tau) const {
        if (!(high > low)) return 0;
        return bend > 0 ? std::asinh((tau - low) / bend) / std::asinh((high - low) / bend) : (tau - low) / (high - low);
    }
    [[nodiscard]] double tau(double position) const {
        return bend > 0 ? low + bend * std::sinh(position * std::asinh((high - low) / bend)) : low + position * (high - low);
    }
};

/// Where samples are counted for axis_scale(): from low to high, finer towards low. Empty: no range, or none that is finite.
[[nodiscard]] std::vector<double> axis_edges(double low, double high);

/// counts: of samples between neighbours of axis_edges(), with both ends of the range. Bent when 19 of 20 samples (those next to the lowest
/// value aside) lie in the lowest tenth of the range; the bend is about their median.
[[nodiscard]] AxisScale axis_scale(double low, double high, std::span<const std::int64_t> counts);

/// The same from bounds: at_least[i]: of the number of samples of at least axis_edges()[i]. Empty where they leave open which scale it is.
[[nodiscard]] std::optional<AxisScale> axis_scale(double low, double high, std::span<const Bounds> at_least);

/// From at most about 10^6 samples on a fixed pattern. Cost: O(voxels) for the range.
[[nodiscard]] AxisScale axis_scale(const VolumeView& volume);

}  // namespace isoatlas

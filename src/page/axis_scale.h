// Where isovalues lie on the axis of a page.
#pragma once

#include <cmath>

#include "isoatlas/atlas.h"

namespace isoatlas::page {

/// Linear; or, where nearly all samples lie in a small part of the range (PET), equal steps of asinh((tau - low) / bend): linear near the
/// low end, logarithmic beyond the bend.
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

/// Bent when 19 of 20 samples (those next to the lowest value aside) lie in the lowest tenth of the range; the bend is about their median.
[[nodiscard]] AxisScale axis_scale(const Atlas& atlas, const Context& context = {});

}  // namespace isoatlas::page

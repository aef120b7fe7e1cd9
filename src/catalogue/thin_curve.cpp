#include "catalogue/thin_curve.h"

#include <cmath>

namespace isoatlas {

SelectionCurve thin_curve(const SelectionCurve& curve, std::int64_t points) {
    if (static_cast<std::int64_t>(curve.kept.size()) <= points) return curve;
    SelectionCurve thin{curve.size, {}, {}, curve.automatic_threshold, curve.automatic_kept};
    const double step = std::log(static_cast<double>(curve.kept.back())) / static_cast<double>(points - 2);
    double next = 0;
    for (std::size_t i = 0; i < curve.kept.size(); ++i) {
        const double at = std::log(static_cast<double>(curve.kept[i]));
        if (at < next && i + 1 < curve.kept.size()) continue;
        thin.threshold.push_back(curve.threshold[i]);
        thin.kept.push_back(curve.kept[i]);
        next = (std::floor(at / step) + 1) * step;
    }
    return thin;
}

}  // namespace isoatlas

#include "page/axis_scale.h"

#include <algorithm>
#include <vector>

namespace isoatlas::page {

AxisScale axis_scale(const Volume& volume, double low, double high) {
    constexpr std::size_t kLooked = 100000;
    std::vector<double> above;
    visit_samples(volume, [&](auto samples) {
        const std::size_t step = std::max<std::size_t>(1, samples.size() / kLooked);
        for (std::size_t v = 0; v < samples.size(); v += step) {
            if (static_cast<double>(samples[v]) > low) above.push_back(static_cast<double>(samples[v]) - low);
        }
    });
    AxisScale scale{low, high, 0};
    if (above.empty()) return scale;
    std::ranges::sort(above);
    const double most = above[above.size() * 19 / 20], middle = above[above.size() / 2];
    if (most < (high - low) / 10 && std::isfinite(high - low)) scale.bend = middle;
    return scale;
}

}  // namespace isoatlas::page

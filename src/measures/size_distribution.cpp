#include <algorithm>
#include <cmath>

#include "isoatlas/measures.h"

namespace isoatlas {
namespace {

/// The first of ascending diameters up to which the parts sum up to at least a fraction of all. share: of each diameter.
template <class Share>
SizeQuantiles quantiles_of(const std::vector<std::array<double, 2>>& sizes, const Share& share) {
    double all = 0;
    for (const auto& size : sizes) all += share(size);
    SizeQuantiles quantiles{};
    double sum = 0;
    std::size_t next = 0;
    for (const auto& size : sizes) {
        sum += share(size);
        while (next < quantiles.size() && sum >= kSizeFractions[next] * all) quantiles[next++] = size[0];
    }
    while (next < quantiles.size()) quantiles[next++] = sizes.back()[0];  // sums differ by rounding
    return quantiles;
}

}  // namespace

SizeDistribution size_distribution(std::span<const ObjectMeasures> objects) {
    SizeDistribution result;
    if (objects.empty()) return result;
    std::vector<std::array<double, 2>> sizes;
    for (const ObjectMeasures& object : objects) sizes.push_back({object.equivalent_diameter, object.volume});
    std::ranges::sort(sizes);
    const auto count = static_cast<double>(sizes.size());
    result.objects = std::ssize(sizes);
    result.min = sizes.front()[0], result.max = sizes.back()[0];
    for (const auto& size : sizes) result.mean += size[0] / count;
    double squares = 0;
    for (const auto& size : sizes) squares += (size[0] - result.mean) * (size[0] - result.mean);
    result.deviation = std::sqrt(squares / count);
    result.by_number = quantiles_of(sizes, [](const auto&) { return 1.0; });
    result.by_volume = quantiles_of(sizes, [](const auto& size) { return size[1]; });
    return result;
}

}  // namespace isoatlas

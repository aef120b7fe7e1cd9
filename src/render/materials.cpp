// Materials by their distribution of values: percentages, and their transfer function.
#include <algorithm>
#include <cmath>

#include "isoatlas/render.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kPoints = 1024;  // of a curve
constexpr double kTransparent = 1e-3;   // of the densest material: lower density is transparent, so that rays skip it

void check(std::span<const Material> materials) {
    for (const Material& material : materials) {
        if (std::isfinite(material.mean) && std::isfinite(material.sigma) && material.sigma > 0 && material.density >= 0) continue;
        throw Error(ErrorKind::usage, {.what = "the distribution of the material \"" + material.name + "\" is not valid",
                                       .expected = "a finite mean, a standard deviation above 0, a density of at least 0"});
    }
}

}  // namespace

std::vector<double> material_percentages(std::span<const Material> materials, double value) {
    check(materials);
    std::vector<double> percentages;  // log probabilities first: far from every mean the probabilities underflow to 0
    for (const Material& material : materials) {
        const double distance = (value - material.mean) / material.sigma;
        percentages.push_back(-0.5 * distance * distance - std::log(material.sigma));
    }
    if (percentages.empty()) return percentages;
    const double max = *std::max_element(percentages.begin(), percentages.end());
    double sum = 0;
    for (double& p : percentages) sum += p = std::exp(p - max);
    for (double& p : percentages) p /= sum;
    return percentages;
}

std::vector<TransferCurve> material_transfer(std::span<const Material> materials, std::array<double, 2> range) {
    std::vector<TransferCurve> curves;
    double densest = 0;
    for (const Material& material : materials) {
        curves.push_back({.points = {}, .colour = material.colour, .name = material.density > 0 ? material.name : ""});
        densest = std::max(densest, material.density);
    }
    for (std::int64_t i = 0; i <= kPoints; ++i) {
        const double value = range[0] + (range[1] - range[0]) * static_cast<double>(i) / kPoints;
        const std::vector<double> percentages = material_percentages(materials, value);
        for (std::size_t m = 0; m < curves.size(); ++m) {
            const double density = percentages[m] * materials[m].density;
            curves[m].points.push_back({value, density < kTransparent * densest ? 0 : density});
        }
    }
    return curves;
}

}  // namespace isoatlas

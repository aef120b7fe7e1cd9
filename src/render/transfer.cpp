#include "render/transfer.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "render/colours.h"

namespace isoatlas {
namespace render {

namespace {

/// A trapezoid over the values.
TransferCurve curve_of(const TransferBump& bump) {
    const double ramp = std::clamp(bump.ramp, 0.0, 0.5) * (bump.high - bump.low);
    return {.points = {{bump.low, 0}, {bump.low + ramp, bump.density}, {bump.high - ramp, bump.density}, {bump.high, 0}},
            .colour = bump.colour,
            .name = bump.name};
}

/// Integrals of a curve over the values from its first point on, asked for with rising values.
class Integral {
public:
    explicit Integral(const TransferCurve& curve) : points_(curve.points) {}
    double to(double value) {
        while (next_ < points_.size() && points_[next_][0] <= value) {
            if (next_ > 0) sum_ += (points_[next_][0] - points_[next_ - 1][0]) * (points_[next_][1] + points_[next_ - 1][1]) / 2;
            ++next_;
        }
        if (next_ == 0 || next_ == points_.size()) return sum_;
        const auto& [v, d] = points_[next_ - 1];
        const auto& [v_next, d_next] = points_[next_];
        return sum_ + (value - v) * (d + (d_next - d) * (value - v) / (v_next - v) / 2);
    }

private:
    std::span<const std::array<double, 2>> points_;
    std::size_t next_ = 0;
    double sum_ = 0;
};

}  // namespace

Transfer::Transfer(const SceneVolume& volume, double length_unit, std::array<double, 2> range)
    : low_(range[0]), places_per_value_(range[1] > range[0] ? kPlaces / (range[1] - range[0]) : 1), sums_(kPlaces + 1) {
    for (const TransferBump& bump : volume.bumps) add(curve_of(bump), length_unit);
    for (const TransferCurve& curve : volume.curves) add(curve, length_unit);
    next_visible_.assign(kPlaces + 1, static_cast<double>(kPlaces));
    for (std::int64_t i = kPlaces - 1; i >= 0; --i)
        next_visible_[i] = sums_[i + 1][0] != sums_[i][0] ? static_cast<double>(i) : next_visible_[i + 1];
}

void Transfer::add(const TransferCurve& curve, double length_unit) {
    const Vec3 colour = linear(curve.colour);
    Integral integral(curve);
    const double first = integral.to(low_);
    for (std::int64_t i = 0; i <= kPlaces; ++i) {
        const double sum = length_unit * (integral.to(low_ + static_cast<double>(i) / places_per_value_) - first);
        sums_[i][0] += sum;
        for (int c = 0; c < 3; ++c) sums_[i][c + 1] += sum * colour[c];
    }
}

Matter Transfer::mean_between(double low, double high) const {
    // Closer together than a place, the sums would be lost in rounding: then over some to both sides.
    if (high - low < 1e-3) {
        low = std::max(0.0, low - kWidening);
        high = std::min(high + kWidening, static_cast<double>(kPlaces));
    }
    const auto i = std::min(static_cast<std::int64_t>(low), kPlaces - 1), j = std::min(static_cast<std::int64_t>(high), kPlaces - 1);
    const double f = low - static_cast<double>(i), g = high - static_cast<double>(j), part = places_per_value_ / (high - low);
    const Sums &from = sums_[i], &from_next = sums_[i + 1], &to = sums_[j], &to_next = sums_[j + 1];
    Sums mean;
    for (int c = 0; c < 4; ++c) mean[c] = part * ((to[c] + g * (to_next[c] - to[c])) - (from[c] + f * (from_next[c] - from[c])));
    return {mean[0], {mean[1], mean[2], mean[3]}};
}

}  // namespace render

namespace {

constexpr double kWidth = 0.10;                     // of a bump, in parts of the range
constexpr double kBefore = 0.15;                    // of it lies below the isovalue: an object is what is at or above its isovalue
constexpr double kMostVoxels = 0.5;                 // of the volume: what takes more is the background
constexpr double kThinnest = 0.05, kDensest = 1.0;  // extinction per voxel of the lowest and the highest isovalue

struct Best {
    double tau;
    std::int64_t rank;
};

std::vector<Best> best_isovalues(const ObjectTable& table, const VolumeInfo& info, double range) {
    std::vector<Best> best;
    for (const ObjectEntry& entry : table.entries) {
        const bool background = static_cast<double>(entry.voxels) > kMostVoxels * static_cast<double>(info.extent.voxels());
        const bool known =
            std::any_of(best.begin(), best.end(), [&](const Best& b) { return std::abs(b.tau - entry.best_tau) < kWidth / 2 * range; });
        if (!background && !known) best.push_back({entry.best_tau, static_cast<std::int64_t>(best.size())});
    }
    std::sort(best.begin(), best.end(), [](const Best& a, const Best& b) { return a.tau < b.tau; });
    return best;
}

}  // namespace

std::vector<std::array<double, 2>> visible_values(const SceneVolume& volume) {
    std::vector<std::array<double, 2>> values;
    // What stands in one place of a table with something visible is visible.
    const double place = volume.range ? ((*volume.range)[1] - (*volume.range)[0]) / render::Transfer::kPlaces : 0;
    for (const TransferBump& bump : volume.bumps) values.push_back({bump.low, bump.high});
    for (const TransferCurve& curve : volume.curves) {
        for (std::size_t i = 1; i < curve.points.size(); ++i) {
            const auto& [low, before] = curve.points[i - 1];
            const auto& [high, behind] = curve.points[i];
            if (before <= 0 && behind <= 0) continue;
            if (!values.empty() && values.back()[1] == low)
                values.back()[1] = high;
            else
                values.push_back({low, high});
        }
    }
    for (auto& [low, high] : values) low -= 2 * place, high += 2 * place;
    return values;
}

std::vector<TransferBump> propose_transfer(const ObjectTable& table, const VolumeInfo& info, std::array<double, 2> range,
                                           std::int64_t first_colour) {
    const double width = kWidth * (range[1] - range[0]);
    const std::vector<Best> best = best_isovalues(table, info, range[1] - range[0]);
    const double voxel = std::min({info.geometry.spacing[0], info.geometry.spacing[1], info.geometry.spacing[2]});
    std::vector<TransferBump> bumps;
    for (std::size_t i = 0; i < best.size(); ++i) {
        const bool last = i + 1 == best.size();
        const double part = best.size() > 1 ? static_cast<double>(i) / static_cast<double>(best.size() - 1) : 0.5;
        const double low = best[i].tau - kBefore * width, narrow = low + width;
        const double high = last ? std::max(narrow, range[1] + 0.3 * width) : std::min(narrow, best[i + 1].tau);
        bumps.push_back({.low = low,
                         .high = high,
                         .colour = palette(first_colour + best[i].rank),
                         .density = kThinnest * std::pow(kDensest / kThinnest, part) / voxel,
                         .ramp = 0.3 * width / (high - low) < 0.5 ? 0.3 * width / (high - low) : 0.5,
                         .tau = best[i].tau});
    }
    return bumps;
}

}  // namespace isoatlas

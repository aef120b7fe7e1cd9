#include "render/transfer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <string>

#include "base/target_clones.h"
#include "render/colours.h"

namespace isoatlas {

namespace {

/// A point of a curve: extinction and glow at a value.
struct Node {
    double value;
    std::array<double, 4> at;
};

std::vector<Node> nodes_of(const TransferCurve& curve, double length_unit) {
    if (!curve.colours.empty() && curve.colours.size() != curve.points.size())
        throw Error(ErrorKind::usage, {.what = "a transfer curve of " + std::to_string(curve.points.size()) + " points has " +
                                               std::to_string(curve.colours.size()) + " colours",
                                       .expected = "a colour for each point, or none"});
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Vec3 colour = linear(curve.colours.empty() ? curve.colour : curve.colours[i]);
        const double extinction = length_unit * curve.points[i][1];
        nodes.push_back({curve.points[i][0], {extinction, extinction * colour[0], extinction * colour[1], extinction * colour[2]}});
    }
    return nodes;
}

/// A trapezoid over the values.
TransferCurve curve_of(const OpacityTent& bump) {
    const double ramp = std::clamp(bump.ramp, 0.0, 0.5) * (bump.high - bump.low);
    return {.points = {{bump.low, 0}, {bump.low + ramp, bump.density}, {bump.high - ramp, bump.density}, {bump.high, 0}},
            .colour = bump.colour,
            .name = bump.name};
}

/// Integrals of a curve over the values from its first point on, evaluated at ascending values.
class Integral {
public:
    explicit Integral(std::span<const Node> nodes) : nodes_(nodes) {}
    std::array<double, 4> to(double value) {
        while (next_ < nodes_.size() && nodes_[next_].value <= value) {
            if (next_ > 0) sum_ = sum_to(nodes_[next_].value);
            ++next_;
        }
        return next_ == 0 || next_ == nodes_.size() ? sum_ : sum_to(value);
    }

private:
    /// To a value between the last node and the next one.
    [[nodiscard]] std::array<double, 4> sum_to(double value) const {
        const Node &last = nodes_[next_ - 1], &next = nodes_[next_];
        const double width = value - last.value, share = next.value > last.value ? width / (next.value - last.value) : 0;
        std::array<double, 4> sum = sum_;
        for (std::size_t c = 0; c < 4; ++c) sum[c] += width * (last.at[c] + (next.at[c] - last.at[c]) * share / 2);
        return sum;
    }

    std::span<const Node> nodes_;
    std::size_t next_ = 0;
    std::array<double, 4> sum_{};
};

using Doubles = double __attribute__((vector_size(32)));

/// 1 - exp(-x) for x >= 0, to 1e-8.
[[gnu::always_inline]] inline double swallowed(double x) {
    if (x > 0.125) return 1 - std::exp(-x);
    return x * (1 - x * (1.0 / 2) * (1 - x * (1.0 / 3) * (1 - x * (1.0 / 4) * (1 - x * (1.0 / 5)))));
}

}  // namespace

double extinction_of(double opacity, double length) { return -std::log1p(-opacity) / length; }

Transfer::Transfer(const SceneVolume& volume, double length_unit, std::array<double, 2> range)
    : low_(range[0]), places_per_value_(range[1] > range[0] ? kPlaces / (range[1] - range[0]) : 1), sums_(kPlaces + 1) {
    for (const OpacityTent& bump : volume.tents) add(curve_of(bump), length_unit);
    for (const TransferCurve& curve : volume.curves) add(curve, length_unit);
    next_visible_.assign(kPlaces + 1, static_cast<std::uint16_t>(kPlaces));
    for (std::int64_t i = kPlaces - 1; i >= 0; --i)
        next_visible_[i] = sums_[i + 1][0] != sums_[i][0] ? static_cast<std::uint16_t>(i) : next_visible_[i + 1];
}

void Transfer::add(const TransferCurve& curve, double length_unit) {
    const std::vector<Node> nodes = nodes_of(curve, length_unit);
    Integral integral(nodes);
    const Sums first = integral.to(low_);
    for (std::int64_t i = 0; i <= kPlaces; ++i) {
        const Sums sum = integral.to(low_ + static_cast<double>(i) / places_per_value_);
        for (std::size_t c = 0; c < 4; ++c) sums_[i][c] += sum[c] - first[c];
    }
}

[[gnu::always_inline]] inline void Transfer::mean_between(double low, double high, Sums& mean) const {
    // Closer than one table entry, differences of the sums would be lost in rounding: then averages over neighbouring entries.
    if (high - low < 1e-3) {
        low = std::max(0.0, low - kWidening);
        high = std::min(high + kWidening, static_cast<double>(kPlaces));
    }
    const auto i = std::min(static_cast<std::int64_t>(low), kPlaces - 1), j = std::min(static_cast<std::int64_t>(high), kPlaces - 1);
    const double f = low - static_cast<double>(i), g = high - static_cast<double>(j), part = places_per_value_ / (high - low);
    const auto from = __builtin_bit_cast(Doubles, sums_[i]), from_next = __builtin_bit_cast(Doubles, sums_[i + 1]),
               to = __builtin_bit_cast(Doubles, sums_[j]), to_next = __builtin_bit_cast(Doubles, sums_[j + 1]);
    const Doubles found = part * ((to + g * (to_next - to)) - (from + f * (from_next - from)));
    __builtin_memcpy(mean.data(), &found, sizeof found);
}

OpticalProperties Transfer::mean(double a, double b) const {
    const double low = std::min(a, b), high = std::max(a, b);
    if (high < static_cast<double>(next_visible_[static_cast<std::int64_t>(low)])) return {};
    Sums mean;
    mean_between(low, high, mean);
    return {mean[0], {mean[1], mean[2], mean[3]}};
}

ISOATLAS_TARGET_CLONES unsigned Transfer::lights(const SegmentEnds& ends, std::span<SegmentLight, kLanes> found) const {
    const auto& [t, places, count] = ends;
    unsigned bits = 0;
    for (std::size_t i = 0; i < kLanes; ++i) {
        const float low = std::min(places[i], places[i + 1]), high = std::max(places[i], places[i + 1]);
        bits |= (high < static_cast<float>(next_visible_[static_cast<std::int32_t>(low)]) ? 0U : 1U) << i;
    }
    bits &= (1U << count) - 1;
    for (unsigned left = bits; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        const auto a = static_cast<double>(places[i]), b = static_cast<double>(places[i + 1]);
        Sums mean;
        mean_between(std::min(a, b), std::max(a, b), mean);
        if (!(mean[0] > 0)) {
            bits &= ~(1U << i);
            continue;
        }
        const double per_extinction = 1 / mean[0];
        found[i] = {swallowed(mean[0] * (t[i + 1] - t[i])), {mean[1] * per_extinction, mean[2] * per_extinction, mean[3] * per_extinction}};
    }
    return bits;
}

std::vector<std::array<double, 2>> visible_values(const SceneVolume& volume) {
    std::vector<std::array<double, 2>> values;
    // Values that share a table entry with visible ones count as visible.
    const double place = volume.range ? ((*volume.range)[1] - (*volume.range)[0]) / Transfer::kPlaces : 0;
    for (const OpacityTent& bump : volume.tents) values.push_back({bump.low, bump.high});
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

}  // namespace isoatlas

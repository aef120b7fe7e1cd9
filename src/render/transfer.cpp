#include "render/transfer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
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

constexpr double kTooClose = 1e-3;  // table positions

constexpr double kLittle = 0.125;
/// 1 - exp(-x) for 0 <= x <= kLittle, to 1e-8.
[[gnu::always_inline]] inline double swallowed_little(double x) {
    return x * (1 - x * (1.0 / 2) * (1 - x * (1.0 / 3) * (1 - x * (1.0 / 4) * (1 - x * (1.0 / 5)))));
}

}  // namespace

double extinction_of(double opacity, double length) { return -std::log1p(-opacity) / length; }

Transfer::Transfer(const SceneVolume& volume, double length_unit, std::array<double, 2> range)
    : low_(range[0]), places_per_value_(range[1] > range[0] ? kPlaces / (range[1] - range[0]) : 1), sums_(kPlaces + 1) {
    for (const OpacityTent& bump : volume.tents) add(curve_of(bump), length_unit);
    for (const TransferCurve& curve : volume.curves) add(curve, length_unit);
    sums_.push_back(sums_.back());
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

[[gnu::always_inline]] inline void Transfer::sums_at(std::int32_t entry, double part, FourDoubles& sums) const {
    const auto from = __builtin_bit_cast(FourDoubles, sums_[entry]), to = __builtin_bit_cast(FourDoubles, sums_[entry + 1]);
    sums = from + part * (to - from);
}

[[gnu::always_inline]] inline void Transfer::mean_between(double low, double high, FourDoubles& mean) const {
    // Closer than one table entry, differences of the sums would be lost in rounding: then averages over neighbouring entries.
    if (high - low < kTooClose) {
        low = std::max(0.0, low - kWidening);
        high = std::min(high + kWidening, static_cast<double>(kPlaces));
    }
    FourDoubles from, to;
    const auto i = static_cast<std::int32_t>(low), j = static_cast<std::int32_t>(high);
    sums_at(i, low - static_cast<double>(i), from), sums_at(j, high - static_cast<double>(j), to);
    mean = places_per_value_ / (high - low) * (to - from);
}

OpticalProperties Transfer::mean(double a, double b) const {
    const double low = std::min(a, b), high = std::max(a, b);
    if (high < static_cast<double>(next_visible_[static_cast<std::int64_t>(low)])) return {};
    FourDoubles mean;
    mean_between(low, high, mean);
    return {mean[0], {mean[1], mean[2], mean[3]}};
}

[[gnu::always_inline]] inline unsigned Transfer::visible_between(const EightIntegers& first, const EightIntegers& second) const {
    alignas(32) std::array<std::int32_t, kLanes> low, high;
    const EightIntegers least = first < second ? first : second, most = first < second ? second : first;
    std::memcpy(low.data(), &least, sizeof least), std::memcpy(high.data(), &most, sizeof most);
    unsigned bits = 0;
    for (std::size_t i = 0; i < kLanes; ++i) bits |= static_cast<unsigned>(high[i] >= next_visible_[low[i]]) << i;
    return bits;
}

ISOATLAS_TARGET_CLONES unsigned Transfer::lights(const SegmentEnds& ends, SegmentLights& found) const {
    const auto& [t, places, count] = ends;
    EightFloats last;  // ends of segments; read as they were written: their begins would wait for the memory
    std::memcpy(&last, places.data() + 1, sizeof last);
    const EightIntegers end = __builtin_convertvector(last, EightIntegers), front = EightIntegers{} + static_cast<std::int32_t>(places[0]),
                        begin = __builtin_shufflevector(front, end, 0, 8, 9, 10, 11, 12, 13, 14);
    unsigned bits = visible_between(begin, end) & ((1U << count) - 1);
    if (bits == 0) return 0;
    const EightFloats part = last - __builtin_convertvector(end, EightFloats);
    std::array<double, kLanes> depth;
    FourDoubles before, there;
    sums_at(front[0], static_cast<double>(places[0] - static_cast<float>(front[0])), before);
    for (std::size_t i = 0; i < kLanes; ++i, before = there) {
        sums_at(end[i], static_cast<double>(part[i]), there);
        const FourDoubles sums = there - before;
        depth[i] = sums[0] / static_cast<double>(places[i + 1] - places[i]) * (places_per_value_ * (t[i + 1] - t[i]));
        found.colour[i] = sums * (1 / sums[0]);
    }
    for (unsigned left = bits; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        const auto a = static_cast<double>(places[i]), b = static_cast<double>(places[i + 1]);
        if (std::abs(b - a) < kTooClose) {
            FourDoubles mean;
            mean_between(std::min(a, b), std::max(a, b), mean);
            depth[i] = mean[0] * (t[i + 1] - t[i]), found.colour[i] = mean * (1 / mean[0]);
        }
        if (!(depth[i] > 0)) bits &= ~(1U << i);
    }
    for (std::size_t i = 0; i < kLanes; ++i) found.opacity[i] = swallowed_little(depth[i]);
    for (unsigned left = bits; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        if (depth[i] > kLittle) found.opacity[i] = 1 - std::exp(-depth[i]);
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

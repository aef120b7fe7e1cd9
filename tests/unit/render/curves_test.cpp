// Opacity curves: what they absorb and glow, against their integrals; the sum of tents as curves with a colour for each point.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "isoatlas/render.h"
#include "render/colours.h"
#include "render/transfer.h"

namespace isoatlas {
namespace {

constexpr std::array<double, 2> kRange{0, 100};

Colour any_colour() { return {*rc::gen::inRange(0, 256) / 255.0, *rc::gen::inRange(0, 256) / 255.0, *rc::gen::inRange(0, 256) / 255.0}; }

OpacityTent any_tent() {
    const double low = *rc::gen::inRange(-20, 100), width = *rc::gen::inRange(1, 60);
    return {.low = low,
            .high = low + width,
            .colour = any_colour(),
            .density = *rc::gen::inRange(1, 100) / 50.0,
            .ramp = *rc::gen::inRange(0, 6) / 10.0};
}

/// Extinction of a tent at a value, approached from one side.
double extinction_at(const OpacityTent& tent, double value, bool from_above) {
    const double ramp = tent.ramp * (tent.high - tent.low);
    if (value < tent.low || value > tent.high || value == (from_above ? tent.high : tent.low)) return 0;
    return ramp > 0 ? tent.density * std::min({1.0, (value - tent.low) / ramp, (tent.high - value) / ramp}) : tent.density;
}

/// The sum of tents as one curve: a point on both sides of every place where a tent has a corner.
TransferCurve sum_of(const std::vector<OpacityTent>& tents) {
    std::vector<double> corners;
    for (const OpacityTent& tent : tents) {
        const double ramp = tent.ramp * (tent.high - tent.low);
        for (const double corner : {tent.low, tent.low + ramp, tent.high - ramp, tent.high}) corners.push_back(corner);
    }
    std::sort(corners.begin(), corners.end());
    TransferCurve curve;
    for (const double corner : corners) {
        for (const bool from_above : {false, true}) {
            double extinction = 0;
            Vec3 glow{};
            for (const OpacityTent& tent : tents) {
                const double part = extinction_at(tent, corner, from_above);
                extinction += part, glow = along(glow, part, linear(tent.colour));
            }
            const Vec3 light = extinction > 0 ? scale(glow, 1 / extinction) : Vec3{};
            curve.points.push_back({corner, extinction});
            curve.colours.push_back({to_srgb(light[0]), to_srgb(light[1]), to_srgb(light[2])});
        }
    }
    return curve;
}

RC_GTEST_PROP(Curves, TheSumOfTentsIsOneCurveWithColours, ()) {
    std::vector<OpacityTent> tents(static_cast<std::size_t>(*rc::gen::inRange(1, 6)));
    for (OpacityTent& tent : tents) tent = any_tent();
    const Transfer of_tents({.tents = tents}, 1, kRange), of_curve({.curves = {sum_of(tents)}}, 1, kRange);
    for (int i = 0; i < 100; ++i) {
        const double low = i * Transfer::kPlaces / 100.0, high = std::min(low + *rc::gen::inRange(1, 100), 1.0 * Transfer::kPlaces);
        const OpticalProperties a = of_tents.mean(low, high), b = of_curve.mean(low, high);
        RC_ASSERT(std::abs(a.extinction - b.extinction) < 1e-9);
        for (int c = 0; c < 3; ++c) RC_ASSERT(std::abs(a.glow[c] - b.glow[c]) < 1e-6);
    }
}

TEST(Curves, ExtinctionAndGlowAreLinearBetweenPoints) {
    const TransferCurve curve{.points = {{20, 0.1}, {60, 0.5}}, .colours = {{1, 0, 0}, {0, 0, 1}}};
    const Transfer transfer({.curves = {curve}}, 1, kRange);
    for (const double value : {25.0, 40.0, 59.0}) {
        const double share = (value - 20) / 40, place = transfer.place(value);
        const OpticalProperties there = transfer.mean(place - 1, place + 1);
        EXPECT_NEAR(there.extinction, 0.1 + 0.4 * share, 1e-6) << value;
        EXPECT_NEAR(there.glow[0], 0.1 * (1 - share), 1e-6) << value;
        EXPECT_NEAR(there.glow[2], 0.5 * share, 1e-6) << value;
    }
    EXPECT_EQ(transfer.mean(transfer.place(0), transfer.place(19)).extinction, 0);
    EXPECT_EQ(transfer.mean(transfer.place(61), transfer.place(100)).extinction, 0);
}

TEST(Curves, OneColourForAllPointsIsTheColourOfTheCurve) {
    const std::vector<std::array<double, 2>> points{{10, 0}, {10, 0.3}, {70, 0.1}, {90, 0}};
    const Transfer one({.curves = {{.points = points, .colour = {0.2, 0.5, 0.9}}}}, 1, kRange);
    const Transfer each({.curves = {{.points = points, .colours = std::vector<Colour>(4, Colour{0.2, 0.5, 0.9})}}}, 1, kRange);
    for (double place = 0; place < 4000; place += 37.5) {
        EXPECT_EQ(one.mean(place, place + 20).extinction, each.mean(place, place + 20).extinction);
        EXPECT_EQ(one.mean(place, place + 20).glow, each.mean(place, place + 20).glow);
    }
}

/// Places of segments: among them equal ones, and ones closer than a table entry.
RC_GTEST_PROP(Curves, SegmentsSwallowWhatTheirMeanSays, ()) {
    std::vector<OpacityTent> tents(static_cast<std::size_t>(*rc::gen::inRange(1, 4)));
    for (OpacityTent& tent : tents) tent = any_tent();
    const Transfer transfer({.tents = tents}, 1, kRange);
    SegmentEnds ends{.t = {}, .count = static_cast<std::size_t>(*rc::gen::inRange(1, 9))};
    for (std::size_t i = 0; i <= kLanes; ++i) {
        ends.t[i] = i == 0 ? 0 : ends.t[i - 1] + *rc::gen::inRange(0, 40) * 0.05;
        ends.place[i] = static_cast<float>(*rc::gen::inRange(0, 1 + static_cast<int>(Transfer::kPlaces) * 4)) / 4;
        if (i > 0 && *rc::gen::inRange(0, 4) == 0) ends.place[i] = ends.place[i - 1];
    }
    SegmentLights lights;
    const unsigned visible = transfer.lights(ends, lights);
    for (std::size_t i = 0; i < kLanes; ++i) {
        const OpticalProperties mean = transfer.mean(static_cast<double>(ends.place[i]), static_cast<double>(ends.place[i + 1]));
        const bool swallows = i < ends.count && mean.extinction > 0 && ends.t[i] < ends.t[i + 1];
        RC_ASSERT((visible >> i & 1) == (swallows ? 1U : 0U));
        if ((visible >> i & 1) == 0) continue;
        RC_ASSERT(std::abs(lights.opacity[i] + std::expm1(-mean.extinction * (ends.t[i + 1] - ends.t[i]))) < 1e-7);
        for (int c = 0; c < 3; ++c) RC_ASSERT(std::abs(lights.colour[i][c + 1] * mean.extinction - mean.glow[c]) < 1e-9);
    }
}

TEST(Curves, ColoursAreOneForEachPointOrNone) {
    const TransferCurve curve{.points = {{20, 0.1}, {60, 0.5}}, .colours = {{1, 0, 0}}};
    EXPECT_THROW(Transfer({.curves = {curve}}, 1, kRange), Error);
}

TEST(Curves, OpacityIsOfALength) {
    for (const double opacity : {0.0, 0.01, 0.5, 0.999}) {
        for (const double length : {0.5, 1.0, 3.2}) {
            EXPECT_NEAR(1 - std::exp(-length * extinction_of(opacity, length)), opacity, 1e-12);
            const double twice = 1 - std::exp(-2 * length * extinction_of(opacity, length));
            EXPECT_NEAR(twice, 1 - (1 - opacity) * (1 - opacity), 1e-12);
        }
    }
}

}  // namespace
}  // namespace isoatlas

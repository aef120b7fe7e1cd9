// Saddles inside cells against 1,000 bits: whether there is one, and its value, rounded down once.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "critical/bodies.h"
#include "oracle/rational.h"
#include "oracle/saddle.h"

namespace isoatlas {
namespace {

class ExactSaddles : public testing::Test {
protected:
    double uniform() { return std::uniform_real_distribution<>(0, 1)(random_); }
    double below(std::uint64_t n) { return static_cast<double>(random_() % n); }

    CellValues cell_of(const std::function<double()>& sample) {
        CellValues cell{};
        for (double& v : cell) v = sample();
        return cell;
    }

    void expect_exact(const std::function<double()>& sample, int trials = 3000) {
        int found = 0;
        for (int i = 0; i < trials; ++i) {
            const CellValues cell = cell_of(sample);
            for (const SaddleKind kind : {SaddleKind::joins_highs, SaddleKind::joins_lows}) {
                const std::optional<BodySaddle> saddle = body_saddle(cell, kind);
                const std::optional<oracle::CellSaddle> expected = oracle::saddle_in_cell(cell, kind == SaddleKind::joins_highs);
                ASSERT_EQ(exactly_has_saddle(cell, kind), saddle.has_value()) << testing::PrintToString(cell);
                if (expected && !expected->is_certain) continue;  // on the border, up to 400 bits
                ASSERT_EQ(saddle.has_value(), expected.has_value()) << testing::PrintToString(cell);
                if (!saddle) continue;
                ++found;
                ASSERT_EQ(saddle->value, expected->value) << testing::PrintToString(cell);
                ASSERT_EQ(exact_saddle_value(cell, kind, cell[0]), expected->value) << testing::PrintToString(cell);
                for (const double x : saddle->position) ASSERT_TRUE(x > 0 && x < 1);
            }
        }
        EXPECT_GT(found, trials / 100);
    }

    /// All 48 ways to turn and mirror a cell.
    static std::vector<CellValues> copies(const CellValues& cell) {
        std::vector<CellValues> all;
        std::array<int, 3> axes{0, 1, 2};
        do {
            for (int mirrored = 0; mirrored < 8; ++mirrored) {
                CellValues copy{};
                for (int k = 0; k < 8; ++k) {
                    const int to = (k & 1) << axes[0] | (k >> 1 & 1) << axes[1] | (k >> 2) << axes[2];
                    copy[to ^ mirrored] = cell[k];
                }
                all.push_back(copy);
            }
        } while (std::next_permutation(axes.begin(), axes.end()));
        return all;
    }
    std::mt19937_64 random_{20261122};
};

TEST_F(ExactSaddles, OfSmallIntegers) {
    expect_exact([&] { return below(4); });
    expect_exact([&] { return below(9); });
    expect_exact([&] { return below(256); });
    expect_exact([&] { return below(65536) - 32768; });
}
TEST_F(ExactSaddles, OfWideSamples) {
    expect_exact([&] { return static_cast<double>(static_cast<float>(uniform())); });
    expect_exact([&] { return uniform(); });
    expect_exact([&] { return below(std::uint64_t{1} << 32); });
    expect_exact([&] { return std::ldexp(uniform(), static_cast<int>(random_() % 20)); });
}
TEST_F(ExactSaddles, WithAnOffset) {
    for (const double offset : {1e3, 1e6, -1e9, 1e12, 1e15}) {
        expect_exact([&] { return uniform() + offset; }, 1000);
        expect_exact([&] { return below(5) + offset; }, 1000);
    }
}
TEST_F(ExactSaddles, OneUnitInTheLastPlaceApart) {
    expect_exact([&] { return 1 + below(6) * 0x1p-52; });
}
TEST_F(ExactSaddles, AsSmallAndAsLargeAsDoublesGet) {
    expect_exact([&] { return (below(9) - 4) * std::numeric_limits<double>::denorm_min(); }, 500);
    expect_exact([&] { return (uniform() - 0.5) * 1e-300; }, 500);
    expect_exact([&] { return (uniform() - 0.5) * 1e308; }, 500);
}

TEST_F(ExactSaddles, AreTheSameInAllCopies) {
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
        const CellValues cell = cell_of([&] { return i % 2 == 0 ? below(6) : uniform() + 1e6; });
        for (const SaddleKind kind : {SaddleKind::joins_highs, SaddleKind::joins_lows}) {
            const std::optional<BodySaddle> saddle = body_saddle(cell, kind);
            found += saddle.has_value();
            for (const CellValues& copy : copies(cell)) {
                const std::optional<BodySaddle> other = body_saddle(copy, kind);
                ASSERT_EQ(other.has_value(), saddle.has_value());
                if (saddle) {
                    ASSERT_EQ(other->value, saddle->value);
                }
            }
        }
    }
    EXPECT_GT(found, 50);
}

TEST_F(ExactSaddles, SignsOfSlopesAreExact) {
    using oracle::Rational;
    const auto exact_sign = [](const CellValues& v, int f) {
        const std::array<int, 4>& corner = kFaceCorners[f];
        const int across = 1 << kFaceAxes[f / 2].normal;
        std::array<Rational, 4> at, slope;
        for (int i = 0; i < 4; ++i) at[i] = Rational(v[corner[i]]), slope[i] = Rational(v[corner[i] ^ across]) - at[i];
        const Rational g = (at[2] - at[1]) * (at[2] - at[3]) * slope[0] + (at[0] - at[3]) * (at[2] - at[3]) * slope[1] +
                           (at[0] - at[3]) * (at[0] - at[1]) * slope[2] + (at[2] - at[1]) * (at[0] - at[1]) * slope[3];
        return g > 0 ? 1 : g < 0 ? -1 : 0;
    };
    const std::vector<std::function<double()>> kinds{[&] { return below(4); },
                                                     [&] { return uniform(); },
                                                     [&] { return below(3) + 1e12; },
                                                     [&] { return 1 + below(4) * 0x1p-52; },
                                                     [&] { return uniform() * 1e308; },
                                                     [&] { return below(5) * std::numeric_limits<double>::denorm_min(); },
                                                     [&] { return std::ldexp(uniform(), static_cast<int>(random_() % 600) - 300); }};
    for (const auto& kind : kinds) {
        for (int i = 0; i < 1000; ++i) {
            const CellValues cell = cell_of(kind);
            for (int f = 0; f < 6; ++f) ASSERT_EQ(side_sign(cell, f), exact_sign(cell, f)) << testing::PrintToString(cell) << f;
        }
    }
}

}  // namespace
}  // namespace isoatlas

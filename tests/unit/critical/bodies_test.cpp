// Body points of single cells (docs/theory/6-interior.md#body-points) against the interpolant itself.
#include "critical/bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "critical/body_saddle.h"
#include "critical/tunnels.h"
#include "field/rounding.h"

namespace isoatlas {
namespace {

CellElements cell_of(const std::array<double, 8>& value) {
    CellElements cell{value, {0, 1, 2, 3, 4, 5, 6, 7}, 0, 0, {}};
    find_ambiguous_faces(cell);
    return cell;
}

std::array<double, 8> negated(std::array<double, 8> value) {
    for (double& v : value) v = -v;
    return value;
}

std::array<double, 3> gradient(const std::array<double, 8>& value, const std::array<double, 3>& at) {
    std::array<double, 3> result{};
    for (int axis = 0; axis < 3; ++axis) {  // linear along every axis: a difference is exact up to rounding
        std::array<double, 3> low = at, high = at;
        low[axis] = 0, high[axis] = 1;
        result[axis] = interpolate(value, high) - interpolate(value, low);
    }
    return result;
}

class Cells : public testing::Test {
protected:
    std::array<double, 8> uniform() {
        std::array<double, 8> value{};
        for (double& v : value) v = std::uniform_real_distribution<>(-1, 1)(random_);
        return value;
    }
    std::array<double, 8> small_integers(int levels) {
        std::array<double, 8> value{};
        for (double& v : value) v = std::uniform_int_distribution<>(0, levels - 1)(random_);
        return value;
    }
    std::mt19937_64 random_{20261121};
};

TEST_F(Cells, SaddlesAreCriticalPoints) {
    int found = 0;
    for (int i = 0; i < 100000; ++i) {
        const std::array<double, 8> value = uniform();
        const std::optional<BodySaddle> saddle = body_saddle(value, SaddleKind::joins_highs);
        if (!saddle) continue;
        ++found;
        for (const double slope : gradient(value, saddle->position)) ASSERT_NEAR(slope, 0, 1e-7);
        ASSERT_NEAR(saddle->value, interpolate(value, saddle->position), 1e-12);
    }
    EXPECT_GT(found, 5000);
}

TEST_F(Cells, SideSignIsTheSlopeIntoTheCell) {
    for (int i = 0; i < 20000; ++i) {
        const std::array<double, 8> value = uniform();
        const CellElements cell = cell_of(value);
        for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
            const int f = std::countr_zero(rest);
            const std::array<int, 4>& c = kFaceCorners[f];
            const double a = value[c[0]], b = value[c[1]], cc = value[c[2]], d = value[c[3]], sum = a + cc - b - d;
            const FaceAxes axes = kFaceAxes[f / 2];
            std::array<double, 3> at{};
            at[axes.axis1] = (a - d) / sum, at[axes.axis2] = (a - b) / sum, at[axes.normal] = f & 1;
            const double slope = gradient(value, at)[axes.normal] * (f & 1 ? -1 : 1);
            if (std::abs(slope) < 1e-9) continue;
            ASSERT_EQ(side_sign(value, f), slope > 0 ? 1 : -1);
        }
    }
}

// docs/theory/6-interior.md#body-points: without ties a body saddle lies inside exactly when the sign of one face disagrees with its
// default type.
TEST_F(Cells, BodyPointsAreTheSaddlesInside) {
    int openings = 0, closings = 0;
    for (int i = 0; i < 300000; ++i) {
        const std::array<double, 8> value = uniform();
        const CellElements cell = cell_of(value);
        const unsigned types = default_face_types(cell);
        const CellBodies bodies = bodies_of_cell(cell, types);
        unsigned wrong = 0;
        for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
            const int f = std::countr_zero(rest);
            wrong |= unsigned{(side_sign(value, f) > 0) != ((types >> f & 1) != 0)} << f;
        }
        ASSERT_EQ(bodies.exceptional, wrong);
        const std::optional<BodySaddle> low = body_saddle(value, SaddleKind::joins_highs),
                                        high = body_saddle(value, SaddleKind::joins_lows);
        ASSERT_EQ(bodies.opening.has_value(), low.has_value());
        ASSERT_EQ(bodies.closing.has_value(), high.has_value());
        if (low) {
            ASSERT_EQ(bodies.opening->value, low->value);
        }
        if (high) {
            ASSERT_EQ(bodies.closing->value, high->value);
        }
        if (low) {
            ASSERT_GT(bodies.opening->value, cell.face_value[bodies.opening->face]);
        }
        if (high) {
            ASSERT_LT(bodies.closing->value, cell.face_value[bodies.closing->face]);
        }
        openings += bodies.opening.has_value(), closings += bodies.closing.has_value();
    }
    EXPECT_GT(openings, 20000);
    EXPECT_GT(closings, 20000);
}

TEST_F(Cells, TiesLeaveAtMostOneTunnelInOrder) {
    for (int i = 0; i < 300000; ++i) {
        const CellElements cell = cell_of(small_integers(2 + i % 7));
        const CellBodies bodies = bodies_of_cell(cell, default_face_types(cell));
        ASSERT_EQ(std::popcount(bodies.exceptional), bodies.opening.has_value() + bodies.closing.has_value());
        if (bodies.opening) {
            ASSERT_GT(bodies.opening->value, cell.face_value[bodies.opening->face]);
        }
        if (bodies.closing) {
            ASSERT_LT(bodies.closing->value, cell.face_value[bodies.closing->face]);
        }
        if (bodies.opening && bodies.closing) {
            ASSERT_GE(bodies.closing->value, bodies.opening->value);
        }
    }
}

TEST_F(Cells, HugeAndTinyValuesAreScaled) {
    for (int i = 0; i < 20000; ++i) {
        const std::array<double, 8> value = uniform();
        const CellElements cell = cell_of(value);
        const CellBodies bodies = bodies_of_cell(cell, default_face_types(cell));
        for (const int exponent : {150, -150, 900, -900}) {  // times a power of two: nothing is rounded
            std::array<double, 8> other = value;
            for (double& v : other) v = std::ldexp(v, exponent);
            const CellElements far = cell_of(other);
            const CellBodies found = bodies_of_cell(far, default_face_types(far));
            ASSERT_EQ(found.exceptional, bodies.exceptional);
            if (bodies.opening) {
                ASSERT_EQ(std::ldexp(found.opening->value, -exponent), bodies.opening->value);
            }
        }
    }
}

// A cell and its negative: Highs and Lows change roles.
TEST_F(Cells, NegatedCellsHaveTheOtherBodies) {
    for (int i = 0; i < 100000; ++i) {
        const std::array<double, 8> value = uniform();
        const CellElements cell = cell_of(value), other = cell_of(negated(value));
        const CellBodies bodies = bodies_of_cell(cell, default_face_types(cell));
        const CellBodies mirrored = bodies_of_cell(other, default_face_types(other));
        ASSERT_EQ(bodies.exceptional, mirrored.exceptional);
        ASSERT_EQ(bodies.opening.has_value(), mirrored.closing.has_value());
        if (bodies.opening) {
            const double other_value = -mirrored.closing->value;  // rounded down there is rounded up here
            ASSERT_TRUE(other_value == bodies.opening->value || bodies.opening->value == next_below(other_value));
        }
        if (bodies.opening) {
            ASSERT_EQ(bodies.opening->face, mirrored.closing->face);
        }
    }
}

/// The High corners and the joined faces of a cell at an isovalue.
struct Configuration {
    int pattern = 0, joined = 0;
    Configuration(const CellElements& cell, double tau) {
        for (int k = 0; k < 8; ++k) pattern |= (cell.value[k] >= tau) << k;
        for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
            const int f = std::countr_zero(rest);
            if (face_is_split(pattern, f)) joined |= (cell.face_value[f] >= tau) << f;
        }
    }
};

// The table of cases with a tunnel, derived anew: the configurations of random cells between a face whose sign disagrees with its default
// type and the saddle inside. No other occurs, each of them occurs.
TEST_F(Cells, TunnelsOccurInExactlyTheCasesOfTheTable) {
    std::vector<int> seen(256 * 64, 0);  // bit 0: a tunnel of Highs was seen; bit 1: one of Lows
    for (int i = 0; i < 1500000; ++i) {
        const std::array<double, 8> value = uniform();
        const CellElements cell = cell_of(value);
        const unsigned types = default_face_types(cell);
        for (const bool joins_highs : {true, false}) {
            const std::optional<BodySaddle> saddle = body_saddle(value, joins_highs ? SaddleKind::joins_highs : SaddleKind::joins_lows);
            if (!saddle) continue;
            for (unsigned rest = cell.ambiguous; rest != 0; rest &= rest - 1) {
                const int f = std::countr_zero(rest);
                if (((types >> f & 1) != 0) == joins_highs || (side_sign(value, f) > 0) != joins_highs) continue;
                const double body = saddle->value;
                const double t = std::uniform_real_distribution<>(0.001, 0.999)(random_);
                const Configuration at(cell, cell.face_value[f] + t * (body - cell.face_value[f]));
                seen[64 * at.pattern + at.joined] |= joins_highs ? 1 : 2;
            }
        }
    }
    int cases = 0, with_tunnel = 0, patterns = 0, with_both = 0;
    for (int pattern = 1; pattern < 255; ++pattern) {
        bool any = false;
        for (int joined = 0; joined < 64; ++joined) {
            bool occurs = true;
            for (int f = 0; f < 6; ++f) occurs = occurs && ((joined >> f & 1) == 0 || face_is_split(pattern, f));
            if (!occurs) continue;
            ++cases;
            ASSERT_EQ(may_hold_tunnel(pattern, joined), seen[64 * pattern + joined] != 0) << pattern << " " << joined;
            with_tunnel += may_hold_tunnel(pattern, joined);
            with_both += seen[64 * pattern + joined] == 3;
            any = any || may_hold_tunnel(pattern, joined);
        }
        patterns += any;
    }
    EXPECT_EQ(cases, 654);
    EXPECT_EQ(with_tunnel, 140);
    EXPECT_EQ(patterns, 104);
    EXPECT_EQ(with_both, 8);
}

/// The image of a set of corners: axes permuted, then mirrored (bit per axis).
unsigned image(unsigned corners, const std::array<int, 3>& axes, int mirrored) {
    unsigned result = 0;
    for (int k = 0; k < 8; ++k) {
        const int to = (k & 1) << axes[0] | (k >> 1 & 1) << axes[1] | (k >> 2) << axes[2];
        result |= (corners >> k & 1) << (to ^ mirrored);
    }
    return result;
}

TEST(Tunnels, SixShapesUpToSymmetry) {
    std::set<std::array<unsigned, 3>> shapes;
    for (int pattern = 0; pattern < 256; ++pattern) {
        for (int joined = 0; joined < 64; ++joined) {
            for (const bool joins_highs : {true, false}) {
                const TunnelShape& shape = tunnel_shape(pattern, joined, joins_highs);
                if (!shape.exists()) continue;
                const auto joined_class = static_cast<unsigned>(joins_highs ? pattern : ~pattern & 255);
                ASSERT_EQ((shape.a | shape.b) & ~joined_class, 0U);
                ASSERT_EQ(shape.ring & joined_class, 0U);
                std::array<unsigned, 3> min{256, 256, 256};
                std::array<int, 3> axes{0, 1, 2};
                do {
                    for (int mirrored = 0; mirrored < 8; ++mirrored) {
                        const unsigned a = image(shape.a, axes, mirrored), b = image(shape.b, axes, mirrored);
                        min = std::min(min, {std::min(a, b), std::max(a, b), image(shape.ring, axes, mirrored)});
                    }
                } while (std::next_permutation(axes.begin(), axes.end()));
                shapes.insert(min);
            }
        }
    }
    EXPECT_EQ(shapes.size(), 6U);
}

// A face that joined its Highs in the ring around an open tunnel of Lows could do so on two sides of the tunnel (descending_disk.cpp).
TEST_F(Cells, NoFaceJoinsHighsWhileATunnelOfLowsIsOpen) {
    int tunnels = 0;
    for (int i = 0; i < 300000; ++i) {
        const CellElements cell = cell_of(i % 2 == 0 ? uniform() : small_integers(3 + i % 5));
        const unsigned types = default_face_types(cell);
        const CellBodies bodies = bodies_of_cell(cell, types);
        if (!bodies.closing) continue;
        ++tunnels;
        for (int f = 0; f < 6; ++f) {
            const bool joins = (cell.ambiguous >> f & 1) != 0 && ((types ^ bodies.exceptional) >> f & 1) != 0;
            if (!joins || !element_below(cell, 8 + f, 8 + bodies.closing->face)) continue;
            ASSERT_LE(cell.face_value[f], bodies.closing->value);
        }
    }
    EXPECT_GT(tunnels, 5000);
}

}  // namespace
}  // namespace isoatlas

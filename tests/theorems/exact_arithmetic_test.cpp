// "The topology is that of exact arithmetic": volumes of small integers, scaled by a power of two and moved by an offset, in the four wide
// sample types. Of the small integers all saddles are told apart by doubles; the oracle compares rationals.
//
// 20,000 volumes: ISOATLAS_TRIALS=10000 (two properties).
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/cut.h"
#include "isoatlas/surface.h"
#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/rational.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::ValueType;

/// value = base * 2^exponent + offset, exact in the type; offset at least 8 times the range, or 0.
struct Moved {
    Grid base, grid;
    ValueType type;
    int exponent;
    double offset;

    /// The isovalue of the base. Exact.
    [[nodiscard]] Rational back(double tau) const {
        const Rational difference = Rational(tau) - Rational(offset);
        return exponent >= 0 ? difference / Rational(boost::multiprecision::cpp_int(1) << exponent)
                             : difference * Rational(boost::multiprecision::cpp_int(1) << -exponent);
    }
};

std::ostream& operator<<(std::ostream& out, const Moved& moved) {
    return out << moved.base << " * 2^" << moved.exponent << " + " << moved.offset << " as type " << static_cast<int>(moved.type);
}

Grid small_integers() {
    const std::array<Index, 3> size = *arbitrary_size(4, 40);
    const int values = *rc::gen::element(2, 3, 5, 9, 30, 1000);
    const auto raw = *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(size[0] * size[1] * size[2]),
                                                           rc::gen::resize(100, rc::gen::inRange(0, 10000)));
    Grid grid{*rc::gen::inRange(0, 5) == 0 ? 2 : 3, size, {}};
    if (grid.rank == 2) grid.size[2] = 1;
    for (Index v = 0; v < grid.voxels(); ++v) grid.value.push_back(raw[static_cast<std::size_t>(v)] % values);
    return grid;
}

Moved arbitrary_moved() {
    Moved moved{small_integers(), {}, *rc::gen::element(ValueType::f32, ValueType::f64, ValueType::i32, ValueType::u32), 0, 0};
    const bool is_integer = moved.type == ValueType::i32 || moved.type == ValueType::u32;
    const int bits = moved.type == ValueType::f32 ? 24 : moved.type == ValueType::f64 ? 53 : 31;  // of an odd offset
    const int shift = *rc::gen::inRange(14, bits);  // the offset, in units of the base, is about 2^shift
    const double units = *rc::gen::inRange(0, 5) == 0 ? 0 : std::ldexp(1.0, shift) - 1000 - *rc::gen::inRange(0, 1000);
    const bool is_negative = moved.type != ValueType::u32 && *rc::gen::arbitrary<bool>();
    if (is_integer) moved.exponent = units == 0 ? *rc::gen::inRange(0, 20) : *rc::gen::inRange(0, 31 - shift);
    if (moved.type == ValueType::f32) moved.exponent = *rc::gen::inRange(-120, 90);
    if (moved.type == ValueType::f64) moved.exponent = *rc::gen::inRange(-1000, 960);
    moved.offset = std::ldexp(is_negative ? -units : units, moved.exponent);
    moved.grid = moved.base;
    for (double& value : moved.grid.value) value = std::ldexp(value, moved.exponent) + moved.offset;
    return moved;
}

void trees_levels_and_events_are_those_of_the_oracle() {
    const Moved moved = arbitrary_moved();
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Result expected = analyse(elements_of(moved.grid, interpolant));
    RC_ASSERT(expected.consistent);
    const isoatlas::Analysis actual = isoatlas::analyse(to_volume(moved.grid, moved.type), {.interpolant = interpolant});
    const std::string difference = compare(expected, actual);
    if (!difference.empty()) RC_LOG() << moved << "\n";
    RC_ASSERT(difference == "");
}

struct Counts {
    std::size_t objects = 0, contours = 0;
    Index genus = 0;
    bool operator==(const Counts&) const = default;
};

Counts counts_of(const Snapshot& snapshot) {
    Counts counts{snapshot.objects.size(), snapshot.contours.size()};
    for (const Contour& contour : snapshot.contours) counts.genus += contour.genus;
    return counts;
}

Counts counts_of(const isoatlas::Cut& cut) {
    Counts counts{cut.objects.size(), cut.contours.size()};
    for (const isoatlas::CutContour& contour : cut.contours) counts.genus += contour.genus;
    return counts;
}

// Samples one unit in the last place apart are the hard case: most saddles lie between two doubles there.
void exact_arithmetic_every_isovalue_there_is_cuts_as_in_the_base() {
    const Moved moved = arbitrary_moved();
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Elements base = elements_of(moved.base, interpolant);
    const isoatlas::Volume volume = to_volume(moved.grid, moved.type);
    std::vector<double> isovalues = moved.grid.value;
    for (const Element& element : elements_of(moved.grid, interpolant).all) isovalues.push_back(element.value);
    for (std::size_t i = isovalues.size(); i-- > 0;)
        isovalues.push_back(std::nextafter(isovalues[i], std::numeric_limits<double>::infinity()));
    std::sort(isovalues.begin(), isovalues.end());
    isovalues.erase(std::unique(isovalues.begin(), isovalues.end()), isovalues.end());
    for (const double tau : isovalues) {
        const Rational at = moved.back(tau);
        const auto reached =
            std::find_if(base.by_rank.begin(), base.by_rank.end(), [&](Index e) { return Rational(base.all[e].value) >= at; });
        const Counts expected = counts_of(snapshot(base, reached - base.by_rank.begin()));
        const Counts found = counts_of(isoatlas::cut(volume, tau, {.interpolant = interpolant}));
        if (!(found == expected)) {
            RC_LOG() << moved << "\ntau " << tau << ": " << found.objects << " objects, " << found.contours << " contours, genus "
                     << found.genus << "; exactly " << expected.objects << ", " << expected.contours << ", " << expected.genus << "\n";
        }
        RC_ASSERT(found == expected);
    }
}

// One volume of each wide type with each offset has the tree of the others, value by value.
TEST(ExactArithmetic, AConstantChangesNothing) {
    Grid base{3, {6, 5, 4}, {}};
    for (Index v = 0; v < base.voxels(); ++v) base.value.push_back(static_cast<double>((v * 7919 + v * v * 31) % 97));
    const Result reference = analyse(elements_of(base, isoatlas::Interpolant::trilinear));
    for (const auto& [type, offset] :
         {std::pair{ValueType::f32, 16000000.0}, std::pair{ValueType::f64, 1e14}, std::pair{ValueType::f64, -1e12},
          std::pair{ValueType::i32, -2147483648.0}, std::pair{ValueType::u32, 4294967000.0}}) {
        Grid moved = base;
        for (double& value : moved.value) value += offset;
        const isoatlas::Analysis actual = isoatlas::analyse(to_volume(moved, type));
        EXPECT_EQ(actual.event_count(), static_cast<std::int64_t>(reference.events.size())) << offset;
        EXPECT_EQ(actual.element_count(), static_cast<std::int64_t>(reference.critical.size())) << offset;
    }
}

TEST(ExactArithmetic, AConstantChangesNoSurface) {
    Grid base{3, {6, 5, 5}, {}};
    for (Index v = 0; v < base.voxels(); ++v) base.value.push_back(static_cast<double>((v * 7919 + v * v * 31) % 23));
    const auto surface_of = [](const Grid& grid, ValueType type, double tau) { return isoatlas::extract(to_volume(grid, type), tau); };
    for (const auto& [type, offset] :
         {std::pair{ValueType::f32, 16000000.0}, std::pair{ValueType::f64, 1e12}, std::pair{ValueType::f64, -1e14},
          std::pair{ValueType::i32, -2147483648.0}, std::pair{ValueType::u32, 4294967000.0}}) {
        Grid moved = base;
        for (double& value : moved.value) value += offset;
        for (const double tau : {3.0, 7.5, 11.0, 11.5, 17.25}) {
            const isoatlas::Surface p = surface_of(base, type == ValueType::u32 ? ValueType::i32 : type, tau),
                                    q = surface_of(moved, type, offset + tau);
            EXPECT_EQ(p.points, q.points) << offset << " " << tau;
            EXPECT_EQ(p.triangles, q.triangles) << offset << " " << tau;
            EXPECT_EQ(p.normals, q.normals) << offset << " " << tau;
        }
    }
}

RC_GTEST_PROP(ExactArithmetic, TreesLevelsAndEventsAreThoseOfTheOracle, ()) { trees_levels_and_events_are_those_of_the_oracle(); }
RC_GTEST_PROP(ExactArithmetic, EveryIsovalueThereIsCutsAsInTheBase, ()) { exact_arithmetic_every_isovalue_there_is_cuts_as_in_the_base(); }

}  // namespace
}  // namespace oracle

// Measures of objects of low values (docs/theory/9-low-values.md): those of the objects of high values of the negated file, with values of
// the opposite sign. Of analytic shapes to the last bit, of random volumes of every type, and of stores of both polarities.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/sink.h"
#include "oracle/stores.h"
#include "unit/measures/shape.h"

namespace isoatlas::shapes {
namespace {

class LowShapes : public testing::TestWithParam<GridKind> {};
INSTANTIATE_TEST_SUITE_P(Grids, LowShapes, testing::ValuesIn(grid_kinds()), [](const auto& grid) { return grid.param.name; });

Field minus_field(const Field& field) {
    return [=](const Vec3& p) { return -field(p); };
}

/// Of the same samples with the opposite sign: everything but the values is the same.
void expect_same_shape(const ObjectMeasures& low, const ObjectMeasures& high) {
    EXPECT_EQ(low.id, high.id);
    EXPECT_EQ(low.voxels, high.voxels);
    EXPECT_EQ(low.voxel_volume, high.voxel_volume);
    EXPECT_EQ(low.volume, high.volume);
    EXPECT_EQ(low.area, high.area);
    EXPECT_EQ(low.equivalent_diameter, high.equivalent_diameter);
    EXPECT_EQ(low.sphericity, high.sphericity);
    EXPECT_EQ(low.centroid, high.centroid);
    EXPECT_EQ(low.axes.length, high.axes.length);
    EXPECT_EQ(low.axes.direction, high.axes.direction);
    EXPECT_EQ(low.box.size, high.box.size);
    EXPECT_EQ(low.bounds, high.bounds);
    EXPECT_EQ(low.feret.max, high.feret.max);
    EXPECT_EQ(low.feret.min, high.feret.min);
    EXPECT_EQ(low.feret.mean, high.feret.mean);
    EXPECT_EQ(low.euler, high.euler);
    EXPECT_EQ(low.tunnels, high.tunnels);
    EXPECT_EQ(low.cavities, high.cavities);
    EXPECT_EQ(low.facets, high.facets);
    EXPECT_EQ(low.touches_border, high.touches_border);
}

TEST_P(LowShapes, AreThoseOfHighValues) {
    for (const Field& field : {ball(1), ellipsoid({1.5, 1, 0.6}, 0.7), torus(1, 0.4), shell(0.5, 1), box({0.9, 0.6, 0.3})}) {
        const ObjectMeasures high = measure(sample(field, GetParam(), 0.15, 1.5));
        const ObjectMeasures low = measure(negated(sample(minus_field(field), GetParam(), 0.15, 1.5)));
        expect_same_shape(low, high);
        EXPECT_EQ(low.values.mean, -high.values.mean);
        EXPECT_EQ(low.values.min, -high.values.max);  // the lowest value of the file, which is the deepest of the object
        EXPECT_EQ(low.values.max, -high.values.min);
        EXPECT_EQ(low.values.sum, -high.values.sum);
        EXPECT_EQ(low.values.deviation, high.values.deviation);
    }
}

// Integers are mirrored within their type, and a calibration is applied behind that: values are those of the file.
TEST(LowMeasures, HaveTheValuesOfTheFile) {
    for (const ValueType type : {ValueType::u8, ValueType::i8, ValueType::u16, ValueType::i16, ValueType::i32, ValueType::f32}) {
        Volume volume = make_volume({3, {5, 5, 5}}, type);
        volume.info.calibration = {.slope = 2, .intercept = -1000};
        visit_type(type, [&]<class T>(T) {
            std::ranges::fill(volume.samples<T>(), T{100});
            for (const std::size_t v : {62U, 63U, 67U}) volume.samples<T>()[v] = static_cast<T>(v - 60);  // 2, 3, 7
        });
        const Volume low = negated(volume);
        const ObjectMeasures hole = measure_objects(low, low.info.calibration.stored(-900)).at(0);
        EXPECT_EQ(hole.voxels, 3);
        EXPECT_EQ(hole.id, 62);  // of the lowest value
        EXPECT_DOUBLE_EQ(hole.values.mean, -992);
        EXPECT_DOUBLE_EQ(hole.values.min, -996);
        EXPECT_DOUBLE_EQ(hole.values.max, -986);
        EXPECT_DOUBLE_EQ(hole.values.sum, -2976);
        EXPECT_NEAR(hole.values.deviation, 2 * std::sqrt(14.0 / 3), 1e-12);
        EXPECT_DOUBLE_EQ(low.info.calibration.reported(hole.tau), -900);
        MemorySink sink("table.csv");
        write_measures(sink, low.info, std::vector<ObjectMeasures>{hole});
        EXPECT_NE(sink.bytes().find("\n1,62,-900,3,3,"), std::string::npos) << sink.bytes();
        EXPECT_TRUE(sink.bytes().ends_with(",low\n")) << sink.bytes();
    }
}

// An object that reaches the border ends there, as one of high values does.
TEST(LowMeasures, OfAChannelThroughTheVolume) {
    Volume volume = make_volume({3, {9, 9, 20}}, ValueType::u8);
    const std::span<std::uint8_t> samples = volume.samples<std::uint8_t>();
    std::ranges::fill(samples, std::uint8_t{200});
    for (std::int64_t z = 0; z < 20; ++z) {
        for (std::int64_t y = 3; y < 6; ++y) {
            for (std::int64_t x = 3; x < 6; ++x) samples[static_cast<std::size_t>(volume.info.extent.index(x, y, z))] = 20;
        }
    }
    const Volume low = negated(volume);
    const ObjectMeasures channel = measure_objects(low, low.info.calibration.stored(110)).at(0);
    EXPECT_TRUE(channel.touches_border);
    EXPECT_EQ(channel.voxels, 180);
    EXPECT_EQ(channel.tunnels, 0);
    EXPECT_NEAR(channel.feret.max, 19.4, 0.3);
    EXPECT_EQ(channel.values.mean, 20);
}

}  // namespace
}  // namespace isoatlas::shapes

namespace oracle {
namespace {

using isoatlas::ObjectMeasures;
using isoatlas::Volume;

bool is_near(double p, double q, double scale) { return (std::isnan(p) && std::isnan(q)) || std::abs(p - q) <= 1e-7 * scale; }

/// size: of the volume.
void assert_opposite(const ObjectMeasures& low, const ObjectMeasures& high, double size, double values) {
    RC_ASSERT(low.id == high.id);
    RC_ASSERT(low.voxels == high.voxels);
    RC_ASSERT(low.euler == high.euler);
    RC_ASSERT(low.tunnels == high.tunnels);
    RC_ASSERT(low.cavities == high.cavities);
    RC_ASSERT(low.touches_border == high.touches_border);
    RC_ASSERT(low.voxel_volume == high.voxel_volume);
    RC_ASSERT(is_near(low.volume, high.volume, size * size * size));
    RC_ASSERT(is_near(low.area, high.area, size * size));
    RC_ASSERT(is_near(low.feret.max, high.feret.max, size));
    for (std::size_t k = 0; k < 3; ++k) {
        RC_ASSERT(is_near(low.centroid[k], high.centroid[k], size));
        RC_ASSERT(is_near(low.axes.length[k], high.axes.length[k], size));
        RC_ASSERT(is_near(low.bounds[0][k], high.bounds[0][k], size));
        RC_ASSERT(is_near(low.bounds[1][k], high.bounds[1][k], size));
    }
    RC_ASSERT(is_near(low.values.mean, -high.values.mean, values));
    RC_ASSERT(low.values.min == -high.values.max);
    RC_ASSERT(low.values.max == -high.values.min);
    RC_ASSERT(is_near(low.values.sum, -high.values.sum, values * static_cast<double>(low.voxels)));
    RC_ASSERT(is_near(low.values.deviation, high.values.deviation, values));
}

void are_those_of_the_negated_file() {
    const Grid grid = *arbitrary_grid(7, 100);
    Grid minus = grid;
    for (double& value : minus.value) value = -value;
    const isoatlas::MeasureOptions options{.interpolant = *arbitrary_interpolant()};
    Volume low = to_volume(grid, arbitrary_type(grid)), opposite = to_volume(minus);
    low.info.geometry = opposite.info.geometry = arbitrary_geometry(grid);
    low = isoatlas::negated(std::move(low));
    const double tau = low.info.calibration.reported(arbitrary_tau(elements_of(to_grid(low), options.interpolant)));
    const std::vector<ObjectMeasures> objects = measure_objects(low, low.info.calibration.stored(tau), options, arbitrary_context());
    const std::vector<ObjectMeasures> expected = measure_objects(opposite, -tau, options);
    RC_ASSERT(objects.size() == expected.size());
    const double values = std::max(1.0, std::abs(*std::ranges::max_element(grid.value, {}, [](double v) { return std::abs(v); })));
    for (std::size_t i = 0; i < objects.size(); ++i) {
        assert_opposite(objects[i], expected[i], 1000, values);
        RC_ASSERT(objects[i].values.max <= tau);
        RC_ASSERT(objects[i].values.min <= objects[i].values.mean);
        RC_ASSERT(objects[i].values.mean <= objects[i].values.max);
    }
}
RC_GTEST_PROP(LowMeasures, AreThoseOfTheNegatedFile, ()) { are_those_of_the_negated_file(); }

void expect_same(const std::vector<ObjectMeasures>& objects, const std::vector<ObjectMeasures>& expected) {
    RC_ASSERT(objects.size() == expected.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        RC_ASSERT(objects[i].id == expected[i].id);
        RC_ASSERT(objects[i].volume == expected[i].volume);
        RC_ASSERT(objects[i].area == expected[i].area);
        RC_ASSERT(objects[i].centroid == expected[i].centroid);
        RC_ASSERT(objects[i].values.mean == expected[i].values.mean);
        RC_ASSERT(objects[i].values.min == expected[i].values.min);
        RC_ASSERT(objects[i].values.sum == expected[i].values.sum);
        RC_ASSERT(objects[i].euler == expected[i].euler);
    }
}

RC_GTEST_FIXTURE_PROP(Stores, MeasuresOfBothPolaritiesAreThoseOfTheVolume, ()) {
    if (*rc::gen::inRange(0, 8) != 0) return;  // building a store takes long
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    if (*rc::gen::inRange(0, 3) == 0) volume.info.calibration = {.slope = 0.5, .intercept = 7};
    isoatlas::build_atlas(path_, volume, {}, {}, isoatlas::PolarityChoice::both);
    for (const isoatlas::Polarity polarity : {isoatlas::Polarity::high, isoatlas::Polarity::low}) {
        const isoatlas::Atlas atlas(path_, {.cache_bytes = 0, .polarity = polarity});
        const Volume side = polarity == isoatlas::Polarity::high ? volume : isoatlas::negated(volume);
        const auto [low, high] = atlas.range();
        const double tau = low + (high - low) * *rc::gen::inRange(0, 11) / 10;
        const std::vector<ObjectMeasures> objects = measure_objects(side, tau);
        expect_same(measure_objects(atlas, tau, {}, arbitrary_context()), objects);
        if (objects.empty()) continue;
        const std::int64_t some = objects[*rc::gen::inRange<std::size_t>(0, objects.size())].id;
        expect_same(measure_objects(atlas, tau, {.objects = {some}}), measure_objects(side, tau, {.objects = {some}}));
        const std::vector<double> taus{low, (low + high) / 2, high};
        RC_ASSERT(samples_below(atlas, taus) == samples_below(side, taus));
    }
}

}  // namespace
}  // namespace oracle

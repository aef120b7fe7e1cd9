// Analytic shapes on even, anisotropic, oblique, mirrored, sheared and uneven grids: every measure within its discretisation error, which
// falls with the square of the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "isoatlas/cut.h"
#include "isoatlas/objects.h"
#include "unit/measures/shape.h"

namespace isoatlas::shapes {
namespace {

constexpr double pi = std::numbers::pi;

class Shapes : public testing::TestWithParam<GridKind> {};
INSTANTIATE_TEST_SUITE_P(Grids, Shapes, testing::ValuesIn(grid_kinds()), [](const auto& grid) { return grid.param.name; });

/// Relative errors at two steps: the second within `bound`, and of second order.
void expect_second_order(double coarse, double fine, double truth, double bound, const char* what) {
    const double first = std::abs(coarse / truth - 1), second = std::abs(fine / truth - 1);
    EXPECT_LT(second, bound) << what << ' ' << fine << ", not " << truth;
    EXPECT_LT(second, 0.4 * first + 1e-4) << what << ": errors " << first << " and " << second;
}

void expect_near(const Vec3& actual, const Vec3& expected, double bound, const char* what) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(actual[k], expected[k], bound) << what << ' ' << k;
}

/// Same direction or the opposite one.
void expect_parallel(const Vec3& p, const Vec3& q, double bound, const char* what) { EXPECT_GT(std::abs(dot(p, q)), 1 - bound) << what; }

TEST_P(Shapes, Ball) {
    const ObjectMeasures coarse = measure(sample(ball(1), GetParam(), 1.0 / 7, 1)),
                         fine = measure(sample(ball(1), GetParam(), 1.0 / 14, 1));
    expect_second_order(coarse.volume, fine.volume, 4 * pi / 3, 0.01, "volume");
    expect_second_order(coarse.area, fine.area, 4 * pi, 0.01, "area");
    EXPECT_NEAR(fine.voxel_volume, 4 * pi / 3, 0.05);
    EXPECT_NEAR(fine.equivalent_diameter, 2, 0.01);
    EXPECT_NEAR(fine.sphericity, 1, 0.005);
    EXPECT_LE(fine.sphericity, 1);
    EXPECT_NEAR(fine.feret.max, 2, 0.02);
    EXPECT_NEAR(fine.feret.min, 2, 0.02);
    EXPECT_NEAR(fine.feret.mean, 2, 0.02);
    EXPECT_LE(fine.feret.min, fine.feret.mean);
    EXPECT_LE(fine.feret.mean, fine.feret.max);
    expect_near(fine.axes.length, {2, 2, 2}, 0.03, "axis");
    expect_near(fine.box.size, {2, 2, 2}, 0.03, "box");
    expect_near(fine.box.centre, kMiddle, 0.02, "centre of the box");
    expect_near(fine.centroid, kMiddle, 0.01, "centroid");
    EXPECT_NEAR(fine.values.mean, 0.25, 0.01);  // of 1 - r over the ball
    EXPECT_GE(fine.values.min, 0);
    EXPECT_NEAR(fine.values.max, 1, 0.1);
    EXPECT_NEAR(fine.values.deviation, std::sqrt(0.6 - 0.5625), 0.01);  // <r^2> = 3/5, <r> = 3/4
    EXPECT_EQ(fine.euler, 1);
    EXPECT_EQ(fine.tunnels, 0);
    EXPECT_EQ(fine.cavities, 0);
    EXPECT_FALSE(fine.touches_border);
}

TEST_P(Shapes, HaveOneVolumeInTablesCutsAndMeasures) {
    const Volume volume = sample(ball(1), GetParam(), 1.0 / 7, 1);
    const double expected = measure(volume).voxel_volume;
    const Cut at = cut(volume, 0);
    ASSERT_EQ(at.objects.size(), 1U);
    EXPECT_NEAR(at.objects[0].measure, expected, 1e-9 * expected);
    const ObjectTable table = rank_objects(volume, analyse(volume));
    ASSERT_FALSE(table.entries.empty());
    for (const ObjectEntry& entry : table.entries) {
        const Cut best = cut(volume, entry.best_tau);
        const auto same = std::ranges::find(best.objects, entry.id, &CutObject::id);
        ASSERT_NE(same, best.objects.end());
        EXPECT_NEAR(entry.measure, same->measure, 1e-9 * same->measure);
    }
}

/// Mean over all directions, by points spread evenly over the sphere.
double mean_over_directions(const std::function<double(const Vec3&)>& function) {
    constexpr int kCount = 20000;
    double sum = 0;
    for (int i = 0; i < kCount; ++i) {
        const double z = 1 - (2 * i + 1.0) / kCount, angle = i * pi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
        sum += function({r * std::cos(angle), r * std::sin(angle), z});
    }
    return sum / kCount;
}

TEST_P(Shapes, Ellipsoid) {
    const Vec3 half{1.5, 1, 0.6};
    const double angle = 0.7;
    const Field field = ellipsoid(half, angle);
    const ObjectMeasures coarse = measure(sample(field, GetParam(), 1.0 / 7, 1.5)),
                         fine = measure(sample(field, GetParam(), 1.0 / 14, 1.5));
    const double volume = 4 * pi / 3 * half[0] * half[1] * half[2];
    // The area is the mean over the unit sphere of 4 pi abc |(n_x / a, n_y / b, n_z / c)|.
    const double area =
        3 * volume * mean_over_directions([&](const Vec3& n) { return norm({n[0] / half[0], n[1] / half[1], n[2] / half[2]}); });
    const double breadth = mean_over_directions([&](const Vec3& n) { return 2 * norm({n[0] * half[0], n[1] * half[1], n[2] * half[2]}); });
    expect_second_order(coarse.volume, fine.volume, volume, 0.01, "volume");
    expect_second_order(coarse.area, fine.area, area, 0.01, "area");
    EXPECT_NEAR(fine.sphericity, std::cbrt(36 * pi * volume * volume) / area, 0.005);
    expect_near(fine.axes.length, {3, 2, 1.2}, 0.04, "axis");
    expect_parallel(fine.axes.direction[0], {std::cos(angle), std::sin(angle), 0}, 0.001, "first axis");
    expect_parallel(fine.axes.direction[2], {0, 0, 1}, 0.001, "third axis");
    const Mat3& axes = fine.axes.direction;
    EXPECT_GT(dot(axes[0], cross(axes[1], axes[2])), 0.999);
    expect_near(fine.box.size, {3, 2, 1.2}, 0.03, "box");
    expect_near(fine.centroid, kMiddle, 0.01, "centroid");
    EXPECT_NEAR(fine.feret.max, 3, 0.02);
    EXPECT_NEAR(fine.feret.min, 1.2, 0.02);
    EXPECT_NEAR(fine.feret.mean, breadth, 0.02);
    expect_parallel(fine.feret.max_direction, {std::cos(angle), std::sin(angle), 0}, 0.02, "largest Feret diameter");
    expect_parallel(fine.feret.min_direction, {0, 0, 1}, 0.02, "smallest Feret diameter");
}

TEST_P(Shapes, Torus) {
    const Field field = torus(1, 0.4);
    const ObjectMeasures coarse = measure(sample(field, GetParam(), 0.1, 1.4)), fine = measure(sample(field, GetParam(), 0.05, 1.4));
    expect_second_order(coarse.volume, fine.volume, 2 * pi * pi * 0.16, 0.02, "volume");
    expect_second_order(coarse.area, fine.area, 4 * pi * pi * 0.4, 0.02, "area");
    EXPECT_NEAR(fine.feret.max, 2.8, 0.02);
    EXPECT_NEAR(fine.feret.min, 0.8, 0.02);
    EXPECT_NEAR(fine.feret.mean, 0.8 + pi / 2, 0.02);  // its hull: a disk widened by a ball
    expect_parallel(fine.axes.direction[2], {0, 0, 1}, 0.001, "axis of rotation");
    EXPECT_EQ(fine.tunnels, 1);
    EXPECT_EQ(fine.euler, 0);
    EXPECT_EQ(fine.cavities, 0);
}

TEST_P(Shapes, Shell) {
    const Field field = shell(0.5, 1);
    const ObjectMeasures coarse = measure(sample(field, GetParam(), 0.1, 1)), fine = measure(sample(field, GetParam(), 0.05, 1));
    expect_second_order(coarse.volume, fine.volume, 4 * pi / 3 * (1 - 0.125), 0.02, "volume");
    expect_second_order(coarse.area, fine.area, 4 * pi * 1.25, 0.02, "area");
    EXPECT_NEAR(fine.feret.max, 2, 0.02);
    EXPECT_NEAR(fine.feret.min, 2, 0.02);
    EXPECT_EQ(fine.cavities, 1);
    EXPECT_EQ(fine.tunnels, 0);
    EXPECT_EQ(fine.euler, 2);
}

// The distance to the nearest face has edges, which the surface cuts off: errors fall with the step only.
TEST(MeasuredBox, WithinTheStep) {
    const Vec3 half{0.9, 0.6, 0.3};
    const ObjectMeasures fine = measure(sample(box(half), grid_kinds()[0], 0.05, 1));
    const double volume = 8 * 0.9 * 0.6 * 0.3, area = 8 * (0.9 * 0.6 + 0.6 * 0.3 + 0.9 * 0.3);
    EXPECT_NEAR(fine.volume, volume, 0.02 * volume);
    EXPECT_NEAR(fine.area, area, 0.05 * area);
    EXPECT_NEAR(fine.feret.max, 2 * norm(half), 0.1);
    EXPECT_NEAR(fine.feret.min, 0.6, 1e-9);
    EXPECT_NEAR(fine.feret.mean, 0.9 + 0.6 + 0.3, 0.05);
    expect_near(fine.box.size, {1.8, 1.2, 0.6}, 1e-9, "box");
    // A box of edges w has the variance w^2 / 12 along each, and the ellipsoid the axes w (5/3)^(1/2).
    expect_near(fine.axes.length, times(2 * std::sqrt(5.0 / 3), half), 0.06, "axis");
}

TEST(MeasuredBox, VoxelsOfABoxAreExact) {
    Geometry geometry;
    geometry.spacing = {0.5, 2, 3};
    geometry.origin = {10, 20, 30};
    Volume volume = make_volume({3, {7, 6, 5}}, ValueType::i16, geometry);
    volume.info.calibration = {.slope = 2, .intercept = -10};
    for (std::int64_t z = 1; z < 3; ++z) {
        for (std::int64_t y = 1; y < 4; ++y) {
            for (std::int64_t x = 1; x < 5; ++x)
                volume.samples<std::int16_t>()[static_cast<std::size_t>(volume.info.extent.index(x, y, z))] =
                    static_cast<std::int16_t>(100 + x);
        }
    }
    const std::vector<ObjectMeasures> objects = measure_objects(volume, 50);
    ASSERT_EQ(objects.size(), 1U);
    const ObjectMeasures& box = objects[0];
    EXPECT_EQ(box.voxels, 24);
    EXPECT_DOUBLE_EQ(box.voxel_volume, 72);
    expect_near(box.centroid, {11.25, 24, 34.5}, 1e-12, "centroid");
    expect_near(box.axes.length, {2 * std::sqrt(5.0 / 12) * 6, 2 * std::sqrt(5.0 / 12) * 6, 2 * std::sqrt(5.0 / 12) * 2}, 1e-12, "axis");
    EXPECT_DOUBLE_EQ(box.values.mean, 195);
    EXPECT_DOUBLE_EQ(box.values.min, 192);
    EXPECT_DOUBLE_EQ(box.values.max, 198);
    EXPECT_DOUBLE_EQ(box.values.sum, 24 * 195);
    EXPECT_DOUBLE_EQ(box.values.deviation, 2 * std::sqrt(1.25));
    EXPECT_FALSE(box.touches_border);
}

// One voxel of 1 among zeros: at 1/2 an octahedron, a sixth of the voxel.
TEST(MeasuredBox, OneVoxel) {
    Volume volume = make_volume({3, {3, 3, 3}}, ValueType::u8);
    volume.samples<std::uint8_t>()[13] = 1;
    const ObjectMeasures voxel = measure_objects(volume, 0.5).at(0);
    EXPECT_EQ(voxel.id, 13);
    EXPECT_NEAR(voxel.volume, 1.0 / 6, 1e-12);
    EXPECT_NEAR(voxel.area, std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(voxel.feret.max, 1, 1e-12);
    EXPECT_NEAR(voxel.feret.min, 1 / std::sqrt(3.0), 1e-12);
    expect_near(voxel.axes.length, {2 * std::sqrt(5.0 / 12), 2 * std::sqrt(5.0 / 12), 2 * std::sqrt(5.0 / 12)}, 1e-12, "axis");
    // At the value of the voxel the surface is as small as rounding allows, and still has measures.
    const ObjectMeasures least = measure_objects(volume, 1).at(0);
    EXPECT_GT(least.volume, 0);
    EXPECT_LT(least.volume, 1e-6);
    EXPECT_GT(least.feret.min, 0);
    EXPECT_LE(least.feret.min, least.feret.max);
}

TEST(MeasuredPlane, Ellipse) {
    for (const bool tilted : {false, true}) {
        GridKind kind = grid_kinds()[tilted ? 2 : 1];
        const Mat3 columns = transposed(kind.geometry.direction);
        const Field field = [&](const Vec3& p) { return 1 - std::hypot(dot(p, columns[0]) / 1.5, dot(p, columns[1])); };
        const ObjectMeasures coarse = measure(sample(field, kind, 0.1, 1.5, 2)), fine = measure(sample(field, kind, 0.05, 1.5, 2));
        expect_second_order(coarse.volume, fine.volume, 1.5 * pi, 0.01, "area");
        const double length = 7.932719794645293;  // 4 a E(1 - b^2 / a^2)
        expect_second_order(coarse.area, fine.area, length, 0.01, "length");
        EXPECT_NEAR(fine.sphericity, 4 * pi * 1.5 * pi / (length * length), 0.005);
        expect_near(fine.axes.length, {3, 2, 0}, 0.02, "axis");
        expect_parallel(fine.axes.direction[0], columns[0], 0.001, "long axis");
        expect_near(fine.box.size, {3, 2, 0}, 0.02, "box");
        expect_near(fine.box.centre, kMiddle, 0.02, "centre of the box");
        EXPECT_NEAR(fine.feret.max, 3, 0.02);
        EXPECT_NEAR(fine.feret.min, 2, 0.02);
        EXPECT_NEAR(fine.feret.mean, length / pi, 0.02);
        expect_parallel(fine.feret.max_direction, columns[0], 0.01, "largest Feret diameter");
        EXPECT_EQ(fine.tunnels, 0);
    }
}

TEST(MeasuredPlane, RingHasAHole) {
    const ObjectMeasures ring = measure(sample([](const Vec3& p) { return 0.25 - std::abs(norm(p) - 0.75); }, grid_kinds()[0], 0.05, 1, 2));
    EXPECT_NEAR(ring.volume, pi * (1 - 0.25), 0.02);
    EXPECT_NEAR(ring.area, 2 * pi * 1.5, 0.05);
    EXPECT_EQ(ring.tunnels, 1);
    EXPECT_EQ(ring.cavities, 0);
    EXPECT_EQ(ring.euler, 0);
}

TEST(SizesOfObjects, Quantiles) {
    std::vector<ObjectMeasures> objects(4);
    for (std::size_t i = 0; i < 4; ++i) objects[i].equivalent_diameter = 1.0 + static_cast<double>(i), objects[i].volume = i == 3 ? 97 : 1;
    const SizeDistribution sizes = size_distribution(objects);
    EXPECT_EQ(sizes.objects, 4);
    EXPECT_DOUBLE_EQ(sizes.mean, 2.5);
    EXPECT_DOUBLE_EQ(sizes.deviation, std::sqrt(1.25));
    EXPECT_EQ(sizes.min, 1);
    EXPECT_EQ(sizes.max, 4);
    EXPECT_EQ(sizes.by_number, (SizeQuantiles{1, 1, 2, 3, 4}));
    EXPECT_EQ(sizes.by_volume, (SizeQuantiles{4, 4, 4, 4, 4}));
    EXPECT_EQ(size_distribution({}).objects, 0);
}

}  // namespace
}  // namespace isoatlas::shapes

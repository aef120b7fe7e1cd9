// Every front is a surface with the contours of the exact one, embedded, and its points are points of the exact one.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <set>

#include "geometry/seen_lengths.h"
#include "geometry/triangles.h"
#include "geometry/vectors.h"
#include "isoatlas/error.h"
#include "isoatlas/octree_front.h"
#include "levelset/high_bits.h"
#include "octree_front/front_mesh.h"
#include "oracle/coarse_surfaces.h"
#include "oracle/shared_surfaces.h"

namespace oracle {
namespace {

using isoatlas::CoalescibleBlocks;
using isoatlas::FrontLeaf;
using isoatlas::FrontOptions;
using isoatlas::FrontSurface;
using isoatlas::Vec3;

FrontOptions arbitrary_front(const isoatlas::Extent& extent) {
    FrontOptions options;
    options.max_level = *rc::gen::inRange(0, 5);
    if (*rc::gen::arbitrary<bool>()) {
        isoatlas::SampleBox box{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.begin[axis] = *rc::gen::inRange<std::int64_t>(0, extent.size[axis]);
            box.end[axis] = *rc::gen::inRange<std::int64_t>(box.begin[axis] + 1, extent.size[axis] + 1);
        }
        options.exact.push_back(box);
    }
    return options;
}

void fronts_have_the_contours_of_the_exact_surface() {
    const CoarseCase c;
    RC_PRE(c.exact.closed && !c.exact.triangles.empty());
    const FrontOptions options = arbitrary_front(c.volume.info.extent);
    const FrontSurface front = extract_front(c.volume, c.exact.tau, options, {.interpolant = c.exact.interpolant}, arbitrary_context());
    const std::string failure = coarse_failure(front.surface, c.exact, c.volume.info, {kInfinity});
    if (!failure.empty()) RC_FAIL(failure);
    if (options.max_level == 0) RC_ASSERT(front.surface.triangles.size() <= c.exact.triangles.size());
}

void hits_stay_within_the_deviation() {
    CoarseCase c;
    c.volume.info.geometry = {};  // points are in voxels
    const isoatlas::ExtractOptions how{.interpolant = c.exact.interpolant};
    const Surface exact = extract(c.volume, c.exact.tau, how);
    FrontOptions options = arbitrary_front(c.volume.info.extent);
    options.deviation = *rc::gen::element(0.01, 0.1, 0.4, 1.0);
    const FrontSurface front = extract_front(c.volume, c.exact.tau, options, how);
    RC_ASSERT(front.deviation <= options.deviation);
    RC_ASSERT(component_numbers(front.surface) == component_numbers(exact));
    const auto point = [&](std::int64_t i) { return front.surface.points[static_cast<std::size_t>(i)]; };
    for (const Vec3& p : exact.points) {
        if (!is_hit(p)) continue;
        double nearest = kInfinity;
        for (const auto& t : front.surface.triangles)
            nearest = std::min(nearest, isoatlas::squared_distance(p, point(t[0]), point(t[1]), point(t[2])));
        RC_ASSERT(std::sqrt(nearest) <= front.deviation + 1e-6);
    }
}

/// How much farther from a front hits of the exact surface are seen than it says, of every so manieth; 0: nowhere. Seen from all around.
double unseen_by(const FrontSurface& front, const isoatlas::Volume& volume, double tau, const FrontOptions& options,
                 isoatlas::Interpolant interpolant, std::size_t every) {
    isoatlas::Volume in_voxels = volume;
    in_voxels.info.geometry = {};
    const Surface exact = extract(in_voxels, tau, {.interpolant = interpolant});
    const isoatlas::SeenLengths all_around({.eye = options.from->eye, .pixel = options.from->pixel, .near = options.from->near});
    const auto point = [&](std::int64_t i) { return front.surface.points[static_cast<std::size_t>(i)]; };
    double farther = 0;
    for (std::size_t i = 0; i < exact.points.size(); i += every) {
        const Vec3& voxel = exact.points[static_cast<std::int64_t>(i)];
        if (!is_hit(voxel)) continue;
        const Vec3 p = to_physical(volume.info.geometry, voxel);
        double nearest = kInfinity;
        for (const auto& t : front.surface.triangles)
            nearest = std::min(nearest, isoatlas::squared_distance(p, point(t[0]), point(t[1]), point(t[2])));
        const double pixels = all_around.pixels(std::sqrt(nearest), p, 0), unseen = options.from->cone ? 16 : 1;
        farther = std::max(farther, pixels - unseen * front.pixels - 1e-6);
    }
    return farther;
}

/// On any axes, whatever they mean.
void hits_are_seen_within_the_pixels() {
    const CoarseCase c;
    RC_PRE(c.exact.closed && !c.exact.triangles.empty());
    FrontOptions options = arbitrary_front(c.volume.info.extent);
    const auto place = [&] { return *rc::gen::inRange(-30, 60) * 0.5; };
    options.from = isoatlas::Viewpoint{.eye = {place(), place(), place()}, .pixel = *rc::gen::element(0.002, 0.02, 0.2), .near = 0.5};
    options.pixels = *rc::gen::element(0.5, 1.0, 3.0);
    if (*rc::gen::arbitrary<bool>()) options.from->cone = isoatlas::ViewCone{{1, place(), place()}, 0.3};
    const FrontSurface front = extract_front(c.volume, c.exact.tau, options, {.interpolant = c.exact.interpolant});
    RC_ASSERT(front.pixels <= options.pixels);
    RC_ASSERT(component_numbers(front.surface) == component_numbers(c.exact));
    RC_ASSERT(unseen_by(front, c.volume, c.exact.tau, options, c.exact.interpolant, 1) == 0);
}

/// By the same search; the triangles of all objects count where they are few, those that are chosen where they are too many.
void surfaces_of_few_or_too_many_triangles_are_exact() {
    const CoarseCase c;
    RC_PRE(c.exact.closed && !c.exact.triangles.empty());
    FrontOptions options = arbitrary_front(c.volume.info.extent);
    isoatlas::ExtractOptions how{.interpolant = c.exact.interpolant};
    const auto triangles = static_cast<std::int64_t>(isoatlas::extract(c.volume, c.exact.tau, how).triangles.size());
    how.surface.ids = *rc::gen::arbitrary<bool>();
    if (*rc::gen::arbitrary<bool>()) how.surface.objects = {*rc::gen::elementOf(c.exact.object)};
    const Surface exact = isoatlas::extract(c.volume, c.exact.tau, how);
    const Surface front = extract_front(c.volume, c.exact.tau, options, how).surface;
    const auto chosen_triangles = std::ssize(exact.triangles);
    options.exact_triangles = *rc::gen::element<std::int64_t>(0, 1, triangles - 1, triangles, 2 * triangles);
    options.exact_above = *rc::gen::element<std::int64_t>(0, 1, chosen_triangles - 1, chosen_triangles, triangles - 1, triangles);
    const FrontSurface chosen = extract_front(c.volume, c.exact.tau, options, how, arbitrary_context());
    const bool is_exact =
        triangles <= options.exact_triangles || (options.exact_above > 0 && std::ssize(exact.triangles) > options.exact_above);
    RC_ASSERT(chosen.leaves.empty() == is_exact);
    RC_ASSERT(chosen.surface.points == (is_exact ? exact : front).points);
    RC_ASSERT(chosen.surface.triangles == (is_exact ? exact : front).triangles);
    RC_ASSERT(chosen.surface.contour == (is_exact ? exact : front).contour);
}

void regions_of_interest_are_exact() {
    CoarseCase c;
    c.volume.info.geometry = {};
    FrontOptions options = arbitrary_front(c.volume.info.extent);
    const FrontSurface front = extract_front(c.volume, c.exact.tau, options);
    const std::set<Vec3> points(front.surface.points.begin(), front.surface.points.end());
    for (const Vec3& p : extract(c.volume, c.exact.tau).points) {
        const bool is_inside = std::ranges::any_of(options.exact, [&](const isoatlas::SampleBox& box) {
            bool inside = is_hit(p);
            for (std::size_t axis = 0; axis < 3; ++axis)
                inside = inside && p[axis] >= static_cast<double>(box.begin[axis]) && p[axis] <= static_cast<double>(box.end[axis] - 1);
            return inside;
        });
        if (is_inside) RC_ASSERT(points.contains(p));
    }
}

void points_of_fronts_are_exact_points() {
    const CoarseCase c;
    RC_PRE(c.exact.closed && !c.exact.triangles.empty());
    const FrontOptions options = arbitrary_front(c.volume.info.extent);
    const FrontSurface front = extract_front(c.volume, c.exact.tau, options, {.interpolant = c.exact.interpolant});
    const std::set<Vec3> exact(c.exact.points.begin(), c.exact.points.end());
    const auto strange = std::ranges::count_if(front.surface.points, [&](const Vec3& p) { return !exact.contains(p); });
    std::int64_t leaves = 0;
    for (const std::int64_t count : front.leaves) leaves += count;
    RC_ASSERT(strange <= 8 * leaves);  // centres of fans and what cells add
    if (options.max_level == 0 && c.exact.interpolant == isoatlas::Interpolant::faces) RC_ASSERT(strange <= 4 * leaves);
}

void fronts_have_the_same_bytes_for_any_threads() {
    const CoarseCase c;
    const FrontOptions options = arbitrary_front(c.volume.info.extent);
    const FrontSurface one = extract_front(c.volume, c.exact.tau, options, {.interpolant = c.exact.interpolant}, {.threads = 1});
    const FrontSurface two =
        extract_front(c.volume, c.exact.tau, options, {.interpolant = c.exact.interpolant}, {.threads = 2, .slab_slices = 3});
    RC_ASSERT(std::ranges::equal(one.surface.points, two.surface.points));
    RC_ASSERT(std::ranges::equal(one.surface.normals, two.surface.normals));
    RC_ASSERT(std::ranges::equal(one.surface.triangles, two.surface.triangles));
    RC_ASSERT(one.leaves == two.leaves);
}

/// max_triangles refuses one triangle more and nothing less, of the whole as of parts.
void more_triangles_than_may_be_are_refused() {
    const CoarseCase c;
    const FrontOptions options = arbitrary_front(c.volume.info.extent);
    isoatlas::ExtractOptions how{.interpolant = c.exact.interpolant};
    how.surface.shell = *rc::gen::element(isoatlas::ShellChoice::all, isoatlas::ShellChoice::outer, isoatlas::ShellChoice::inner);
    const auto triangles = static_cast<std::int64_t>(extract_front(c.volume, c.exact.tau, options, how).surface.triangles.size());
    RC_PRE(triangles > 1);
    how.surface.max_triangles = triangles;
    RC_ASSERT(static_cast<std::int64_t>(extract_front(c.volume, c.exact.tau, options, how).surface.triangles.size()) == triangles);
    how.surface.max_triangles = *rc::gen::inRange<std::int64_t>(1, triangles);
    isoatlas::Reason reason = isoatlas::Reason::none;
    try {
        (void)extract_front(c.volume, c.exact.tau, options, how);
    } catch (const isoatlas::Error& error) {
        reason = error.reason();
    }
    RC_ASSERT(reason == isoatlas::Reason::too_many_triangles);
}

/// Leaves of any sizes: those that a coin keeps.
struct CoinFront {
    int max_level;
    std::uint64_t seed;
    double kept;  ///< the probability
};

Surface front_of(const isoatlas::Volume& volume, double tau, isoatlas::Interpolant interpolant, const CoinFront& coin) {
    const isoatlas::HighBits high = classify(volume, tau, {});
    const isoatlas::TauLevel level{volume, tau, high};
    const CoalescibleBlocks blocks(high, coin.max_level, {});
    const isoatlas::FrontLeaves leaves(blocks,
                                       [&](const FrontLeaf& leaf) {
                                           const isoatlas::Index3& b = leaf.block;
                                           return hashed(static_cast<double>(b[0]) + 0.5 * leaf.level,
                                                         static_cast<double>(b[1]) + static_cast<double>(coin.seed % 1000),
                                                         static_cast<double>(b[2])) < coin.kept;
                                       },
                                       {});
    std::vector<isoatlas::RowFans> fans(static_cast<std::size_t>(leaves.rows()));
    for (std::int64_t row = 0; row < leaves.rows(); ++row) find_fans(leaves, row, fans[static_cast<std::size_t>(row)]);
    Surface front;
    front.closed = true;
    isoatlas::ExtractOptions how;
    how.interpolant = interpolant;
    how.surface.ids = false;
    visit_grid(level.volume, [&]<class T>(const isoatlas::SampleGrid<T>& grid) {
        isoatlas::FrontMesh<T>(level, grid, leaves, how, {}, nullptr).write(fans, front);
    });
    return front;
}

void every_choice_of_leaves_is_a_front() {
    const CoarseCase c;
    RC_PRE(c.exact.closed && !c.exact.triangles.empty());
    const CoinFront coin{*rc::gen::inRange(1, 5), *rc::gen::arbitrary<std::uint64_t>(), *rc::gen::element(0.2, 0.5, 0.8)};
    const Surface front = front_of(c.volume, c.exact.tau, c.exact.interpolant, coin);
    const std::string failure = coarse_failure(front, c.exact, c.volume.info, {kInfinity});
    if (!failure.empty()) RC_FAIL(failure);
}

/// ISOATLAS_ALL_DATA=1: 100 fronts of each surface.
TEST(OctreeFronts, OfSharedVolumesHold) {
    const bool are_there = for_shared_surfaces(4, 100, [](const SharedSurface& of, const isoatlas::Volume& volume, int fronts) {
        const Surface exact = isoatlas::extract(volume, of.tau);
        std::size_t least = exact.triangles.size();
        for (int i = 0; i < fronts; ++i) {
            constexpr std::array kKept{1.0, 0.5, 0.8, 0.2};
            const CoinFront coin{1 + i % 5, static_cast<std::uint64_t>(i), kKept[static_cast<std::size_t>(i) % kKept.size()]};
            const Surface front = front_of(volume, of.tau, exact.interpolant, coin);
            least = std::min(least, front.triangles.size());
            EXPECT_EQ(component_numbers(front), component_numbers(exact)) << of.volume << " at " << of.tau << ", front " << i;
            const bool all_checks = fronts < 100 || i % 25 == 0;  // distances and nesting take most of the time
            const std::string failure = all_checks ? coarse_failure(front, exact, volume.info, {kInfinity}) : mesh_failure(front, true);
            EXPECT_EQ(failure, "") << of.volume << " at " << of.tau << ", front " << i;
        }
        std::cout << of.volume << " at " << of.tau << ": " << exact.triangles.size() << " -> " << least << " triangles, " << fronts
                  << " fronts\n";
    });
    if (!are_there) GTEST_SKIP() << "no shared data beside the checkout";
}

/// From far in front of them, and from a corner; a pixel is a thousandth of the distance.
TEST(OctreeFronts, OfSharedVolumesAreSeenWithinTheirPixels) {
    const bool are_there = for_shared_surfaces(4, 1, [](const SharedSurface& of, const isoatlas::Volume& volume, int) {
        const Surface exact = isoatlas::extract(volume, of.tau);
        const isoatlas::Index3& size = volume.info.extent.size;
        const auto voxel = [&](double x, double y, double z) {
            return to_physical(volume.info.geometry,
                               {x * static_cast<double>(size[0]), y * static_cast<double>(size[1]), z * static_cast<double>(size[2])});
        };
        const Vec3 far = voxel(0.5, 0.5, -8);
        for (const Vec3& eye : {far, voxel(0, 0, 0)}) {
            const FrontOptions options{.max_level = 5, .from = isoatlas::Viewpoint{.eye = eye, .pixel = 0.001, .near = 1}};
            const FrontSurface front = extract_front(volume, of.tau, options, {.interpolant = exact.interpolant});
            EXPECT_LE(front.pixels, 1);
            const double most = eye == far ? 1 : 1.05;  // of the triangles of the exact surface
            EXPECT_LT(static_cast<double>(front.surface.triangles.size()), most * static_cast<double>(exact.triangles.size())) << of.volume;
            EXPECT_EQ(component_numbers(front.surface), component_numbers(exact)) << of.volume << " at " << of.tau;
            EXPECT_EQ(unseen_by(front, volume, of.tau, options, exact.interpolant, exact.points.size() / 300 + 1), 0) << of.volume;
        }
    });
    if (!are_there) GTEST_SKIP() << "no shared data beside the checkout";
}

/// Of more than 64 words.
TEST(OctreeFronts, OfLongRowsHold) {
    const auto tube = [](double x, double y, double z) { return 1.7 - std::hypot(y - 4 - std::sin(x / 40), z - 4 - std::cos(x / 25)); };
    const isoatlas::Volume volume = volume_of({"a long tube", {3, {4200, 9, 9}}, tube, 0.2});
    const Surface exact = isoatlas::extract(volume, 0.2);
    const FrontSurface front = extract_front(volume, 0.2, {.max_level = 3});
    EXPECT_LT(front.surface.triangles.size(), exact.triangles.size());
    EXPECT_EQ(coarse_failure(front.surface, exact, volume.info, {kInfinity}), "");
}

TEST(OctreeFronts, AreCoarserWithEachLevel) {
    const isoatlas::Volume volume = volume_of(kShapes[5]);
    std::size_t before = isoatlas::extract(volume, kShapes[5].tau).triangles.size() * 2;
    for (int level = 0; level <= 3; ++level) {
        const FrontSurface front = extract_front(volume, kShapes[5].tau, {.max_level = level});
        EXPECT_LT(front.surface.triangles.size(), before);
        before = front.surface.triangles.size();
    }
}

TEST(OctreeFronts, AreAsFineAsSoManyTrianglesAllow) {
    const isoatlas::Volume volume = volume_of(kShapes[5]);
    std::size_t before = 0;
    for (const std::int64_t most : {1, 1000, 2500, 100'000}) {
        const FrontSurface front = extract_front(volume, kShapes[5].tau, {.max_level = 4, .triangles = most});
        EXPECT_GE(front.surface.triangles.size(), before);
        if (most > 2000) {
            EXPECT_LE(front.surface.triangles.size(), 1.5 * static_cast<double>(most));
        }
        before = front.surface.triangles.size();
    }
    EXPECT_EQ(before, extract(volume, kShapes[5].tau).triangles.size());
}

TEST(OctreeFronts, AreFineNearTheEye) {
    isoatlas::Volume volume = volume_of(kShapes[5]);
    volume.info.geometry = {};
    const auto seen_from = [&](const Vec3& eye) {
        return extract_front(volume, kShapes[5].tau, {.from = isoatlas::Viewpoint{.eye = eye, .pixel = 0.01, .near = 1}});
    };
    const FrontSurface front = seen_from({0, 0, 0}), far = seen_from({-4000, 0, 0});
    EXPECT_LE(front.pixels, 1);
    EXPECT_LE(far.pixels, 1);
    EXPECT_LT(far.surface.triangles.size(), front.surface.triangles.size());
    for (const Vec3& p : extract(volume, kShapes[5].tau).points) {
        double nearest = kInfinity;
        for (const auto& t : front.surface.triangles) {
            const auto corner = [&](std::size_t i) { return front.surface.points[static_cast<std::size_t>(t[i])]; };
            nearest = std::min(nearest, isoatlas::squared_distance(p, corner(0), corner(1), corner(2)));
        }
        EXPECT_LE(std::sqrt(nearest), 0.01 * std::max(1.0, isoatlas::norm(p)) + 1e-6);
    }
}

TEST(OctreeFronts, KeepShapesThatDecimatorsBreak) {
    for (const Shape& shape : kShapes) {
        const isoatlas::Volume volume = volume_of(shape);
        const Surface exact = isoatlas::extract(volume, shape.tau);
        for (const int level : {1, 3, 5}) {
            const FrontSurface front = extract_front(volume, shape.tau, {.max_level = level});
            EXPECT_EQ(coarse_failure(front.surface, exact, volume.info, {kInfinity}), "") << shape.name << ", " << level;
        }
    }
}

TEST(OctreeFronts, RefuseOptionsOutOfRange) {
    const isoatlas::Volume volume = volume_of(kShapes[5]);
    const auto refused = [&](const isoatlas::Volume& of, const FrontOptions& options) {
        try {
            (void)extract_front(of, 0.3, options);
        } catch (const isoatlas::Error& error) {
            return error.kind();
        }
        return isoatlas::ErrorKind::cancelled;
    };
    EXPECT_EQ(refused(volume, {.max_level = 6}), isoatlas::ErrorKind::usage);
    EXPECT_EQ(refused(volume, {.max_level = -1}), isoatlas::ErrorKind::usage);
    EXPECT_EQ(refused(volume, {.deviation = 0}), isoatlas::ErrorKind::usage);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double length : {nan, -0.001, 0.0}) {
        EXPECT_EQ(refused(volume, {.from = isoatlas::Viewpoint{.pixel = length, .near = 1}}), isoatlas::ErrorKind::usage);
        EXPECT_EQ(refused(volume, {.from = isoatlas::Viewpoint{.pixel = 0.001, .near = length}}), isoatlas::ErrorKind::usage);
        EXPECT_EQ(refused(volume, {.pixels = length}), isoatlas::ErrorKind::usage);
    }
    EXPECT_EQ(refused(volume, {.from = isoatlas::Viewpoint{.eye = {0, nan, 9}, .pixel = 1, .near = 1}}), isoatlas::ErrorKind::usage);
    EXPECT_EQ(refused(volume, {.deviation = 1, .from = isoatlas::Viewpoint{.pixel = 1, .near = 1}}), isoatlas::ErrorKind::usage);
    EXPECT_EQ(refused(volume, {.exact = {{{0, 0, 0}, {99, 1, 1}}}}), isoatlas::ErrorKind::usage);
    const std::vector<float> flat(16, 1);
    EXPECT_EQ(refused(isoatlas::make_volume<float>({2, {4, 4, 1}}, flat), {}), isoatlas::ErrorKind::unsupported);
}

RC_GTEST_PROP(OctreeFronts, OfFewOrTooManyTrianglesAreExact, ()) { surfaces_of_few_or_too_many_triangles_are_exact(); }
RC_GTEST_PROP(OctreeFronts, HaveTheContoursOfTheExactSurface, ()) { fronts_have_the_contours_of_the_exact_surface(); }
RC_GTEST_PROP(OctreeFronts, StayWithinTheirDeviation, ()) { hits_stay_within_the_deviation(); }
RC_GTEST_PROP(OctreeFronts, AreSeenWithinTheirPixels, ()) { hits_are_seen_within_the_pixels(); }
RC_GTEST_PROP(OctreeFronts, AreExactInRegionsOfInterest, ()) { regions_of_interest_are_exact(); }
RC_GTEST_PROP(OctreeFronts, HavePointsOfTheExactSurface, ()) { points_of_fronts_are_exact_points(); }
RC_GTEST_PROP(OctreeFronts, HaveTheSameBytesForAnyThreads, ()) { fronts_have_the_same_bytes_for_any_threads(); }
RC_GTEST_PROP(OctreeFronts, AreRefusedWithMoreTrianglesThanMayBe, ()) { more_triangles_than_may_be_are_refused(); }
RC_GTEST_PROP(OctreeFronts, AreAnyChoiceOfLeaves, ()) { every_choice_of_leaves_is_a_front(); }

}  // namespace
}  // namespace oracle

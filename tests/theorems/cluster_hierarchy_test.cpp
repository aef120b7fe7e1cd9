// Every choice of a hierarchy of clusters is a surface with the contours of the exact one, embedded, within the distance that it says.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "isoatlas/cluster_hierarchy.h"
#include "oracle/coarse_surfaces.h"
#include "oracle/shared_surfaces.h"

namespace oracle {
namespace {

using isoatlas::Cluster;
using isoatlas::ClusterGroup;
using isoatlas::ClusterHierarchy;
using isoatlas::ClusterOptions;

ClusterHierarchy hierarchy_of(const CoarseCase& c, const isoatlas::Context& context = {}) {
    ClusterOptions options;
    options.unit = c.options.unit;
    options.first_distance = *rc::gen::element(0.01, 0.1, 1.0);
    options.triangles = *rc::gen::element(4, 16);
    options.clusters = *rc::gen::element(2, 5);
    return make_clusters(c.exact, c.volume.info.geometry, c.volume.info.extent, options, context);
}

struct Choice {
    Surface surface;
    double distance = 0;
};

/// Each group that may be is chosen with this probability.
Choice random_choice(const ClusterHierarchy& hierarchy, double probability, std::mt19937_64& random) {
    Choice choice;
    choice.surface = surface_of_choice(hierarchy, [&](std::int64_t group) {
        const double distance = hierarchy.groups[static_cast<std::size_t>(group)].distance;
        const bool is_chosen = static_cast<double>(random() >> 11) * 0x1p-53 < probability;
        if (is_chosen) choice.distance = std::max(choice.distance, distance);
        return is_chosen;
    });
    return choice;
}

std::mt19937_64 arbitrary_random() { return std::mt19937_64(*rc::gen::arbitrary<std::uint64_t>()); }

void every_choice_has_the_same_contours_within_its_distance() {
    const CoarseCase c;
    const ClusterHierarchy hierarchy = hierarchy_of(c, arbitrary_context());
    std::mt19937_64 random = arbitrary_random();
    for (const double probability : {0.6, 0.9, 1.0}) {
        const Choice choice = random_choice(hierarchy, probability, random);
        if (choice.surface.points.empty()) return;
        const std::string failure = coarse_failure(choice.surface, c.exact, c.volume.info, {choice.distance, c.options.unit});
        if (!failure.empty()) RC_FAIL(failure);
    }
}

/// The groups of at most so many pixels are a choice, from wherever the surface is seen.
void every_view_has_the_same_contours_within_its_distance() {
    const CoarseCase c;
    const ClusterHierarchy hierarchy = hierarchy_of(c, arbitrary_context());
    if (hierarchy.groups.empty()) return;
    isoatlas::Viewpoint from{.pixel = 0.01, .near = 0.5};
    for (double& x : from.eye) x = *rc::gen::inRange(-20, 40);
    if (*rc::gen::arbitrary<bool>()) {
        const double half_angle = *rc::gen::inRange(1, 15) / 10.0;
        from.cone = {{1.0, static_cast<double>(*rc::gen::inRange(-3, 4)), static_cast<double>(*rc::gen::inRange(-3, 4))}, half_angle};
    }
    const std::vector<double> pixels = pixels_of_groups(hierarchy, from);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        for (const std::int64_t part : hierarchy.groups[i].made_of) RC_ASSERT(pixels[static_cast<std::size_t>(part)] <= pixels[i]);
    }
    const double most = *rc::gen::elementOf(pixels);
    double distance = 0;
    const Surface seen = surface_of_choice(hierarchy, [&](std::int64_t group) {
        const auto i = static_cast<std::size_t>(group);
        if (pixels[i] <= most) distance = std::max(distance, hierarchy.groups[i].distance);
        return pixels[i] <= most;
    });
    const std::string failure = coarse_failure(seen, c.exact, c.volume.info, {distance, c.options.unit});
    if (!failure.empty()) RC_FAIL(failure);
}

void clusters_are_parts_of_the_surface() {
    const CoarseCase c;
    const ClusterHierarchy hierarchy = hierarchy_of(c);
    std::int64_t next = 0;
    for (const Cluster& cluster : hierarchy.clusters) {
        RC_ASSERT(cluster.first_triangle == next);
        RC_ASSERT(cluster.triangles > 0);
        RC_ASSERT(cluster.triangles <= 16);
        RC_ASSERT(cluster.replaced_by < 0 || cluster.replaced_by > cluster.made_by);
        next += cluster.triangles;
    }
    RC_ASSERT(next == static_cast<std::int64_t>(hierarchy.surface.triangles.size()));
    for (std::size_t i = 0; i < hierarchy.groups.size(); ++i) {
        const ClusterGroup& group = hierarchy.groups[i];
        for (const std::int64_t made : group.made_of) {
            const ClusterGroup& part = hierarchy.groups[static_cast<std::size_t>(made)];
            RC_ASSERT(made < static_cast<std::int64_t>(i));
            RC_ASSERT(part.distance <= group.distance);
            const isoatlas::Vec3 &p = part.centre, &q = group.centre;
            RC_ASSERT(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) + part.radius <= group.radius * (1 + 1e-9));
        }
    }
    for (const Cluster& cluster : hierarchy.clusters) {  // those of a group that is made and replaced lie in the ball of what replaces them
        if (cluster.replaced_by < 0) continue;
        const ClusterGroup& group = hierarchy.groups[static_cast<std::size_t>(cluster.replaced_by)];
        for (std::int64_t t = cluster.first_triangle; t < cluster.first_triangle + cluster.triangles; ++t) {
            for (const std::int64_t point : hierarchy.surface.triangles[static_cast<std::size_t>(t)]) {
                const isoatlas::Vec3 &p = hierarchy.surface.points[static_cast<std::size_t>(point)], &q = group.centre;
                RC_ASSERT(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= group.radius * (1 + 1e-9));
            }
        }
    }
}

void the_coarsest_surface_has_the_same_contours() {
    const CoarseCase c;
    RC_ASSERT(euler_numbers(surface_within(hierarchy_of(c), kInfinity)) == euler_numbers(c.exact));
}

/// Triangles as corners with coordinates, each from its least corner: of a surface whose points are numbered anyhow.
auto shape_of(const Surface& surface) {
    std::vector<std::array<isoatlas::Vec3, 3>> shape;
    for (const auto& [a, b, c] : surface.triangles) {
        std::array<isoatlas::Vec3, 3> t{surface.points[static_cast<std::size_t>(a)], surface.points[static_cast<std::size_t>(b)],
                                        surface.points[static_cast<std::size_t>(c)]};
        std::ranges::rotate(t, std::ranges::min_element(t));
        shape.push_back(t);
    }
    std::ranges::sort(shape);
    return shape;
}

void the_choice_of_nothing_is_the_exact_surface() {
    const CoarseCase c;
    RC_ASSERT(shape_of(surface_within(hierarchy_of(c), 0)) == shape_of(c.exact));
}

void hierarchies_have_the_same_bytes_for_any_threads() {
    const CoarseCase c;
    ClusterOptions options;
    options.triangles = 8, options.clusters = 2;
    const auto made = [&](int threads) {
        return make_clusters(c.exact, c.volume.info.geometry, c.volume.info.extent, options, {.threads = threads});
    };
    const ClusterHierarchy one = made(1), two = made(2);
    RC_ASSERT(one.surface.points == two.surface.points);
    RC_ASSERT(one.surface.triangles == two.surface.triangles);
    RC_ASSERT(one.surface.normals == two.surface.normals);
    RC_ASSERT(one.clusters.size() == two.clusters.size());
    for (std::size_t i = 0; i < one.groups.size(); ++i) RC_ASSERT(one.groups[i].made_of == two.groups[i].made_of);
}

/// Contours of one choice of many; of some of them crossings, of few nesting and distances, which take most of the time.
std::string choice_failure(int i, const Choice& choice, const Surface& exact, const std::map<std::int64_t, std::int64_t>& numbers,
                           const isoatlas::VolumeInfo& info) {
    constexpr int kWithCrossings = 5, kWithDistances = 125;  // odd: of all probabilities
    if (i % kWithDistances == 0) return coarse_failure(choice.surface, exact, info, {choice.distance});
    if (euler_numbers(choice.surface) != numbers) return "the contours have other Euler numbers";
    return mesh_failure(choice.surface, i % kWithCrossings == 0);
}

void check_choices(const char* name, const isoatlas::Volume& volume, double tau, int choices, std::uint64_t seed) {
    const Surface exact = isoatlas::extract(volume, tau);
    const ClusterHierarchy hierarchy = make_clusters(exact, volume.info.geometry, volume.info.extent, {.triangles = 64, .clusters = 8});
    std::mt19937_64 random(seed);
    const Surface coarsest = surface_within(hierarchy, kInfinity);
    EXPECT_TRUE(euler_numbers(coarsest) == euler_numbers(exact)) << name;
    std::size_t least = exact.triangles.size();
    const std::map<std::int64_t, std::int64_t> numbers = euler_numbers(exact);
    for (int i = 0; i < choices; ++i) {
        constexpr std::array kProbabilities{1.0, 0.5, 0.8, 0.95};
        const Choice choice = random_choice(hierarchy, kProbabilities[static_cast<std::size_t>(i) % kProbabilities.size()], random);
        least = std::min(least, choice.surface.triangles.size());
        const int kind = choices < 100 ? 0 : i;  // of few, all have all checks
        EXPECT_EQ(choice_failure(kind, choice, exact, numbers, volume.info), "")
            << name << " at " << tau << ", choice " << i << " of seed " << seed;
    }
    std::cout << name << " at " << tau << ": " << exact.triangles.size() << " -> " << least << " and " << coarsest.triangles.size()
              << " triangles, " << hierarchy.groups.size() << " groups, " << choices << " choices\n";
}

TEST(ClusterHierarchies, OfDifficultShapesHold) {
    for (const Shape& shape : kShapes) check_choices(shape.name, volume_of(shape), shape.tau, 3, 1);
}

/// ISOATLAS_ALL_DATA=1: 1000 choices of each surface.
TEST(ClusterHierarchies, OfSharedVolumesHold) {
    const bool are_there = for_shared_surfaces(4, 1000, [](const SharedSurface& of, const isoatlas::Volume& volume, int choices) {
        check_choices(of.volume, volume, of.tau, choices, 7);
    });
    if (!are_there) GTEST_SKIP() << "no shared data beside the checkout";
}

RC_GTEST_PROP(ClusterHierarchies, EveryChoiceHasTheSameContoursWithinItsDistance, ()) {
    every_choice_has_the_same_contours_within_its_distance();
}
RC_GTEST_PROP(ClusterHierarchies, EveryViewHasTheSameContoursWithinItsDistance, ()) {
    every_view_has_the_same_contours_within_its_distance();
}
RC_GTEST_PROP(ClusterHierarchies, ClustersArePartsOfTheSurface, ()) { clusters_are_parts_of_the_surface(); }
RC_GTEST_PROP(ClusterHierarchies, TheCoarsestSurfaceHasTheSameContours, ()) { the_coarsest_surface_has_the_same_contours(); }
RC_GTEST_PROP(ClusterHierarchies, TheChoiceOfNothingIsTheExactSurface, ()) { the_choice_of_nothing_is_the_exact_surface(); }
RC_GTEST_PROP(ClusterHierarchies, HaveTheSameBytesForAnyThreads, ()) { hierarchies_have_the_same_bytes_for_any_threads(); }

}  // namespace
}  // namespace oracle

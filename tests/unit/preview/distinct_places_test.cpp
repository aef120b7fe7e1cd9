// Points of a surface on a coarse lattice have places of their own, and triangles an area.
#include "preview/distinct_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "isoatlas/phantom.h"
#include "isoatlas/surface.h"

namespace isoatlas {
namespace {

struct Rounded {
    std::vector<LatticePlace> places;
    std::vector<unsigned> corners;
};

/// steps: a voxel.
Rounded rounded(const Surface& surface, double steps) {
    Rounded result;
    for (const Vec3& point : surface.points) {
        LatticePlace place{};
        for (std::size_t axis = 0; axis < 3; ++axis) place[axis] = static_cast<std::uint16_t>(std::lround(steps * (point[axis] + 1)));
        result.places.push_back(place);
    }
    for (const auto& triangle : surface.triangles) {
        for (const auto corner : triangle) result.corners.push_back(static_cast<unsigned>(corner));
    }
    return result;
}

bool has_area(const LatticePlace& p, const LatticePlace& q, const LatticePlace& r) {
    std::array<std::int64_t, 3> a{}, b{};
    for (std::size_t axis = 0; axis < 3; ++axis) a[axis] = q[axis] - p[axis], b[axis] = r[axis] - p[axis];
    return a[0] * b[1] != a[1] * b[0] || a[1] * b[2] != a[2] * b[1] || a[2] * b[0] != a[0] * b[2];
}

std::size_t flat_ones(const Rounded& mesh) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
        count += !has_area(mesh.places[mesh.corners[c]], mesh.places[mesh.corners[c + 1]], mesh.places[mesh.corners[c + 2]]);
    return count;
}

std::size_t different(const Rounded& mesh) { return std::set(mesh.places.begin(), mesh.places.end()).size(); }

TEST(DistinctPlaces, NoTwoAreTheSameAndNoTriangleIsFlat) {
    for (const std::int64_t seed : {1, 2, 3}) {
        for (const double steps : {200.0, 20.0, 6.0}) {
            SCOPED_TRACE(steps);
            const Surface surface = extract(make_phantom("noise", {.size = 14, .seed = static_cast<std::uint64_t>(seed)}), 0.5);
            Rounded mesh = rounded(surface, steps);
            const Rounded before = mesh;
            ASSERT_LT(different(mesh), mesh.places.size());
            ASSERT_GT(flat_ones(mesh), 0U);
            EXPECT_EQ(make_places_distinct(mesh.places, mesh.corners), 0U);
            EXPECT_EQ(different(mesh), mesh.places.size());
            EXPECT_EQ(flat_ones(mesh), 0U);
            for (std::size_t i = 0; i < mesh.places.size(); ++i) {
                for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(mesh.places[i][axis] - before.places[i][axis]), 12);
            }
        }
    }
}

TEST(DistinctPlaces, WhatHasNeitherStaysAsItIs) {
    Rounded mesh{{{5, 5, 5}, {9, 5, 5}, {5, 6, 5}, {5, 5, 65535}}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
    const Rounded before = mesh;
    EXPECT_EQ(make_places_distinct(mesh.places, mesh.corners), 0U);
    EXPECT_EQ(mesh.places, before.places);
}

TEST(DistinctPlaces, ALatticeThatIsTooCoarseIsToldOf) {
    std::vector<LatticePlace> places(3000, LatticePlace{0, 0, 0});  // 343 places are within reach in this corner
    std::vector<unsigned> corners;
    for (unsigned i = 0; i + 2 < places.size(); i += 3) corners.insert(corners.end(), {i, i + 1, i + 2});
    EXPECT_GT(make_places_distinct(places, corners), 0U);
}

}  // namespace
}  // namespace isoatlas

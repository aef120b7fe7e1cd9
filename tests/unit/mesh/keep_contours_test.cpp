#include "mesh/keep_contours.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

namespace isoatlas {
namespace {

constexpr int kContours = 5;

/// Points of five contours, mixed, with triangles and segments whose points are of one contour: more than a thread takes at once.
Surface mixed_contours(bool normals) {
    constexpr std::int64_t kPoints = 100'000, kSimplices = 200'000;
    std::mt19937_64 random(7);
    Surface surface;
    std::vector<std::vector<std::int64_t>> points_of(kContours);
    for (std::int64_t i = 0; i < kPoints; ++i) {
        const auto contour = static_cast<std::int64_t>(random() % kContours);
        points_of[contour].push_back(i);
        surface.points.push_back({static_cast<double>(i), 0, static_cast<double>(contour)});
        surface.contour.push_back(contour);
        if (normals) surface.normals.push_back({static_cast<float>(i), 1, 0});
    }
    for (std::int64_t i = 0; i < kSimplices; ++i) {
        const std::vector<std::int64_t>& points = points_of[random() % kContours];
        const auto any = [&] { return points[random() % points.size()]; };
        surface.triangles.push_back({any(), any(), any()});
        surface.segments.push_back({any(), any()});
    }
    return surface;
}

/// What keep_contours() is to leave, one after another.
Surface kept_one_by_one(const std::vector<bool>& chosen, const Surface& surface) {
    Surface kept;
    std::vector<std::int64_t> place;
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
        place.push_back(std::ssize(kept.points));
        if (!chosen[surface.contour[i]]) continue;
        kept.points.push_back(surface.points[i]);
        kept.contour.push_back(surface.contour[i]);
        if (!surface.normals.empty()) kept.normals.push_back(surface.normals[i]);
    }
    for (const auto& [a, b, c] : surface.triangles) {
        if (chosen[surface.contour[a]]) kept.triangles.push_back({place[a], place[b], place[c]});
    }
    for (const auto& [a, b] : surface.segments) {
        if (chosen[surface.contour[a]]) kept.segments.push_back({place[a], place[b]});
    }
    return kept;
}

TEST(KeepContours, AsOneByOneForAnyNumberOfThreads) {
    for (const bool normals : {true, false}) {
        const Surface all = mixed_contours(normals);
        for (const std::vector<bool>& chosen : {std::vector<bool>{true, false, true, true, false},
                                                {true, true, true, true, true},
                                                {false, false, false, false, false},
                                                {false, false, false, false, true}}) {
            IdArray<ContourNumber, std::uint8_t> flags(kContours);
            for (int i = 0; i < kContours; ++i) flags[ContourNumber(i)] = chosen[i];
            const Surface expected = kept_one_by_one(chosen, all);
            for (const int threads : {1, 2, 3}) {
                Context context;
                context.threads = threads;
                Surface surface = all;
                keep_contours(flags, context, surface);
                EXPECT_EQ(surface.points, expected.points);
                EXPECT_EQ(surface.contour, expected.contour);
                EXPECT_EQ(surface.normals, expected.normals);
                EXPECT_EQ(surface.triangles, expected.triangles);
                EXPECT_EQ(surface.segments, expected.segments);
            }
        }
    }
}

}  // namespace
}  // namespace isoatlas

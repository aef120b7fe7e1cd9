// The strip between two polygons has the smallest area of all strips.
#include "methods/surfaces/tiling.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <numeric>

#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::Strip;
using isoatlas::Vec3;

std::vector<Vec3> polygon(double z) {
    const int corners = *rc::gen::inRange(3, 7);
    std::vector<Vec3> polygon;
    for (int i = 0; i < corners; ++i) {
        const auto number = [] { return static_cast<double>(*rc::gen::inRange(0, 12)); };
        polygon.push_back({number(), number(), z});
    }
    return polygon;
}

/// Of all starts and all orders of m + n steps.
double least_area(const std::vector<Vec3>& lower, const std::vector<Vec3>& upper) {
    double least = std::numeric_limits<double>::infinity();
    const std::size_t m = lower.size(), n = upper.size();
    std::vector<bool> steps(m + n, false);
    std::fill(steps.begin() + static_cast<std::ptrdiff_t>(n), steps.end(), true);
    do {
        for (std::size_t start = 0; start < m; ++start)
            least = std::min(least, isoatlas::area_of({static_cast<std::int64_t>(start), steps}, lower, upper));
    } while (std::next_permutation(steps.begin(), steps.end()));
    return least;
}

RC_GTEST_PROP(Tiling, HasTheSmallestArea, ()) {
    const std::vector<Vec3> lower = polygon(0), upper = polygon(1);
    const Strip strip = isoatlas::tile(lower, upper);
    RC_ASSERT(strip.is_lower.size() == lower.size() + upper.size());
    RC_ASSERT(std::count(strip.is_lower.begin(), strip.is_lower.end(), true) == std::ssize(lower));
    RC_ASSERT(isoatlas::area_of(strip, lower, upper) <= least_area(lower, upper) * (1 + 1e-12));
}

TEST(Tiling, OfLongPolygonsIsGoodEnough) {
    const auto circle = [](std::size_t corners, double z) {
        std::vector<Vec3> polygon;
        for (std::size_t i = 0; i < corners; ++i) {
            const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners);
            polygon.push_back({100 * std::cos(angle), 100 * std::sin(angle), z});
        }
        return polygon;
    };
    for (const std::size_t corners : {200U, 300U}) {  // below and above isoatlas::kMaxOptimalGrid
        const std::vector<Vec3> lower = circle(corners, 0), upper = circle(corners + 100, 1);
        EXPECT_NEAR(isoatlas::area_of(isoatlas::tile(lower, upper), lower, upper) / (6.283185307179586 * 100), 1, 0.01);
    }
}

}  // namespace
}  // namespace oracle

// The interpolant at eight places against the sum over the corners, term by term.
#include "render/trilinear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "render/gradient_grid.h"

namespace isoatlas {
namespace {

/// Sum over all samples of the sample times its tent along each axis.
template <class T>
double sum_of_tents(const Volume& volume, const Vec3& place) {
    double sum = 0;
    const Extent& extent = volume.info.extent;
    for (std::int64_t i = 0; i < extent.voxels(); ++i) {
        const Index3 at = extent.voxel(i);
        double weight = 1;
        for (int a = 0; a < 3; ++a) weight *= std::max(0.0, 1 - std::abs(place[a] - static_cast<double>(at[a])));
        sum += weight * static_cast<double>(volume.samples<T>()[i]);
    }
    return sum;
}

template <class T>
class TrilinearOf : public testing::Test {
protected:
    std::mt19937_64 random{7};
    double below(double n) { return std::uniform_real_distribution<double>(0, n)(random); }
    Volume some_volume() {
        Index3 size;
        for (int a = 0; a < 3; ++a) size[a] = 1 + static_cast<std::int64_t>(below(5));
        Volume volume = make_volume({.rank = 3, .size = size}, value_type_of<T>);
        for (T& sample : volume.samples<T>()) sample = static_cast<T>(below(120));
        return volume;
    }
    /// Among them samples, and places beside the border by rounding.
    Vec3 some_place(const Volume& volume) {
        Vec3 place;
        for (int a = 0; a < 3; ++a) {
            const auto last = static_cast<double>(volume.info.extent.size[a] - 1);
            const std::array<double, 6> places{0, last, std::floor(below(last)), -1e-6, last + 1e-6, below(last)};
            place[a] = places[static_cast<std::size_t>(below(9)) % 6];
        }
        return place;
    }
};
constexpr double kTolerance = 1e-3;  // places outside by 1e-6, samples up to 120
constexpr Transfer::Scale kScale{.zero = 5, .factor = 0.5, .last = 40};

using SampleTypes = testing::Types<std::uint8_t, std::int8_t, std::uint16_t, std::int16_t, std::uint32_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(TrilinearOf, SampleTypes);

TYPED_TEST(TrilinearOf, FallsAreDifferencesOfValues) {
    for (int n = 0; n < 1000; ++n) {
        const Volume volume = this->some_volume();
        const Vec3 place = this->some_place(volume);
        Vec3 fall;
        Trilinear<TypeParam>(volume, kScale).fall(place, fall);
        for (int a = 0; a < 3; ++a) {
            Vec3 low = place, high = place;
            low[a] = std::max(0.0, low[a] - 1);
            high[a] = std::min(static_cast<double>(volume.info.extent.size[a] - 1), high[a] + 1);
            const double expected = (sum_of_tents<TypeParam>(volume, low) - sum_of_tents<TypeParam>(volume, high)) / 2;
            ASSERT_NEAR(fall[a], expected, kTolerance) << n << ' ' << a;
        }
    }
}

TYPED_TEST(TrilinearOf, GradientsAtSamplesGiveTheSameFalls) {
    for (int n = 0; n < 1000; ++n) {
        const Volume volume = this->some_volume();
        const Vec3 place = this->some_place(volume);
        Vec3 fall, between;
        Trilinear<TypeParam>(volume, kScale).fall(place, fall);
        GradientGrid(volume, 1).fall(place, between);
        for (int a = 0; a < 3; ++a) ASSERT_NEAR(fall[a], between[a], kTolerance) << n << ' ' << a;
    }
}

TYPED_TEST(TrilinearOf, PlacesAreThoseOfSumsOfTentsAtTheEndsOfSegments) {
    for (int n = 0; n < 1000; ++n) {
        const Volume volume = this->some_volume();
        const Vec3 from = this->some_place(volume), to = this->some_place(volume);
        const RaySegments ray{from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}, 0.01 + this->below(0.3), 0.7, 0, 1};
        const auto segment = static_cast<std::int64_t>(this->below(5)) - 1;
        std::array<double, kLanes> t;
        std::array<float, kLanes> found;
        Trilinear<TypeParam>(volume, kScale).places(ray, segment, t, found);
        for (std::size_t k = 0; k < kLanes; ++k) {
            ASSERT_EQ(t[k], ray.end_of(segment + static_cast<std::int64_t>(k)));
            const Vec3 place{from[0] + t[k] * ray.way[0], from[1] + t[k] * ray.way[1], from[2] + t[k] * ray.way[2]};
            const double value = sum_of_tents<TypeParam>(volume, place);
            ASSERT_NEAR(found[k], std::clamp((value - kScale.zero) * kScale.factor, 0.0, kScale.last), kTolerance) << n << ' ' << k;
        }
    }
}

}  // namespace
}  // namespace isoatlas

// Pure noise has no significant object but the main branch (docs/theory/8-noise-and-stability.md#how-high-noise-rises). Measured in 3D, not
// proved: fixed seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/portable.h"
#include "isoatlas/cavities.h"
#include "isoatlas/objects.h"

namespace isoatlas {
namespace {

/// Independent normal samples around 128, sigma 12 (Box, Muller 1958).
Volume white_noise(std::int64_t size, ValueType type, std::uint64_t seed) {
    Volume volume = make_volume({3, {size, size, size}}, type);
    Random random(seed);
    visit_type(type, [&]<class T>(T) {
        for (T& sample : volume.samples<T>()) {
            const double radius = std::sqrt(-2 * std::log(1 - random.unit())), value = 128 + 12 * radius * cos_turns(random.unit());
            sample = static_cast<T>(std::is_integral_v<T> ? std::clamp(std::round(value), 0.0, 255.0) : value);
        }
    });
    return volume;
}

void expect_only_the_main_branch(const Volume& volume) {
    const Analysis analysis = analyse(volume);
    const ObjectTable table = rank_objects(volume, analysis, {.top = 0});
    EXPECT_GT(table.branches, 50);
    EXPECT_FALSE(table.entries.empty());
    for (const ObjectEntry& entry : table.entries)
        EXPECT_TRUE(entry.main_branch) << entry.voxels << " voxels, appears at " << entry.appears << ", merges at " << entry.merges;
}

TEST(PureNoise, HasNoSignificantObjectWhateverTheSeed) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        expect_only_the_main_branch(white_noise(32, ValueType::f32, seed));
    }
}

TEST(PureNoise, HasNoSignificantObjectInAnyType) {
    for (const ValueType type : {ValueType::u8, ValueType::u16, ValueType::i16, ValueType::i32, ValueType::f32, ValueType::f64}) {
        for (const std::uint64_t seed : {101, 102, 103}) {
            SCOPED_TRACE(std::string(name_of(type)) + " " + std::to_string(seed));
            expect_only_the_main_branch(white_noise(24, type, seed));
        }
    }
}

TEST(PureNoise, HasNoSignificantObjectInAnySize) {
    for (const std::int64_t size : {16, 48, 64}) {
        SCOPED_TRACE(size);
        expect_only_the_main_branch(white_noise(size, ValueType::u8, 7));
    }
}

}  // namespace
}  // namespace isoatlas

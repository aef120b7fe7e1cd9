// Bits of bricks are those of their samples; bricks beside a surface are those with another class among the samples that matter to them.
#include "bricks/brick_bits.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "arbitrary_scene.h"
#include "bricks/brick_classes.h"

namespace isoatlas {
namespace {

template <class T>
void bits_are_those_of_samples(T low, T high) {
    const Index3 size{*rc::gen::inRange<std::int64_t>(1, 17), *rc::gen::inRange<std::int64_t>(1, 9), *rc::gen::inRange<std::int64_t>(1, 9)};
    std::vector<T> samples(static_cast<std::size_t>(kBrickSamples));
    for (T& sample : samples) sample = *rc::gen::element(low, T{0}, T{1}, high);
    const T min = *rc::gen::element(low, T{0}, T{1}, high);
    const BrickBits bits = bits_of_brick(samples.data(), size, min);
    for (std::int64_t z = 0; z < 8; ++z) {
        for (std::int64_t y = 0; y < 8; ++y) {
            for (std::int64_t x = 0; x < 16; ++x) {
                const bool inside = x < size[0] && y < size[1] && z < size[2];
                const bool expected = inside && samples[static_cast<std::size_t>(x + 16 * (y + 8 * z))] >= min;
                RC_ASSERT((bits[static_cast<std::size_t>(y + 8 * z)] >> x & 1) == int{expected});
            }
        }
    }
}

RC_GTEST_PROP(BrickBits, AreThoseOfSamples, ()) {
    bits_are_those_of_samples<std::uint8_t>(0, 255);
    bits_are_those_of_samples<std::int8_t>(-128, 127);
    bits_are_those_of_samples<std::uint16_t>(0, 65535);
    bits_are_those_of_samples<std::int16_t>(-32768, 32767);
    bits_are_those_of_samples<std::uint32_t>(0, 4294967295U);
    bits_are_those_of_samples<std::int32_t>(-2147483647, 2147483647);
    bits_are_those_of_samples<float>(-1e30F, 1e30F);
    bits_are_those_of_samples<double>(-1e300, 1e300);
}

/// As bricks/brick_surroundings.h says in words, sample by sample. In an image nothing lies before or behind it. What lies outside the
/// volume is reached by one step only: normals at its border are those of the border and read no samples.
bool is_significant_to_another(const Scene& scene, const Box& box, bool own) {
    const std::int64_t reach_z = scene.grid.extent.rank == 2 ? 0 : 2;
    for (std::int64_t z = box.begin[2] - reach_z; z < box.end[2] + reach_z; ++z) {
        for (std::int64_t y = box.begin[1] - 2; y < box.end[1] + 2; ++y) {
            for (std::int64_t x = box.begin[0] - 2; x < box.end[0] + 2; ++x) {
                const Index3 at{x, y, z};
                std::int64_t steps = 0, furthest = 0;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::int64_t away = std::max<std::int64_t>({0, box.begin[axis] - at[axis], at[axis] - box.end[axis] + 1});
                    steps += away;
                    furthest = std::max(furthest, away);
                }
                const bool is_near = furthest <= 1 || (steps <= 2 && scene.contains(x, y, z));
                if (is_near && scene.at(x, y, z) != own) return true;
            }
        }
    }
    return false;
}

RC_GTEST_PROP(BricksBesideASurface, HaveAnotherClassAmongWhatMatters, ()) {
    const Scene scene = arbitrary_scene();
    HighBits high(scene.grid.extent);
    LevelBricks bricks{scene.grid, IdArray<BrickId, BrickClass>(static_cast<std::size_t>(scene.grid.count())), {}, {}};
    IdArray<BrickId, BrickFaces> sides(bricks.classes.size());
    for (const BrickId b : scene.grid.bricks()) {
        const Box box = scene.grid.box(b);
        const BrickBits bits = scene.bits(b);
        bricks.classes[b] = scene.class_of(b);
        put_brick(bits, box, high);
        sides[b] = sides_of(bits, box.size());
    }
    std::vector<BrickId> expected;
    for (const BrickId b : scene.grid.bricks()) {
        const BrickClass own = bricks.classes[b];
        if (own != BrickClass::divided && is_significant_to_another(scene, scene.grid.box(b), own == BrickClass::high))
            expected.push_back(b);
    }
    RC_ASSERT(beside_surface(high, bricks, sides, 1) == expected);
}

}  // namespace
}  // namespace isoatlas

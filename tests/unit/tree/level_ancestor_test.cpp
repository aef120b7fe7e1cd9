// A climb by jumps ends where a climb by single steps ends, and takes few steps.
#include "tree/level_ancestor.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>

namespace isoatlas {
namespace {

RC_GTEST_PROP(Climbs, EndWhereSingleStepsEnd, ()) {
    const auto n = *rc::gen::element<std::uint32_t>(1, 2, 3, 30, 1000);
    const auto reach = *rc::gen::element<std::uint32_t>(1, 3, 1000);  // 1: a single path
    const bool down = *rc::gen::inRange(0, 2) == 1;
    std::vector<std::uint32_t> parent(n);
    std::uint64_t state = *rc::gen::inRange<std::uint64_t>(0, 1000000);
    for (std::uint32_t i = 0; i < n; ++i) {  // towards smaller ids, or mirrored towards larger ones
        state = state * 6364136223846793005U + 1442695040888963407U;
        const std::uint32_t p = i == 0 ? 0 : i - 1 - static_cast<std::uint32_t>(state >> 33) % std::min(i, reach);
        parent[down ? n - 1 - i : i] = down ? n - 1 - p : p;
    }
    using Element = ElementIdOf<std::uint32_t>;
    const LevelAncestor<Element> climber{IdSpan<Element, const Element>(ids_of<Element>(parent))};
    for (int climb = 0; climb < 20; ++climb) {
        const auto start = *rc::gen::inRange<std::uint32_t>(0, n), limit = *rc::gen::inRange<std::uint32_t>(0, n);
        int asked = 0;
        const auto belongs = [&](std::uint32_t x) {
            ++asked;
            return x == start || (down ? x <= limit : x >= limit);
        };
        std::uint32_t expected = start;
        while (parent[expected] != expected && belongs(parent[expected])) expected = parent[expected];
        asked = 0;
        RC_ASSERT(climber.climb(Element(start), [&](Element x) { return belongs(x.number()); }) == Element(expected));
        RC_ASSERT(asked <= 8 * std::bit_width(n) + 8);
    }
}

}  // namespace
}  // namespace isoatlas

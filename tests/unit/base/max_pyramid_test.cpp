// The pyramid finds what a loop over all entries finds.
#include "base/max_pyramid.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>

namespace isoatlas {
namespace {

template <class Compare>
void check(const std::vector<std::uint32_t>& entries, std::size_t begin, std::size_t end, std::uint32_t limit) {
    std::vector<std::size_t> expected, found;
    for (std::size_t i = begin; i < end; ++i) {
        if (entries[i] == limit || Compare()(entries[i], limit)) expected.push_back(i);
    }
    const MaxPyramid<std::uint32_t, Compare> pyramid{std::span<const std::uint32_t>(entries)};
    pyramid.for_each_at_least(begin, end, limit, [&](std::size_t i) { found.push_back(i); });
    RC_ASSERT(found == expected);
}

RC_GTEST_PROP(MaxPyramidTest, FindsAllEntriesThatReachALimit, ()) {
    const auto size = *rc::gen::element<std::size_t>(0, 1, 2, 15, 16, 17, 255, 256, 257, 300, 5000);
    const auto max = *rc::gen::element<std::uint32_t>(1, 10, 10000);
    std::vector<std::uint32_t> entries(size);
    std::uint64_t state = *rc::gen::inRange<std::uint64_t>(0, 1000000);
    for (std::uint32_t& entry : entries) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        entry = static_cast<std::uint32_t>(state >> 33) % max;
        if ((state >> 20) % 4 != 0) entry /= 8;  // few reach the limit
    }
    const std::size_t end = *rc::gen::inRange<std::size_t>(0, size + 1), begin = *rc::gen::inRange<std::size_t>(0, end + 1);
    const auto limit = *rc::gen::inRange<std::uint32_t>(0, max + 1);
    check<std::greater<>>(entries, begin, end, limit);
    check<std::less<>>(entries, begin, end, limit);
}

}  // namespace
}  // namespace isoatlas

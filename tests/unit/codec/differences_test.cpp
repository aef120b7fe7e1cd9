// Differences are those of the definition, and nothing is lost.
#include "codec/differences.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "codec/whole_brick.h"

namespace isoatlas {
namespace {

struct Boxed {
    Index3 size;
    Orders orders;
    std::vector<std::uint8_t> numbers;
};

Boxed arbitrary_box() {
    Boxed box;
    for (std::int64_t& n : box.size) n = *rc::gen::inRange<std::int64_t>(1, 7);
    for (int& order : box.orders) order = *rc::gen::inRange(0, 3);
    box.numbers = *rc::gen::container<std::vector<std::uint8_t>>(static_cast<std::size_t>(box.size[0] * box.size[1] * box.size[2]),
                                                                 rc::gen::arbitrary<std::uint8_t>());
    return box;
}

/// The difference along the axes from `axis` on, by its definition.
int difference(const Boxed& box, Index3 at, std::size_t axis) {
    if (axis == 3) return box.numbers[static_cast<std::size_t>(at[0] + box.size[0] * (at[1] + box.size[1] * at[2]))];
    static constexpr std::array<std::array<int, 3>, 3> kWeights{{{1, 0, 0}, {1, -1, 0}, {1, -2, 1}}};
    const auto order = static_cast<std::size_t>(std::min<std::int64_t>(box.orders[axis], at[axis]));
    int sum = 0;
    for (std::size_t back = 0; back <= order; ++back, --at[axis]) sum += kWeights[order][back] * difference(box, at, axis + 1);
    return sum;
}

RC_GTEST_PROP(Differences, AreThoseOfTheDefinition, ()) {
    const Boxed box = arbitrary_box();
    std::vector<std::uint8_t> taken = box.numbers;
    take_differences<std::uint8_t>(taken, box.size, box.orders);
    std::size_t i = 0;
    for (std::int64_t z = 0; z < box.size[2]; ++z) {
        for (std::int64_t y = 0; y < box.size[1]; ++y) {
            for (std::int64_t x = 0; x < box.size[0]; ++x)
                RC_ASSERT(taken[i++] == static_cast<std::uint8_t>(difference(box, {x, y, z}, 0)));
        }
    }
    undo_differences<std::uint8_t>(taken, box.size, box.orders);
    RC_ASSERT(taken == box.numbers);
}

template <class N>
void check_whole_brick(const Orders& orders) {
    auto arranged = *rc::gen::container<std::vector<N>>(static_cast<std::size_t>(kBrickSamples), rc::gen::arbitrary<N>());
    std::vector<N> copy = arranged, expected(arranged.size()), restored(arranged.size());
    disarrange<N>(copy, kBrickSize, orders, expected);
    undo_differences<N>(expected, kBrickSize, orders);
    restore_whole_brick<N>(arranged, orders, restored);
    RC_ASSERT(restored == expected);
}

RC_GTEST_PROP(Differences, OfAWholeBrickAreUndoneAtOnce, ()) {
    Orders orders;
    for (int& order : orders) order = *rc::gen::inRange(0, 3);
    check_whole_brick<std::uint8_t>(orders);
    check_whole_brick<std::uint16_t>(orders);
    check_whole_brick<std::uint32_t>(orders);
    check_whole_brick<std::uint64_t>(orders);
}

RC_GTEST_PROP(Differences, AreArrangedAndBack, ()) {
    const Boxed box = arbitrary_box();
    std::vector<std::uint8_t> arranged(box.numbers.size()), back(box.numbers.size());
    arrange<std::uint8_t>(box.numbers, box.size, box.orders, arranged);
    disarrange<std::uint8_t>(arranged, box.size, box.orders, back);
    RC_ASSERT(back == box.numbers);
}

TEST(Differences, HeadsOfRowsAndColumnsComeFirst) {
    const std::vector<std::uint8_t> numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    std::vector<std::uint8_t> arranged(12);
    arrange<std::uint8_t>(numbers, {3, 2, 2}, {2, 1, 0}, arranged);
    const std::vector<std::uint8_t> order{0, 6, 3, 9, 1, 7, 4, 10, 2, 8, 5, 11};
    for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(arranged[i], 2 * order[i]);
    std::vector<std::uint8_t> signs{255, 1, 254}, mixed(3);
    arrange<std::uint8_t>(signs, {1, 1, 3}, {0, 0, 1}, mixed);
    EXPECT_EQ(mixed, (std::vector<std::uint8_t>{1, 2, 3}));
}

}  // namespace
}  // namespace isoatlas

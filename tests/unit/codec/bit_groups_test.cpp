// Groups of numbers come back, take the bytes that were promised, and are safe to read whatever they are.
#include "codec/bit_groups.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>

namespace isoatlas {
namespace {

template <class N>
std::vector<N> arbitrary_numbers() {
    std::vector<N> numbers;
    for (int group = *rc::gen::inRange(1, 40); group > 0; --group) {
        const int width = *rc::gen::inRange(0, static_cast<int>(8 * sizeof(N)) + 1);
        const auto raw = *rc::gen::container<std::vector<std::uint64_t>>(kGroup, rc::gen::arbitrary<std::uint64_t>());
        for (const std::uint64_t r : raw)
            numbers.push_back(width == 0 ? N{0} : static_cast<N>(static_cast<N>(r) >> (8 * sizeof(N) - width)));
    }
    return numbers;
}

template <class N>
void check_round_trip() {
    const std::vector<N> numbers = arbitrary_numbers<N>();
    std::vector<std::byte> packed;
    pack_groups<N>(numbers, packed);
    RC_ASSERT(static_cast<std::int64_t>(packed.size()) == group_bytes<N>(numbers));
    packed.push_back(std::byte{77});
    std::vector<N> back(numbers.size());
    std::span<const std::byte> rest = packed;
    RC_ASSERT(unpack_groups<N>(rest, back));
    RC_ASSERT(back == numbers);
    RC_ASSERT(rest.size() == 1U);
    for (std::size_t size = 0; size + 1 < packed.size(); ++size) {
        std::span<const std::byte> cut = std::span(packed).first(size);
        RC_ASSERT(!unpack_groups<N>(cut, back));
    }
}

RC_GTEST_PROP(BitGroups, ComeBack, ()) {
    check_round_trip<std::uint8_t>();
    check_round_trip<std::uint16_t>();
    check_round_trip<std::uint32_t>();
    check_round_trip<std::uint64_t>();
}

// Never more than the widest number for all of them, nor more than 3 bits a group above what its own width takes.
RC_GTEST_PROP(BitGroups, AreSmall, ()) {
    const auto numbers = arbitrary_numbers<std::uint32_t>();
    const auto groups = static_cast<std::int64_t>(numbers.size() / kGroup);
    std::int64_t own = 0, widest = 0;
    for (std::int64_t g = 0; g < groups; ++g) {
        std::int64_t width = 0;
        for (std::int64_t i = 0; i < 8; ++i)
            width = std::max<std::int64_t>(width, std::bit_width(numbers[static_cast<std::size_t>(8 * g + i)]));
        own += width, widest = std::max(widest, width);
    }
    RC_ASSERT(group_bytes<std::uint32_t>(numbers) <= 2 + groups * widest);
    RC_ASSERT(group_bytes<std::uint32_t>(numbers) <= 2 + own + (groups + 7) / 8 * 6);
}

RC_GTEST_PROP(BitGroups, AnyBytesAreSafe, (const std::vector<std::uint8_t>& bytes)) {
    std::vector<std::uint16_t> numbers(8 * *rc::gen::inRange<std::size_t>(1, 20));
    std::span<const std::byte> packed = std::as_bytes(std::span(bytes));
    (void)unpack_groups<std::uint16_t>(packed, numbers);
    RC_ASSERT(packed.size() <= bytes.size());
}

TEST(BitGroups, BytesAreThoseOfTheDocument) {
    const std::vector<std::uint16_t> numbers{1, 0, 0, 0, 0, 0, 0, 2, 0x1ff, 0, 0, 0, 0, 0, 0, 0x1aa};
    std::vector<std::byte> packed;
    pack_groups<std::uint16_t>(numbers, packed);
    // Widths 2 and 9 as 2 and 2 + 7, 3 bits of each: 0b10, 0b10, 0b10. Then 2 bits of 8 numbers. Then their low bytes, and their ninth
    // bits.
    const std::vector<int> bytes{2, 3, 2, 2, 2, 1, 128, 0xff, 0, 0, 0, 0, 0, 0, 0xaa, 0x81};
    ASSERT_EQ(packed.size(), bytes.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(static_cast<int>(packed[i]), bytes[i]) << i;
}

}  // namespace
}  // namespace isoatlas

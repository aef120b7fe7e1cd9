// A brick comes back bit by bit, whatever is in it.
#include "store/brick_codec.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "oracle/volumes.h"

namespace isoatlas::store {
namespace {

template <class T>
void check_round_trip(const std::vector<T>& samples) {
    const T low = *std::min_element(samples.begin(), samples.end()), high = *std::max_element(samples.begin(), samples.end());
    const int bits = bits_of_range(low, high);
    ASSERT_LE(bits, static_cast<int>(8 * sizeof(T)));
    std::vector<std::byte> packed{std::byte{7}};
    encode_brick<T>(samples, low, bits, packed);
    const auto bytes = static_cast<std::size_t>(packed_bytes(static_cast<std::int64_t>(samples.size()), bits));
    ASSERT_EQ(packed.size(), 1 + bytes);
    std::vector<T> back(samples.size());
    decode_brick<T>(std::span(packed).subspan(1), low, bits, back);
    ASSERT_EQ(std::memcmp(back.data(), samples.data(), samples.size() * sizeof(T)), 0) << "bits " << bits;
}

template <class T>
std::vector<T> arbitrary_samples() {
    const auto raw = *rc::gen::nonEmpty(rc::gen::arbitrary<std::vector<std::uint64_t>>());
    const int bits = *rc::gen::inRange(0, 65);
    std::vector<T> samples;
    for (const std::uint64_t r : raw) {
        const std::uint64_t few = bits == 64 ? r : r & ((std::uint64_t{1} << bits) - 1);
        if constexpr (std::is_integral_v<T>) {
            samples.push_back(static_cast<T>(few));
        } else {
            samples.push_back(static_cast<T>(std::ldexp(static_cast<double>(few) - 1e4, *rc::gen::inRange(-60, 60))));
        }
    }
    return samples;
}

RC_GTEST_PROP(BrickCodec, GivesTheSameBits, ()) {
    check_round_trip(arbitrary_samples<std::uint8_t>());
    check_round_trip(arbitrary_samples<std::int8_t>());
    check_round_trip(arbitrary_samples<std::uint16_t>());
    check_round_trip(arbitrary_samples<std::int16_t>());
    check_round_trip(arbitrary_samples<std::uint32_t>());
    check_round_trip(arbitrary_samples<std::int32_t>());
    check_round_trip(arbitrary_samples<float>());
    check_round_trip(arbitrary_samples<double>());
}

TEST(BrickCodec, ExtremesAndZeros) {
    check_round_trip<double>({std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max(), 0, 5e-324, -5e-324});
    check_round_trip<float>({std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max(), 0, 1e-45F});
    check_round_trip<std::int32_t>({std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max(), 0, -1});
    EXPECT_EQ(bits_of_range<std::uint16_t>(7, 7), 0);
    EXPECT_EQ(bits_of_range<std::int8_t>(-1, 0), 1);
    EXPECT_EQ(packed_bytes(4096, 5), 2560);
}

}  // namespace
}  // namespace isoatlas::store

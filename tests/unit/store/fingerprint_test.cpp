// Fingerprints differ when a member does, and say which; texts of numbers tell every two numbers apart.
#include "store/fingerprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "codec/frame.h"

namespace isoatlas {
namespace {

Fingerprint example() {
    Fingerprint fingerprint;
    fingerprint.add("spacing", "1 x 1 x 1");
    fingerprint.add("unit", "");
    fingerprint.add("Gaussian", "0.5");
    return fingerprint;
}

TEST(Fingerprint, OneThatIsTheSameHasNoDifferences) {
    EXPECT_TRUE(differences(example(), example()).empty());
    EXPECT_EQ(example().hash(), example().hash());
    EXPECT_EQ(joined({}), "");
}

TEST(Fingerprint, EveryMemberThatDiffersIsSaid) {
    Fingerprint other = example();
    other.members[0].text = "2 x 2 x 2";
    other.members[1].text = "mm";
    EXPECT_EQ(joined(differences(example(), other)), "spacing 1 x 1 x 1 there, 2 x 2 x 2 here; unit none there, mm here");
    EXPECT_NE(example().hash(), other.hash());
    other.remove("Gaussian");
    EXPECT_EQ(differences(example(), other).back(), "Gaussian 0.5 there, none here");
    EXPECT_EQ(differences(other, example()).back(), "Gaussian none there, 0.5 here");
    other.add("more", "x");
    EXPECT_EQ(joined(differences(example(), other)),
              "spacing 1 x 1 x 1 there, 2 x 2 x 2 here; unit none there, mm here; more none there, x here; and 1 more");
}

TEST(Fingerprint, LongTextsThatDifferAtTheirEndsAreSaidToDiffer) {
    Fingerprint a, b;
    a.add("description", std::string(59, 'x') + "\xc3\xa4 one");  // the character is not cut in two
    b.add("description", std::string(59, 'x') + "\xc3\xa4 two");
    EXPECT_EQ(joined(differences(a, b)), "description another there, this here");
    b.members[0].text = "two";
    EXPECT_EQ(joined(differences(a, b)), "description " + std::string(59, 'x') + "... there, two here");
}

TEST(Fingerprint, TextsThatMoveBetweenMembersChangeTheHash) {
    Fingerprint a, b;
    a.add("x", "1"), a.add("y", "");
    b.add("x", ""), b.add("y", "1");
    EXPECT_NE(a.hash(), b.hash());
}

TEST(Fingerprint, NumbersThatDifferHaveTextsThatDiffer) {
    double number = 0.1;
    for (int i = 0; i < 1000; ++i, number *= 1.7) {
        const double next = std::nextafter(number, std::numeric_limits<double>::infinity());
        EXPECT_NE(exact_text(number), exact_text(next));
        EXPECT_EQ(std::stod(exact_text(number)), number);
    }
    EXPECT_EQ(exact_text({0.5, 1, 1e-7}, " x "), "0.5 x 1 x 1e-07");
    EXPECT_EQ(checksum_text(0xfe), "00000000000000fe");
}

TEST(StoreFrame, IsWhatLiesOutside) {
    using Ranges = std::vector<ByteRange>;
    EXPECT_EQ(outside({}, 10), (Ranges{{0, 10}}));
    EXPECT_EQ(outside({{2, 3}, {0, 2}, {5, 0}, {7, 2}, {7, 1}}, 10), (Ranges{{5, 2}, {9, 1}}));
    EXPECT_EQ(outside({{0, 10}}, 10), Ranges{});
}

TEST(StoreFrame, IsReadAsItWasWrittenOrRefused) {
    const StoreFrame frame{{{512, 100}, {700, 1}}, 0x123456789abcdef0U};
    const std::vector<std::byte> good = bytes_of_trailer(frame);
    constexpr std::int64_t kSize = 2000;
    EXPECT_EQ(trailer_bytes(std::span(good).last(kTrailerEnd), kSize), std::ssize(good));
    ASSERT_TRUE(frame_of_trailer(good, kSize));
    EXPECT_EQ(frame_of_trailer(good, kSize)->ranges, frame.ranges);
    EXPECT_EQ(frame_of_trailer(good, kSize)->checksum, frame.checksum);
    for (std::size_t at = 0; at < good.size(); ++at) {
        std::vector<std::byte> bad = good;
        bad[at] ^= std::byte{4};
        const std::optional<std::int64_t> size = trailer_bytes(std::span(bad).last(kTrailerEnd), kSize);
        EXPECT_TRUE(size != std::ssize(good) || !frame_of_trailer(bad, kSize)) << at;
    }
    EXPECT_FALSE(frame_of_trailer(bytes_of_trailer({{{512, 100}, {600, 1}}, 0}), kSize)) << "they overlap";
    EXPECT_FALSE(frame_of_trailer(bytes_of_trailer({{{512, 5000}}, 0}), kSize)) << "outside the file";
}

}  // namespace
}  // namespace isoatlas

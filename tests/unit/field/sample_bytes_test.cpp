// Borrowed samples stay where they are, are never written to, and live as long as somebody needs them.
#include "isoatlas/sample_bytes.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "isoatlas/analysis.h"
#include "isoatlas/polarity.h"

namespace isoatlas {
namespace {

const Extent kExtent{.rank = 3, .size = {2, 3, 4}};

std::shared_ptr<std::vector<std::int16_t>> some_samples() {
    auto samples = std::make_shared<std::vector<std::int16_t>>(24);
    for (std::size_t i = 0; i < samples->size(); ++i) (*samples)[i] = static_cast<std::int16_t>(7 * i % 13);
    return samples;
}

Volume borrow(const std::shared_ptr<std::vector<std::int16_t>>& samples) {
    return borrow_volume(kExtent, ValueType::i16, std::as_bytes(std::span(*samples)), samples);
}

TEST(SampleBytes, OfABorrowedVolumeAreNotCopied) {
    const auto samples = some_samples();
    const Volume volume = borrow(samples);
    EXPECT_EQ(static_cast<const void*>(volume.bytes.data()), samples->data());
    EXPECT_EQ(volume.samples<std::int16_t>().data(), samples->data());
    const Volume other = volume;
    EXPECT_EQ(static_cast<const void*>(other.bytes.data()), samples->data());
    EXPECT_EQ(analyse(volume).event_count(), analyse(make_volume<std::int16_t>(kExtent, *samples)).event_count());
}

TEST(SampleBytes, KeepTheirOwnerAlive) {
    auto samples = some_samples();
    const std::weak_ptr<std::vector<std::int16_t>> seen = samples;
    Volume volume = borrow(samples);
    Volume copy = volume;
    samples.reset();
    volume = Volume();
    ASSERT_FALSE(seen.expired());
    EXPECT_EQ(copy.value(1), 7);
    copy = Volume();
    EXPECT_TRUE(seen.expired());
}

TEST(SampleBytes, AreCopiedBeforeTheyAreWrittenTo) {
    const auto samples = some_samples();
    const std::vector<std::int16_t> before = *samples;
    Volume volume = borrow(samples);
    const Volume other = volume;
    volume.samples<std::int16_t>()[0] = 99;
    EXPECT_FALSE(volume.bytes.is_borrowed());
    EXPECT_EQ(volume.value(0), 99);
    EXPECT_EQ(*samples, before);
    EXPECT_EQ(other.value(0), before[0]);
    EXPECT_TRUE(other.bytes.is_borrowed());
    EXPECT_EQ(negated(negated(other)).bytes, other.bytes);
    EXPECT_EQ(*samples, before);
}

TEST(SampleBytes, OfAnotherSizeOrUnalignedAreRefused) {
    const auto samples = some_samples();
    const std::span<const std::byte> bytes = std::as_bytes(std::span(*samples));
    EXPECT_THROW((void)borrow_volume(kExtent, ValueType::i16, bytes.first(46), samples), Error);
    EXPECT_THROW((void)borrow_volume({.rank = 3, .size = {2, 3, 0}}, ValueType::i16, bytes.first(0), samples), Error);
    EXPECT_THROW((void)borrow_volume({.rank = 3, .size = {1, 1, 1}}, ValueType::i16, bytes.subspan(1, 2), samples), Error);
}

}  // namespace
}  // namespace isoatlas

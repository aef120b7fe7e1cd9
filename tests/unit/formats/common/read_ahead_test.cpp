// A file with read-ahead has the bytes, the end and the errors of the file itself.
#include "formats/common/read_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace isoatlas {
namespace {

/// Bytes of which some are damaged, read perhaps in pieces.
class OfDamagedDisk final : public File {
public:
    OfDamagedDisk(std::vector<std::byte> bytes, std::int64_t damaged, std::size_t most, int* reads)
        : bytes_(std::move(bytes)), damaged_(damaged), most_(most), reads_(reads) {}
    std::int64_t size() const override { return std::ssize(bytes_); }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        ++*reads_;
        if (offset >= size()) return 0;
        const std::size_t count = std::min({out.size(), most_, static_cast<std::size_t>(size() - offset)});
        if (damaged_ >= offset && damaged_ < offset + static_cast<std::int64_t>(count)) return -EIO;
        std::copy_n(bytes_.begin() + offset, count, out.begin());
        return static_cast<std::ptrdiff_t>(count);
    }

private:
    std::vector<std::byte> bytes_;
    std::int64_t damaged_;
    std::size_t most_;
    int* reads_;
};

class ReadAhead : public testing::Test {
protected:
    std::mt19937_64 random_{5};

    std::int64_t below(std::int64_t end) { return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(end)); }
    std::vector<std::byte> some_bytes(std::int64_t count) {
        std::vector<std::byte> bytes(static_cast<std::size_t>(count));
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(random_());
        return bytes;
    }
};

TEST_F(ReadAhead, HasTheBytesTheEndAndTheErrorsOfTheFile) {
    for (int trial = 0; trial < 300; ++trial) {
        const std::vector<std::byte> bytes = some_bytes(below(20'000));
        const std::int64_t damaged = trial % 3 == 0 ? below(20'000) : -1;
        const std::size_t most = trial % 2 == 0 ? 100'000 : 1 + static_cast<std::size_t>(below(5000));
        int reads = 0;
        OfDamagedDisk alone(bytes, damaged, most, &reads);
        const std::unique_ptr<File> ahead = with_read_ahead(std::make_unique<OfDamagedDisk>(bytes, damaged, most, &reads));
        ASSERT_EQ(ahead->size(), std::ssize(bytes));
        for (int i = 0; i < 300; ++i) {
            const std::int64_t offset = below(std::ssize(bytes) + 200);
            std::vector<std::byte> expected(static_cast<std::size_t>(below(i % 9 == 0 ? 6000 : 200))), found = expected;
            const std::ptrdiff_t count = alone.read_at(offset, expected), got = ahead->read_at(offset, found);
            ASSERT_TRUE(got == count || (got > count && count >= 0)) << "a block may have what one short read has not";
            for (std::ptrdiff_t at = 0; at < got; ++at)
                ASSERT_EQ(found[static_cast<std::size_t>(at)], bytes[static_cast<std::size_t>(offset + at)]);
        }
    }
}

/// As tifffile writes: the entries of a directory, and values that all directories share.
TEST_F(ReadAhead, ReadsTwoPlacesByTurnsOnce) {
    int reads = 0;
    const std::unique_ptr<File> file = with_read_ahead(std::make_unique<OfDamagedDisk>(some_bytes(100'000), -1, 100'000, &reads));
    std::array<std::byte, 12> entry{};
    for (std::int64_t i = 0; i < 300; ++i) {
        ASSERT_EQ(file->read_at(90'000 + 12 * i, entry), 12);
        ASSERT_EQ(file->read_at(40'000, entry), 12);
    }
    EXPECT_EQ(reads, 2);
}

}  // namespace
}  // namespace isoatlas

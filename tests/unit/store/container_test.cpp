// A store is read as it was written, or refused: every cut and every flipped byte.
#include "store/container.h"

#include <gtest/gtest.h>

#include <numeric>

#include "codec/checksum.h"
#include "faults/memory_files.h"
#include "isoatlas/error.h"
#include "store/pack.h"

namespace isoatlas {
namespace {

class Store : public testing::Test {
protected:
    Store() : in_use_(disk_) {}

    static Contents contents() {
        Contents contents;
        contents.volume.path = "small.nrrd";
        contents.volume.extent = {3, {3, 4, 5}};
        contents.volume.type = ValueType::i16;
        contents.volume.geometry.spacing = {0.5, 0.25, 2};
        contents.volume.geometry.unit = "mm";
        contents.volume.calibration.slope = 0.1;
        contents.parameters.samples_checksum = 0xfedcba9876543210U;
        return contents;
    }
    void write(const std::string& path) const {
        std::vector<std::uint32_t> numbers(50000);
        std::iota(numbers.begin(), numbers.end(), 0U);
        const std::vector<double> values{1.5, -2, 1e300};
        pack_store(path, contents(),
                   {packed<std::uint32_t>("tree/numbers", "uint32", numbers), packed<double>("tree/values", "float64", values),
                    packed<double>("empty", "float64", {})});
    }

    /// Opens and reads everything. True: it was refused.
    bool is_refused() const {
        try {
            const Container store(path_);
            store.check_all();
            const std::vector<std::uint32_t> numbers = store.all<std::uint32_t>("tree/numbers", "uint32");
            EXPECT_EQ(numbers.size(), 50000U);
            for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], i);
            EXPECT_EQ(store.all<double>("tree/values", "float64"), (std::vector<double>{1.5, -2, 1e300}));
            return false;
        } catch (const Error& error) {
            EXPECT_TRUE(error.kind() == ErrorKind::input || error.kind() == ErrorKind::unsupported) << error.what();
            return true;
        }
    }

    test::MemoryFiles disk_;
    ReplacedFileSystem in_use_;
    std::string path_ = "small.atlas";
};

TEST_F(Store, IsReadAsItWasWritten) {
    write(path_);
    EXPECT_EQ(disk_.count(), 1U);
    const Container store(path_);
    const VolumeInfo& volume = store.contents().volume;
    EXPECT_EQ(volume.extent.size, (Index3{3, 4, 5}));
    EXPECT_EQ(volume.type, ValueType::i16);
    EXPECT_EQ(volume.geometry.spacing, (Vec3{0.5, 0.25, 2}));
    EXPECT_EQ(volume.geometry.unit, "mm");
    EXPECT_EQ(volume.calibration.slope, 0.1);
    EXPECT_EQ(store.contents().parameters.samples_checksum, 0xfedcba9876543210U);
    EXPECT_TRUE(store.all<double>("empty", "float64").empty());
    EXPECT_FALSE(is_refused());
    std::vector<std::uint32_t> some(20000);  // across blocks
    store.read(store.contents().array("tree/numbers", "uint32"), 4 * 12345, std::as_writable_bytes(std::span(some)));
    for (std::size_t i = 0; i < some.size(); ++i) ASSERT_EQ(some[i], i + 12345);
    EXPECT_THROW((void)store.all<double>("tree/numbers", "float64"), Error);
    EXPECT_THROW((void)store.all<double>("nothing", "float64"), Error);
}

TEST_F(Store, TheSameArraysGiveTheSameBytes) {
    write(path_);
    const std::string first = disk_.content(path_);
    write(path_ + "2");
    EXPECT_TRUE(first == disk_.content(path_ + "2"));
}

TEST_F(Store, EveryPrefixIsRefused) {
    write(path_);
    const std::string whole = disk_.content(path_);
    for (std::size_t size = 0; size < whole.size(); size += size < 2048 ? 1 : 997) {
        disk_.content(path_) = whole.substr(0, size);
        ASSERT_TRUE(is_refused()) << size;
    }
    disk_.content(path_) = whole + "x";
    EXPECT_TRUE(is_refused());
}

TEST_F(Store, EveryFlippedByteIsRefused) {
    write(path_);
    const std::string whole = disk_.content(path_);
    for (std::size_t at = 0; at < whole.size(); at += at < 600 || at + 6000 > whole.size() ? 1 : 89) {
        char& byte = disk_.content(path_)[at];
        byte = static_cast<char>(byte ^ (1 << at % 8));
        EXPECT_TRUE(is_refused()) << at;
        byte = whole[at];
    }
    EXPECT_FALSE(is_refused());
}

TEST_F(Store, WhatHdf5AloneReadsIsCheckedWhenItIsOpened) {
    write(path_);
    const std::string whole = disk_.content(path_);
    for (const std::size_t at : {std::size_t{512}, std::size_t{540}, std::size_t{2000}}) {  // superblock, root group, a gap
        char& byte = disk_.content(path_)[at];
        byte = static_cast<char>(byte ^ 1);
        try {
            const Container store(path_);
            ADD_FAILURE() << "byte " << at;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_EQ(error.text().where, "structures of HDF5") << error.what();
        }
        byte = whole[at];
    }
}

TEST_F(Store, AByteUnderNoChecksumIsTold) {  // as a bug of the writer would leave it
    write(path_);
    std::string& content = disk_.content(path_);
    const auto bytes = std::as_bytes(std::span<const char>(content));
    const auto size = static_cast<std::int64_t>(content.size());
    const std::optional<std::int64_t> trailer = trailer_bytes(bytes.last(kTrailerEnd), size);
    ASSERT_TRUE(trailer);
    std::optional<StoreFrame> frame = frame_of_trailer(bytes.last(static_cast<std::size_t>(*trailer)), size);
    ASSERT_TRUE(frame);
    const ByteRange last = frame->ranges.back();
    frame->ranges.back().bytes -= 3;
    Checksum sum;
    for (const ByteRange& range : frame->ranges)
        sum.add(bytes.subspan(static_cast<std::size_t>(range.offset), static_cast<std::size_t>(range.bytes)));
    frame->checksum = sum.sum();
    const std::vector<std::byte> other = bytes_of_trailer(*frame);
    std::ranges::transform(other, content.end() - *trailer, [](std::byte byte) { return static_cast<char>(byte); });
    const Container store(path_);
    try {
        store.check_all();
        ADD_FAILURE() << "not noticed";
    } catch (const Error& error) {
        EXPECT_EQ(error.text().where, "byte " + std::to_string(last.offset + last.bytes - 3)) << error.what();
    }
}

TEST_F(Store, AnUnwritableFolderIsToldAndNothingIsLeft) {
    const ReplacedFileSystem in_use(system_files());
    try {
        write("no/such/folder/x.atlas");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::resource);
    }
}

}  // namespace
}  // namespace isoatlas

// Damaged files of one format: cut at every byte, every bit flipped. Whatever happens must be an Error fit for a user, and what a
// header claims must be something that the file can hold.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "unit/formats/volume/volume_files.h"

namespace isoatlas::test {

/// Opens and reads in slabs of one slice: never more than a slice is asked for before the samples of the last one have come.
inline Failure failure_of_reading(const std::string& path, std::int64_t largest_bytes, const OpenOptions& options = {}) {
    return failure_of([&] {
        const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
        const VolumeInfo& info = reader->info();
        ASSERT_LE(info.extent.voxels(), largest_bytes / static_cast<std::int64_t>(size_of(info.type)));
        static_cast<void>(read_all(*reader, 1));
        static_cast<void>(load_volume(*reader, {.action = MissingPolicy::Action::below, .value = 0, .no_data = {}}));
    });
}

inline void expect_user_error(const Failure& failure, const std::string& when) {
    EXPECT_NE(failure.kind, ErrorKind::internal) << when << ": " << failure.message;
    EXPECT_FALSE(failure.text.file.empty()) << when << ": " << failure.message;
    EXPECT_FALSE(failure.text.what.empty()) << when << ": " << failure.message;
    EXPECT_FALSE(failure.text.next.empty()) << when << ": " << failure.message;
}

/// Every proper beginning of `content` is refused (from `harmless` bytes on it may be read: nothing of worth follows).
inline void expect_truncations_refused(const std::string& name, const std::string& content, std::size_t harmless = std::string::npos,
                                       const OpenOptions& options = {}) {
    const TestFolder folder;
    for (std::size_t size = 0; size < std::min(content.size(), harmless); ++size) {
        const std::string path = folder.write(name, content.substr(0, size));
        expect_user_error(failure_of_reading(path, 1 << 30, options), name + " cut at " + std::to_string(size));
        if (testing::Test::HasFailure()) return;
    }
}

/// Every flipped bit in [begin, end) is refused or read; ratio: the most bytes of samples that a byte of the file can stand for.
inline void expect_bit_flips_harmless(const std::string& name, const std::string& content, std::size_t begin, std::size_t end,
                                      std::int64_t ratio, const OpenOptions& options = {}) {
    const TestFolder folder;
    for (std::size_t bit = 8 * begin; bit < 8 * std::min(end, content.size()); ++bit) {
        std::string damaged = content;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
        const Failure failure = failure_of_reading(folder.write(name, damaged), ratio * static_cast<std::int64_t>(content.size()), options);
        if (!failure.message.empty()) expect_user_error(failure, name + ", bit " + std::to_string(bit));
        if (testing::Test::HasFailure()) return;
    }
}

/// Slabs of any size give the same bytes as the whole, also backwards.
inline void expect_slabs_equal_whole(const std::string& path, const OpenOptions& options = {}) {
    const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
    const VolumeInfo& info = reader->info();
    const std::string whole = read_all(*reader, info.extent.size[2]);
    const std::size_t slice = whole.size() / static_cast<std::size_t>(info.extent.size[2]);
    for (std::int64_t begin = info.extent.size[2] - 1; begin >= 0; --begin) {
        for (std::int64_t end = begin; end <= info.extent.size[2]; ++end) {
            std::string slab(static_cast<std::size_t>(end - begin) * slice, '?');
            reader->read(begin, end, std::as_writable_bytes(std::span(slab)));
            ASSERT_TRUE(whole.compare(static_cast<std::size_t>(begin) * slice, slab.size(), slab) == 0)
                << path << " [" << begin << ", " << end << ")";
        }
    }
}

}  // namespace isoatlas::test

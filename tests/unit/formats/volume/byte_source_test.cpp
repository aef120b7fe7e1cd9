// Byte sources: any sequence of seeks and reads gives the right bytes, whatever the disk does; failures name file, offset and count.
#include "formats/common/byte_source.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cerrno>

#include "formats/common/bzip2_source.h"
#include "formats/common/file_access.h"
#include "unit/formats/volume/bzip2_stream.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of;

/// A disk that gives few bytes at a time, and fails from an offset on.
class BadDisk final : public File {
public:
    BadDisk(std::unique_ptr<File> file, std::size_t max, std::int64_t fails_at, int error)
        : file_(std::move(file)), max_(max), fails_at_(fails_at), error_(error) {}
    std::int64_t size() const override { return file_->size(); }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        if (++calls_ % 3 == 0) return -EINTR;
        if (offset >= fails_at_) return error_ == 0 ? 0 : -error_;  // 0: the file became shorter while it was read
        return file_->read_at(offset, out.first(std::min(out.size(), std::min(max_, static_cast<std::size_t>(fails_at_ - offset)))));
    }

private:
    std::unique_ptr<File> file_;
    std::size_t max_;
    std::int64_t fails_at_;
    int error_;
    int calls_ = 0;
};

class WithBadDisk final : public test::ForwardingFiles {
public:
    explicit WithBadDisk(std::size_t max, std::int64_t fails_at = INT64_MAX, int error = 0)
        : max_(max), fails_at_(fails_at), error_(error), in_use_(*this) {}
    OpenedFile open(const std::string& path) override {
        return {std::make_unique<BadDisk>(ForwardingFiles::open(path).file, max_, fails_at_, error_), 0};
    }

private:
    std::size_t max_;
    std::int64_t fails_at_;
    int error_;
    ReplacedFileSystem in_use_;
};

std::string read_text(ByteSource& source, std::size_t count) {
    std::string text(count, '\0');
    source.read(std::as_writable_bytes(std::span(text)));
    return text;
}

/// The same payload behind every kind of source.
std::vector<std::unique_ptr<ByteSource>> sources_of(const test::TestFolder& folder, const std::string& payload) {
    const std::string parts = folder.write("parts", payload);
    const auto part_bytes = static_cast<std::int64_t>(payload.size()) / 3;
    std::vector<std::unique_ptr<ByteSource>> sources;
    sources.push_back(open_file_source(folder.write("plain", payload)));
    sources.push_back(open_file_source(folder.write("inside", "head" + payload + "tail"), 4, static_cast<std::int64_t>(payload.size())));
    sources.push_back(open_inflate_source(folder.write("gz", test::gzip(payload))));
    sources.push_back(open_inflate_source(folder.write("z", "head" + test::zlib(payload)), 4));
    sources.push_back(
        open_inflate_source(folder.write("members", test::gzip(payload.substr(0, 5)) + test::gzip("") + test::gzip(payload.substr(5)))));
    sources.push_back(open_inflate_source(folder.write("padded", test::gzip(payload) + std::string(9, '\0'))));
    sources.push_back(open_bzip2_source(folder.write("bz2", "head" + test::bzip2(payload)), 4));
    sources.push_back(open_bzip2_source(folder.write(
        "streams", test::bzip2(payload.substr(0, 5)) + test::bzip2("") + test::bzip2(payload.substr(5)) + std::string(9, '\0'))));
    sources.push_back(open_parts_source({.count = 3,
                                         .part_bytes = part_bytes,
                                         .size_bound = 3 * part_bytes,
                                         .random_access = true,
                                         .open = [=](std::int64_t part) { return open_file_source(parts, part * part_bytes, part_bytes); },
                                         .file = parts}));
    return sources;
}

RC_GTEST_PROP(ByteSource, AnyWalkReadsTheRightBytes, ()) {
    const test::TestFolder folder;
    const std::string payload = test::telling_bytes(static_cast<std::size_t>(3 * *rc::gen::inRange(2, 60)));
    const WithBadDisk disk(static_cast<std::size_t>(*rc::gen::inRange(1, 50)));
    const auto size = static_cast<std::int64_t>(payload.size());
    for (const std::unique_ptr<ByteSource>& source : sources_of(folder, payload)) {
        RC_ASSERT(source->size_bound() >= size);
        for (int i = 0; i < 12; ++i) {
            const auto begin = *rc::gen::inRange<std::int64_t>(0, size + 1);
            const auto count = *rc::gen::inRange<std::int64_t>(0, size - begin + 1);
            source->seek(begin);
            RC_ASSERT(read_text(*source, static_cast<std::size_t>(count)) ==
                      payload.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(count)));
            RC_ASSERT(source->payload_bytes(size + *rc::gen::inRange(0, 3)) == size);
            RC_ASSERT(size == 0 || source->payload_bytes(size - 1) == size);
        }
    }
}

TEST(ByteSource, ReadingTooMuchSaysSo) {
    const test::TestFolder folder;
    const std::string payload = test::telling_bytes(30);
    for (const std::unique_ptr<ByteSource>& source : sources_of(folder, payload)) {
        const test::Failure failure = failure_of([&] { read_text(*source, 31); });
        EXPECT_EQ(static_cast<int>(failure.kind), static_cast<int>(ErrorKind::input));
        EXPECT_NE(failure.message.find("end"), std::string::npos) << failure.message;
        EXPECT_NE(failure.message.find("bytes"), std::string::npos) << failure.message;
        EXPECT_FALSE(failure.text.where.empty());
    }
}

TEST(ByteSource, FailingDisksAreReported) {
    const test::TestFolder folder;
    const std::string payload = test::telling_bytes(300);
    const std::string plain = folder.write("plain", payload), packed = folder.write("gz", test::gzip(payload));
    const std::string blocks = folder.write("bz2", test::bzip2(payload));
    const std::function<std::unique_ptr<ByteSource>()> opened[] = {
        [&] { return open_file_source(plain); }, [&] { return open_inflate_source(packed); }, [&] { return open_bzip2_source(blocks); }};
    for (const auto& open : opened) {
        for (std::int64_t offset = 0; offset < 200; offset += 7) {
            for (const int error : {EIO, 0}) {
                const WithBadDisk disk(64, offset, error);
                const test::Failure failure = failure_of([&] { read_text(*open(), 300); });
                expect_helpful(failure, ErrorKind::input, error == EIO ? "Input/output error" : "ends early");
                EXPECT_NE(failure.text.where.find("offset " + std::to_string(offset)), std::string::npos) << failure.message;
            }
        }
    }
}

TEST(ByteSource, RangesBeyondTheFile) {
    const test::TestFolder folder;
    const std::string path = folder.write("v", "12345");
    for (const auto& [offset, length] :
         std::vector<std::pair<std::int64_t, std::int64_t>>{{6, -1}, {0, 6}, {3, 3}, {-1, 2}, {INT64_MAX, 1}, {1, INT64_MAX}}) {
        expect_helpful(failure_of([&, o = offset, l = length] { static_cast<void>(open_file_source(path, o, l)); }), ErrorKind::input,
                       "5 bytes");
        expect_helpful(failure_of([&, o = offset, l = length] { static_cast<void>(open_inflate_source(path, o, l)); }), ErrorKind::input,
                       "5 bytes");
        expect_helpful(failure_of([&, o = offset, l = length] { static_cast<void>(open_bzip2_source(path, o, l)); }), ErrorKind::input,
                       "5 bytes");
    }
}

TEST(ByteSource, EveryDamageOfACompressedStreamIsFound) {
    const test::TestFolder folder;
    const std::string payload = test::telling_bytes(40);
    const std::string good = test::zlib(payload);
    const std::string path = folder.write("z", good);
    int harmless = 0;
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (int bit = 0; bit < 8; ++bit) {
            std::string damaged = good;
            damaged[i] = static_cast<char>(damaged[i] ^ 1 << bit);
            const test::Replaced replaced(path, damaged);
            std::string text;
            const test::Failure failure = failure_of([&] {
                const auto source = open_inflate_source(path);
                text = read_text(*source, 40);
                if (source->payload_bytes(1000) != static_cast<std::int64_t>(payload.size()))
                    throw Error(ErrorKind::input, {.what = "longer"});
            });
            if (failure.message.empty()) {  // a bit that means nothing: the padding before the checksum
                ASSERT_EQ(text, payload) << "byte " << i << " bit " << bit;
                ++harmless;
            } else {
                ASSERT_EQ(static_cast<int>(failure.kind), static_cast<int>(ErrorKind::input)) << "byte " << i << " bit " << bit;
            }
        }
    }
    EXPECT_LT(harmless, 16);
}

TEST(ByteSource, AFewBytesCannotClaimMuch) {
    const test::TestFolder folder;
    const std::string zeros = test::gzip(std::string(1 << 20, '\0'));
    const auto source = open_inflate_source(folder.write("gz", zeros));
    EXPECT_GE(source->size_bound(), 1 << 20);
    EXPECT_LE(source->size_bound(), static_cast<std::int64_t>(zeros.size()) * 1032);
}

}  // namespace
}  // namespace isoatlas

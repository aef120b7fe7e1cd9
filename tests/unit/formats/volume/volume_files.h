// Little helpers to make volume files and to look at what reading them gives.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "faults/forwarding_files.h"
#include "isoatlas/volume.h"
#include "oracle/write_file.h"

namespace isoatlas::test {

/// A folder of its own for one test, removed at the end.
class TestFolder {
public:
    TestFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "isoatlas_io_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        path_ = name;
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::string write(const std::string& name, const std::string& content) const {
        oracle::write_file(path_ / name, content);
        return *this / name;
    }

private:
    std::filesystem::path path_;
};

/// A file whose content is in memory: for tests that read many thousand variants of it. The name must exist on disk as well.
class FileInMemory final : public File {
public:
    explicit FileInMemory(const std::string& content) : content_(content) {}
    std::int64_t size() const override { return static_cast<std::int64_t>(content_.size()); }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        if (offset >= size()) return 0;
        const std::size_t count = std::min(out.size(), content_.size() - static_cast<std::size_t>(offset));
        std::memcpy(out.data(), content_.data() + offset, count);
        return static_cast<std::ptrdiff_t>(count);
    }

private:
    std::string content_;
};

/// While it lives, `path` has this content; other files are what they are.
class Replaced final : public ForwardingFiles {
public:
    Replaced(std::string path, std::string content) : path_(std::move(path)), content_(std::move(content)), in_use_(*this) {}
    OpenedFile open(const std::string& path) override {
        if (path == path_) return {std::make_unique<FileInMemory>(content_), 0};
        return ForwardingFiles::open(path);
    }

private:
    std::string path_, content_;
    ReplacedFileSystem in_use_;
};

/// zlib's windowBits: 15 for zlib, 31 for gzip.
inline std::string compress(const std::string& plain, int window_bits) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::runtime_error("deflateInit2 failed");
    std::string out(deflateBound(&stream, static_cast<uLong>(plain.size())) + 64, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    stream.avail_in = static_cast<uInt>(plain.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    if (deflate(&stream, Z_FINISH) != Z_STREAM_END) throw std::runtime_error("deflate failed");
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}
inline std::string gzip(const std::string& plain) { return compress(plain, 31); }
inline std::string zlib(const std::string& plain) { return compress(plain, 15); }

/// Samples as little-endian bytes (the tests run on little-endian machines); swapped: big endian.
template <class T>
std::string bytes_of(const std::vector<T>& samples) {
    return {reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(T)};
}
inline std::string swapped(std::string bytes, std::size_t sample_bytes) {
    for (std::size_t i = 0; i + sample_bytes <= bytes.size(); i += sample_bytes) {
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i), bytes.begin() + static_cast<std::ptrdiff_t>(i + sample_bytes));
    }
    return bytes;
}

/// All bytes in which a reader may be wrong: every sample differs and uses all of its bytes. count bytes, any type.
inline std::string telling_bytes(std::size_t count) {
    std::string bytes(count, '\0');
    std::uint32_t state = 12345;
    for (char& byte : bytes) {
        state = state * 1664525U + 1013904223U;
        byte = static_cast<char>(state >> 24 & 0x3f);  // below 0x40: no NaN or infinity in any type
    }
    return bytes;
}

inline std::string text_of_bytes(const Volume& volume) { return {reinterpret_cast<const char*>(volume.bytes.data()), volume.bytes.size()}; }

/// Everything, read in slabs of `slices`.
inline std::string read_all(VolumeReader& reader, std::int64_t slices) {
    const VolumeInfo& info = reader.info();
    const std::size_t slice_bytes = static_cast<std::size_t>(info.extent.slice()) * size_of(info.type);
    std::string bytes(static_cast<std::size_t>(info.extent.size[2]) * slice_bytes, '\0');
    for (std::int64_t z = 0; z < info.extent.size[2]; z += slices) {
        const std::int64_t end = std::min(info.extent.size[2], z + slices);
        reader.read(z, end,
                    std::as_writable_bytes(std::span(bytes))
                        .subspan(static_cast<std::size_t>(z) * slice_bytes, static_cast<std::size_t>(end - z) * slice_bytes));
    }
    return bytes;
}

/// What opening and reading a file says when it fails; kind internal and an empty text when it does not fail.
struct Failure {
    ErrorKind kind = ErrorKind::internal;
    ErrorText text{};
    std::string message{};
};
inline Failure failure_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return {error.kind(), error.text(), error.what()};
    }
    return {};
}
inline Failure failure_of_loading(const std::string& path, const OpenOptions& options = {}) {
    return failure_of([&] { static_cast<void>(load_volume(path, options)); });
}

/// A message fit for a user: kind as given, it names the file, says what and what next.
inline void expect_helpful(const Failure& failure, ErrorKind kind, const std::string& words) {
    EXPECT_EQ(static_cast<int>(failure.kind), static_cast<int>(kind)) << failure.message;
    EXPECT_NE(failure.message.find(words), std::string::npos) << "'" << words << "' not in: " << failure.message;
    EXPECT_FALSE(failure.text.file.empty()) << failure.message;
    EXPECT_FALSE(failure.text.what.empty()) << failure.message;
    EXPECT_FALSE(failure.text.next.empty()) << failure.message;
}

inline void expect_reason(const Failure& failure, ErrorKind kind, Reason reason, const std::string& value = {}) {
    expect_helpful(failure, kind, "");
    EXPECT_EQ(failure.text.reason, reason) << name_of(failure.text.reason) << ": " << failure.message;
    EXPECT_EQ(failure.text.value, value) << failure.message;
}

inline std::string base64(const std::string& bytes) {
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
    }
    return text;
}

inline VolumeInfo info_of(const Extent& extent, const Geometry& geometry = {}) {
    VolumeInfo info;
    info.extent = extent;
    info.geometry = geometry;
    return info;
}

}  // namespace isoatlas::test

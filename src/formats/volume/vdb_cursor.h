// Reads the bytes of an OpenVDB file one after another. Every step is checked against the size of the file; errors name the offset.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {

class VdbCursor {
public:
    static constexpr std::int64_t kMaxBytes = std::int64_t{1} << 19;  ///< of one bytes()

    explicit VdbCursor(const std::string& path) : path_(path), file_(open_file(path)), size_(file_->size()) {}

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::int64_t at() const { return at_; }
    [[nodiscard]] std::int64_t left() const { return size_ - at_; }
    void go_to(std::int64_t offset) {
        if (offset < 0 || offset > size_) refuse("it refers to bytes behind its end");
        at_ = offset;
    }
    void skip(std::int64_t count) {
        if (count < 0 || count > left()) ends_early();
        at_ += count;
    }
    /// The next `count` bytes, at most kMaxBytes; they last until the next call.
    [[nodiscard]] std::span<const std::byte> bytes(std::int64_t count) {
        if (count > left()) ends_early();
        if (at_ < begin_ || at_ + count > begin_ + static_cast<std::int64_t>(buffer_.size())) {
            begin_ = at_;
            buffer_.resize(static_cast<std::size_t>(std::min(kMaxBytes, left())));
            read_fully(*file_, path_, begin_, buffer_);
        }
        const std::span<const std::byte> found =
            std::span<const std::byte>(buffer_).subspan(static_cast<std::size_t>(at_ - begin_), static_cast<std::size_t>(count));
        at_ += count;
        return found;
    }
    template <class T>
    [[nodiscard]] T number() {
        T value;
        std::memcpy(&value, bytes(sizeof(T)).data(), sizeof(T));
        return value;
    }
    /// A text behind its length.
    [[nodiscard]] std::string text() {
        constexpr std::uint32_t kMaxTextBytes = 1 << 16;
        const auto count = number<std::uint32_t>();
        if (count > kMaxTextBytes) refuse("a text has " + std::to_string(count) + " bytes");
        const std::span<const std::byte> found = bytes(count);
        return {reinterpret_cast<const char*>(found.data()), found.size()};
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = "offset " + std::to_string(at_),
                                       .what = what,
                                       .expected = "a sound .vdb file",
                                       .next = "the file is truncated or damaged: get it again"});
    }

private:
    [[noreturn]] void ends_early() const { refuse("it ends early, at byte " + std::to_string(size_)); }

    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t size_, at_ = 0, begin_ = 0;  ///< begin_: of the buffer in the file
    std::vector<std::byte> buffer_;
};

}  // namespace isoatlas

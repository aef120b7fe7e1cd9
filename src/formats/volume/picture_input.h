// The file that a C library decodes, and how its errors come back.
//
// No exception may pass through the frames of such a library: its callbacks jump, and the functions that call it throw afterwards.
#pragma once

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/common/byte_cursor.h"
#include "formats/common/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas {

class PictureInput {
public:
    explicit PictureInput(const std::string& path) : path_(path), file_(open_file(path)), buffer_(kBufferBytes) {}

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::int64_t file_bytes() const { return file_->size(); }

    /// Calls step(), which calls the library; false: the library has failed. Frames between must have nothing to destroy.
    template <class Step>
    [[nodiscard]] bool guarded(const Step& step) {
        if (setjmp(jump_) != 0) return false;  // NOLINT(cert-err52-cpp,modernize-*)
        step();
        return true;
    }
    /// Of the library, inside guarded().
    [[noreturn]] void fail(const char* message) {
        std::strncpy(message_.data(), message, message_.size() - 1);
        std::longjmp(jump_, 1);  // NOLINT(cert-err52-cpp,modernize-*)
    }

    /// The next bytes of the file, some of them; none: it has ended, or the disk has failed.
    [[nodiscard]] std::span<const std::byte> next(std::size_t max) noexcept {
        if (begin_ == end_) fill();
        const std::size_t count = std::min(max, end_ - begin_);
        const std::span<const std::byte> bytes(buffer_.data() + begin_, count);
        begin_ += count;
        return bytes;
    }
    void skip(std::int64_t count) noexcept {
        const auto inside = static_cast<std::size_t>(std::min<std::int64_t>(count, static_cast<std::int64_t>(end_ - begin_)));
        begin_ += inside;
        position_ += std::min(count - static_cast<std::int64_t>(inside), std::max<std::int64_t>(file_->size() - position_, 0));
    }
    static constexpr std::size_t kBufferBytes = 1 << 14;

    /// The error behind a step that has failed.
    [[noreturn]] void report(const std::string& format) const {
        if (failure_) std::rethrow_exception(failure_);
        const std::string message(message_.data());
        throw Error(ErrorKind::input, {.file = path_,
                                       .where = format + " data",
                                       .what = "cannot be read" + (message.empty() ? "" : ": " + message),
                                       .next = kDamagedFile});
    }

private:
    void fill() noexcept {
        begin_ = end_ = 0;
        try {
            end_ = read_available(*file_, path_, position_, buffer_);
            position_ += static_cast<std::int64_t>(end_);
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    std::string path_;
    std::unique_ptr<File> file_;
    std::int64_t position_ = 0;
    std::vector<std::byte> buffer_;
    std::size_t begin_ = 0, end_ = 0;
    std::exception_ptr failure_;
    std::array<char, 200> message_{};
    std::jmp_buf jump_{};
};

}  // namespace isoatlas

// WordReader: words and lines of a file that is part text, part binary, of any size.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/common/byte_source.h"

namespace isoatlas {

class WordReader {
public:
    /// source: with random access.
    explicit WordReader(std::unique_ptr<ByteSource> source) : source_(std::move(source)), size_(source_->size_bound()) {}

    /// The next word between white space, at most its first 256 characters; empty at the end of the file.
    [[nodiscard]] std::string word();
    /// The rest of the line without its end, at most its first 4096 characters; the next line comes next.
    [[nodiscard]] std::string line();
    /// Skips words; false when the file ends before.
    [[nodiscard]] bool skip_words(std::int64_t count);
    /// Of the next byte.
    [[nodiscard]] std::int64_t position() const { return buffer_begin_ + static_cast<std::int64_t>(at_); }
    [[nodiscard]] std::int64_t left() const { return size_ - position(); }
    void go_to(std::int64_t position);

private:
    [[nodiscard]] bool has_next();  ///< fills the buffer
    [[nodiscard]] char next() { return static_cast<char>(buffer_[at_++]); }
    [[nodiscard]] char peek() const { return static_cast<char>(buffer_[at_]); }

    std::unique_ptr<ByteSource> source_;
    std::int64_t size_, buffer_begin_ = 0;
    std::vector<std::byte> buffer_;
    std::size_t at_ = 0;
};

}  // namespace isoatlas

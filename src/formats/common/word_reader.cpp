#include "formats/common/word_reader.h"

#include <algorithm>

#include "formats/common/byte_cursor.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBufferBytes = 64 * 1024;
constexpr std::size_t kWordLimit = 256, kLineLimit = 4096;

}  // namespace

bool WordReader::has_next() {
    if (at_ < buffer_.size()) return true;
    buffer_begin_ = position(), at_ = 0;
    buffer_.resize(static_cast<std::size_t>(std::min(kBufferBytes, size_ - buffer_begin_)));
    if (buffer_.empty()) return false;
    source_->seek(buffer_begin_);
    source_->read(buffer_);
    return true;
}

void WordReader::go_to(std::int64_t position) {
    const std::int64_t end = buffer_begin_ + static_cast<std::int64_t>(buffer_.size());
    if (buffer_begin_ <= position && position <= end) {
        at_ = static_cast<std::size_t>(position - buffer_begin_);
        return;
    }
    buffer_begin_ = position, at_ = 0;
    buffer_.clear();
}

std::string WordReader::word() {
    while (has_next() && ByteCursor::is_space(peek())) ++at_;
    std::string word;
    while (word.size() < kWordLimit && has_next() && !ByteCursor::is_space(peek())) word += next();
    return word;
}

std::string WordReader::line() {
    std::string line;
    while (has_next()) {
        const char c = next();
        if (c == '\n') break;
        if (line.size() < kLineLimit) line += c;
    }
    if (line.ends_with('\r')) line.pop_back();
    return line;
}

bool WordReader::skip_words(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
        while (has_next() && ByteCursor::is_space(peek())) ++at_;
        if (!has_next()) return false;
        while (has_next() && !ByteCursor::is_space(peek())) ++at_;
    }
    return true;
}

}  // namespace isoatlas

// ByteWriter: numbers and text, in little-endian bytes or as shortest round-trip text, into a Sink.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "isoatlas/sink.h"
#include "isoatlas/text.h"

namespace isoatlas {

static_assert(std::endian::native == std::endian::little, "the writers copy numbers as they lie in memory");

/// Buffers small pieces; call finish() at the end.
class ByteWriter {
public:
    explicit ByteWriter(Sink& sink) : sink_(sink) {}
    ByteWriter(const ByteWriter&) = delete;
    ByteWriter& operator=(const ByteWriter&) = delete;

    template <class T>
    void put(T value) {
        static_assert(std::is_arithmetic_v<T>);
        make_room(sizeof(T));
        std::memcpy(buffer_.data() + used_, &value, sizeof(T));
        used_ += sizeof(T);
    }
    template <class T, std::size_t N>
    void put(const std::array<T, N>& values) {
        for (const T value : values) put(value);
    }
    void text(std::string_view piece) {
        if (piece.size() > buffer_.size()) {
            flush();
            sink_.write(piece);
            return;
        }
        make_room(piece.size());
        std::memcpy(buffer_.data() + used_, piece.data(), piece.size());
        used_ += piece.size();
    }
    /// Shortest text that reads back as the same number.
    template <class T>
    void number(T value) {
        make_room(40);
        char* const begin = buffer_.data() + used_;
        used_ += static_cast<std::size_t>(std::to_chars(begin, begin + 40, value).ptr - begin);
    }
    [[nodiscard]] std::int64_t size() const { return sink_.size() + static_cast<std::int64_t>(used_); }
    /// Nothing stays in the buffer.
    void finish() { flush(); }

private:
    void make_room(std::size_t count) {
        if (used_ + count > buffer_.size()) flush();
    }
    void flush() {
        sink_.write(std::string_view(buffer_.data(), used_));
        used_ = 0;
    }

    Sink& sink_;
    std::array<char, 1 << 15> buffer_;
    std::size_t used_ = 0;
};

/// Shortest text that reads back as the same number.
template <class T>
[[nodiscard]] std::string number_text(T value) {
    std::array<char, 40> digits;
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

/// Text of a volume's header as UTF-8 on one line: control characters (an untrusted unit could add lines) become spaces.
[[nodiscard]] inline std::string one_line(const std::string& given) {
    std::string text = decoded_text(given);
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return text;
}

}  // namespace isoatlas

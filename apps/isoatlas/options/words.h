// Parses values of options. Every function throws Error{usage} that names the option and its valid values.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

/// Parses the whole word as the nearest number of type T. False for a word that underflows to 0 or overflows to infinity.
template <class T>
[[nodiscard]] bool read_number(std::string_view word, T& value, int base = 10) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    std::from_chars_result result{};
    if constexpr (std::is_integral_v<T>) {
        result = std::from_chars(word.data(), word.data() + word.size(), value, base);
    } else {
        result = std::from_chars(word.data(), word.data() + word.size(), value);
    }
    return !word.empty() && result.ec == std::errc{} && result.ptr == word.data() + word.size();
}

[[nodiscard]] bool is_number(const std::string& word);

[[noreturn]] void bad_number(const std::string& option, const std::string& word, bool whole);
/// The same as an option: rejects what is not a number.
template <class T>
[[nodiscard]] T parse_number(const std::string& option, const std::string& word) {
    T value{};
    if (!read_number(word, value)) bad_number(option, word, std::is_integral_v<T>);
    return value;
}

/// "512x512x100", "512,512" or "512": 1 to 3 positive numbers; one number means a cube.
[[nodiscard]] std::vector<std::int64_t> parse_dims(const std::string& word);

/// "0:20,30:50,10:30": first sample and one past the last of each axis; two axes: the first slice.
[[nodiscard]] SampleBox parse_box(const std::string& option, const std::string& word);

/// A number of at least 0, with or without % behind it (then 0..100).
[[nodiscard]] double parse_height(const std::string& option, const std::string& word);

/// A positive whole number.
[[nodiscard]] std::int64_t parse_count(const std::string& option, const std::string& word);

/// "1G", "500M", "1.5 GiB": K, M, G, T are powers of 1024. least: bytes.
[[nodiscard]] std::int64_t parse_bytes(const std::string& option, const std::string& word, std::int64_t least = kMinMemory);

/// "0.7,0.7,1" or "2" (the same for all axes); with two numbers the third is `rest`.
[[nodiscard]] Vec3 parse_vector(const std::string& option, const std::string& word, double rest);

/// A name of a unit: up to 32 bytes of text without control characters. "um" becomes "µm".
[[nodiscard]] std::string parse_unit(const std::string& option, const std::string& word);

/// uint8, u8, uchar, ..., float, double.
[[nodiscard]] ValueType parse_type(const std::string& word);

/// A number, or "below".
[[nodiscard]] MissingPolicy parse_missing(const std::string& word);

[[noreturn]] void bad_choice(const std::string& option, const std::string& word, const std::vector<std::string>& known);

template <class T>
[[nodiscard]] T parse_choice(const std::string& option, const std::string& word, const std::vector<std::pair<std::string, T>>& choices) {
    std::vector<std::string> known;
    for (const auto& [name, value] : choices) {
        if (name == word) return value;
        known.push_back(name);
    }
    bad_choice(option, word, known);
}

/// "--dims 4 5 6" is the same as "--dims 4x5x6": joined here, because CLI11 would take a following file name for a number.
[[nodiscard]] std::vector<std::string> join_numbers(const std::vector<std::string>& words);

}  // namespace isoatlas::cli

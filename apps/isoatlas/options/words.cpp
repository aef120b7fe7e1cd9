#include "options/words.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "options/suggest.h"

namespace isoatlas::cli {
namespace {

std::vector<std::string> split(const std::string& word, const std::string& separators) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (begin <= word.size()) {
        const std::size_t end = std::min(word.find_first_of(separators, begin), word.size());
        parts.push_back(word.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

[[noreturn]] void bad_word(const std::string& option, const std::string& word, const std::string& expected) {
    throw Error(ErrorKind::usage, {.what = option + " cannot be \"" + word + "\"", .expected = expected, .next = "use this form"});
}

}  // namespace

bool is_number(const std::string& word) {
    double value = 0;
    return read_number(word, value);
}

void bad_number(const std::string& option, const std::string& word, bool whole) {
    bad_word(option, word, whole ? "a whole number" : "a number: 0, or one from 4.95e-324 to 1.79e308, with either sign");
}

std::vector<std::int64_t> parse_dims(const std::string& word) {
    std::vector<std::int64_t> dims;
    for (const std::string& part : split(word, "x,X")) {
        std::int64_t size = 0;
        if (!read_number(part, size) || size < 1) bad_word("--dims", word, "positive numbers like 512x512x100, or 512x512 for 2D");
        dims.push_back(size);
    }
    if (dims.size() == 1) dims.assign(3, dims[0]);
    if (dims.size() > 3) bad_word("--dims", word, "two or three numbers like 512x512x100");
    return dims;
}

Vec3 parse_vector(const std::string& option, const std::string& word, double rest) {
    const std::vector<std::string> parts = split(word, option == "--spacing" ? "x,X" : ",");
    Vec3 values{rest, rest, rest};
    if (parts.size() > 3) bad_word(option, word, "one, two or three numbers like 0.7,0.7,1.5");
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!read_number(parts[i], values[i]) || !std::isfinite(values[i])) bad_word(option, word, "numbers like 0.7,0.7,1.5");
        if (option == "--spacing" && values[i] <= 0) bad_word(option, word, "positive numbers");
    }
    if (parts.size() == 1) values = {values[0], values[0], values[0]};
    return values;
}

SampleBox parse_box(const std::string& option, const std::string& word) {
    const std::vector<std::string> axes = split(word, ",");
    SampleBox box{{0, 0, 0}, {1, 1, 1}};
    bool is_right = axes.size() == 2 || axes.size() == 3;
    for (std::size_t axis = 0; is_right && axis < axes.size(); ++axis) {
        const std::vector<std::string> ends = split(axes[axis], ":");
        is_right = ends.size() == 2 && read_number(ends[0], box.begin[axis]) && read_number(ends[1], box.end[axis]) &&
                   box.begin[axis] >= 0 && box.begin[axis] < box.end[axis];
    }
    if (!is_right) bad_word(option, word, "FIRST:END for every axis, like 0:20,30:50,10:30");
    return box;
}

std::string parse_unit(const std::string& option, const std::string& word) {
    constexpr std::size_t kMost = 32;
    const bool is_text = is_utf8(word) && std::ranges::none_of(word, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; });
    if (!is_text || word.size() > kMost)
        bad_word(option, word, option == "--unit" ? "a unit of length such as mm, um or nm" : "a unit such as HU");
    return option == "--unit" ? unit_name(word) : word;
}

ValueType parse_type(const std::string& word) {
    static const std::map<std::string, ValueType> names{
        {"uint8", ValueType::u8},    {"u8", ValueType::u8},       {"uchar", ValueType::u8},  {"int8", ValueType::i8},
        {"i8", ValueType::i8},       {"uint16", ValueType::u16},  {"u16", ValueType::u16},   {"ushort", ValueType::u16},
        {"int16", ValueType::i16},   {"i16", ValueType::i16},     {"short", ValueType::i16}, {"uint32", ValueType::u32},
        {"u32", ValueType::u32},     {"uint", ValueType::u32},    {"int32", ValueType::i32}, {"i32", ValueType::i32},
        {"int", ValueType::i32},     {"float32", ValueType::f32}, {"f32", ValueType::f32},   {"float", ValueType::f32},
        {"float64", ValueType::f64}, {"f64", ValueType::f64},     {"double", ValueType::f64}};
    const auto found = names.find(word);
    if (found != names.end()) return found->second;
    bad_choice("--type", word, {"uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64"});
}

double parse_height(const std::string& option, const std::string& word) {
    const bool percent = word.ends_with('%');
    double height = 0;
    const bool is_number = read_number(percent ? word.substr(0, word.size() - 1) : word, height) && std::isfinite(height);
    if (!is_number || height < 0 || (percent && height > 100))
        bad_word(option, word, "a number of at least 0, or a percentage such as 0.5%");
    return height;
}

std::int64_t parse_count(const std::string& option, const std::string& word) {
    std::int64_t count = 0;
    if (!read_number(word, count) || count < 1) bad_word(option, word, "a number of at least 1, or a percentage such as 5%");
    return count;
}

std::int64_t parse_bytes(const std::string& option, const std::string& word, std::int64_t least) {
    static const std::map<std::string, double> units{{"", 1}, {"k", 0x1p10}, {"m", 0x1p20}, {"g", 0x1p30}, {"t", 0x1p40}};
    std::string unit;
    std::size_t digits = 0;
    while (digits < word.size() && (std::isdigit(static_cast<unsigned char>(word[digits])) || word[digits] == '.')) ++digits;
    for (const char c : word.substr(digits)) {
        if (c != ' ') unit += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    for (const std::string end : {"ib", "b"}) {
        if (unit.ends_with(end)) unit.resize(unit.size() - end.size());
    }
    double number = 0;
    constexpr double kMax = 0x1p62;
    const auto factor = units.find(unit);
    const bool good = factor != units.end() && read_number(word.substr(0, digits), number) && number * factor->second < kMax;
    if (!good || number * factor->second < static_cast<double>(least))
        bad_word(option, word, "a size" + std::string(least > 0 ? " of at least 80M" : "") + ", such as 500M or 2G");
    return static_cast<std::int64_t>(number * factor->second);
}

MissingPolicy parse_missing(const std::string& word) {
    MissingPolicy policy;
    if (word == "below") {
        policy.action = MissingPolicy::Action::below;
    } else if (read_number(word, policy.value) && std::isfinite(policy.value)) {
        policy.action = MissingPolicy::Action::replace;
    } else {
        bad_word("--missing", word, "a number, or below");
    }
    return policy;
}

void bad_choice(const std::string& option, const std::string& word, const std::vector<std::string>& known) {
    const std::string near = nearest(word, known);
    throw Error(ErrorKind::usage, {.what = option + " cannot be \"" + word + "\"",
                                   .expected = list_of(known),
                                   .next = near.empty() ? "choose one of them" : "did you mean " + near + "?"});
}

std::vector<std::string> join_numbers(const std::vector<std::string>& words) {
    std::vector<std::string> joined;
    for (std::size_t i = 0; i < words.size(); ++i) {
        joined.push_back(words[i]);
        const bool is_output = words[i] == "-o" || words[i] == "--output";
        if (is_output && i + 1 < words.size() && words[i + 1].starts_with("-.")) joined.back() = "--output=" + words[++i];
        if (words[i] != "--dims" && words[i] != "--spacing" && words[i] != "--origin") continue;
        std::string numbers;
        while (i + 1 < words.size() && is_number(words[i + 1])) numbers += (numbers.empty() ? "" : ",") + words[++i];
        if (!numbers.empty()) joined.push_back(numbers);
    }
    return joined;
}

}  // namespace isoatlas::cli

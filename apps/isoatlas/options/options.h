// Options of verbs that have many.
#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "options/arguments.h"
#include "options/selection_words.h"
#include "options/words.h"

namespace isoatlas::cli {

/// The range appears in the error message, not in the help.
template <class T>
CLI::Validator in_range(T low, T high) {
    const auto say = [range = CLI::Range(low, high), low, high](std::string& word) {
        return range(word).empty() ? std::string() : fmt::format("{} is not from {} to {}", word, low, high);
    };
    return {say, ""};
}

template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;

/// An option that takes a number, or several for a vector, each read by read_number(): CLI11 would read an empty value as 0.
template <class T>
CLI::Option* add_number(CLI::App& app, const std::string& names, T& value, const std::string& meaning) {
    const auto take = [&value, name = names.substr(0, names.find(','))](const CLI::results_t& words) {
        if constexpr (kIsVector<T>) {
            for (const std::string& word : words) value.push_back(parse_number<typename T::value_type>(name, word));
        } else if constexpr (std::is_arithmetic_v<T>) {
            value = parse_number<T>(name, words.at(0));
        } else {
            value = parse_number<typename T::value_type>(name, words.at(0));  // of an optional
        }
        return true;
    };
    CLI::Option* option = app.add_option(names, take, meaning);
    if constexpr (kIsVector<T>) option->expected(CLI::detail::expected_max_vector_size);
    return option;
}

void add_picture(CLI::App& app, Arguments& arguments, PictureWords& words);
void add_camera(CLI::App& app, PictureWords& words);
void add_animation(CLI::App& app, Arguments& arguments);

/// Options of a selection. top: also --top P%, where --top has no other meaning.
void add_selection(CLI::App& app, TypedSelection& typed, bool top);

}  // namespace isoatlas::cli

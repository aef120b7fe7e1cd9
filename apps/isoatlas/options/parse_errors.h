// What cannot be parsed, in the words of this program instead of those of CLI11.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace isoatlas::cli {

[[noreturn]] void usage(const std::string& what, const std::string& next, const std::string& expected = {});

/// The long names of all options.
[[nodiscard]] std::vector<std::string> option_names(const CLI::App& app);

/// words: behind the verb. Throws Error{usage}: an option that the verb does not have, or what CLI11 found.
[[noreturn]] void explain(const CLI::App& app, const std::string& verb, const std::vector<std::string>& words,
                          const CLI::ParseError& error);

/// Throws Error{usage}: an empty value (an unset variable of a script), where CLI11 would take the next word instead.
void refuse_empty_values(const CLI::App& app, const std::vector<std::string>& words);

/// Throws Error{usage} with the verb that was meant, if there is one.
[[noreturn]] void unknown_verb(const std::string& word);

/// A word in the place of the verb that is a path: it has a slash, a name with an extension, or is `-`.
[[nodiscard]] bool is_path(const std::string& word);

}  // namespace isoatlas::cli

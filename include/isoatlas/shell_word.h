// Quoting of words of a command line for a POSIX shell.
#pragma once

#include <string>

namespace isoatlas {

/// A word as a POSIX shell takes it: in single quotes where it holds more than letters, digits and the characters of common file names.
/// Control characters and bytes that are not UTF-8 are written as octal numbers in $'...' (POSIX.1-2024, bash, zsh, ksh).
[[nodiscard]] std::string shell_word(const std::string& word);

}  // namespace isoatlas

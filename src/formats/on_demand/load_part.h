// Parts of isoatlas whose libraries take long to load lie in files of their own beside a program, which loads one when it needs it. The
// program exports its symbols (-rdynamic): a part calls the program's own isoatlas, not a second one.
#pragma once

#include <string>

namespace isoatlas {

/// What isoatlas_part() of the part returns: a table of functions. library: the one that the part needs; file: that needs it. Once loaded,
/// a part stays. Throws Error{unsupported, Reason::built_without_format}: it is not there, or a library that it needs.
[[nodiscard]] const void* load_part(const std::string& part, const std::string& library, const std::string& file);

}  // namespace isoatlas

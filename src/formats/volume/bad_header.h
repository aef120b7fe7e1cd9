// The error of a field of a header that no sound file has.
#pragma once

#include <string>

#include "isoatlas/error.h"

namespace isoatlas {

[[noreturn]] inline void bad_field(const std::string& path, const std::string& where, const std::string& what,
                                   const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = where,
                                   .what = what,
                                   .expected = expected,
                                   .next = "the header is damaged: get the file again or correct it"});
}
/// Of a binary header, whose fields have names.
[[noreturn]] inline void bad_header(const std::string& path, const std::string& field, const std::string& what,
                                    const std::string& expected) {
    bad_field(path, "header, " + field, what, expected);
}

}  // namespace isoatlas

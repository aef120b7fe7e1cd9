// The error of a field of a binary header that no sound file has.
#pragma once

#include <string>

#include "isoatlas/error.h"

namespace isoatlas {

[[noreturn]] inline void bad_header(const std::string& path, const std::string& field, const std::string& what,
                                    const std::string& expected) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = "header, " + field,
                                   .what = what,
                                   .expected = expected,
                                   .next = "the header is damaged: get the file again or correct it"});
}

}  // namespace isoatlas

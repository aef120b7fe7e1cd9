// The error of a file in a folder of slices that does not fit the others.
#pragma once

#include <filesystem>
#include <string>

#include "isoatlas/error.h"

namespace isoatlas {

/// is, wanted: the shapes of this slice and of the first one.
[[noreturn]] inline void refuse_slice(const std::string& path, const std::string& is, const std::string& wanted,
                                      const std::string& first_file) {
    throw Error(ErrorKind::input, {.file = path,
                                   .what = "the slice is " + is,
                                   .expected = wanted + " like " + std::filesystem::path(first_file).filename().string(),
                                   .next = "all slices of a folder must have one size and type: move other images elsewhere"});
}

}  // namespace isoatlas

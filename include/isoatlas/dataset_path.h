// FILE:/DATASET: an array inside of a file of many.
#pragma once

#include <string>

namespace isoatlas {

struct DatasetPath {
    std::string file, dataset;  ///< dataset: "/group/array"; empty: the path names a file alone
};

/// Splits a path, or an address, at its first ":/", unless a file has the whole name.
[[nodiscard]] DatasetPath split_dataset(const std::string& path);

}  // namespace isoatlas

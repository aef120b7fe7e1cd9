// The volumes of the benchmark: generated fields and, when their folder is given, real data sets.
#pragma once

#include <isoatlas/isoatlas.h>

#include <string>
#include <vector>

namespace bench {

/// Where volumes come from. Their samples are kept in `cache`, NAME.raw: making fields costs more than analysing them, and
/// scripts beside read them.
struct Sources {
    std::string cache;  ///< folder; must exist
    std::string data;   ///< folder with NAME/NAME.nrrd; empty: no real data
};

/// Names: smooth-N, noisy-N (2 % uniform noise), u8-N (256 grey levels), white-N (white noise) for a size N, data set names, and paths of
/// files.
[[nodiscard]] isoatlas::Volume make(const std::string& name, const Sources& sources);

/// The names of the default run: the fields and the data sets that are there.
[[nodiscard]] std::vector<std::string> default_names(const Sources& sources);

}  // namespace bench

// The store of a volume in the current folder: built when somebody wants to see what is in the volume, used again while it is what a build
// with these options would write.
//
// It is a cache: one that `isoatlas FILE` or `isoatlas view` has made is made anew when volume or options are others, and what differs is
// said. One that the user has built (`isoatlas build`) is never replaced without --restart: then the difference is an error.
#pragma once

#include <string>
#include <vector>

#include "options/arguments.h"

namespace isoatlas::cli {

class Terminal;

/// scan.nii.gz, scan.nrrd and scan.atlas all give scan.
[[nodiscard]] std::string stem_of(const std::string& file);

/// scan.atlas.html and scan.html stand beside scan.atlas.
[[nodiscard]] std::string store_beside(const std::string& page);

/// What lies where the store of arguments.file would be built.
struct Beside {
    bool is_there = false;        ///< a file or anything else
    bool is_store = false;        ///< that can be opened
    bool is_replaceable = false;  ///< BuildOptions::is_replaceable
    bool is_present = true;       ///< Atlas::has_present_values()
    std::string differs;          ///< what it was made of, or with, otherwise; "": it is of this volume with these options

    [[nodiscard]] bool is_usable() const { return is_store && differs.empty(); }
};

/// Compares header, options and samples; of more than 1 GiB of samples, the times of the files. Throws Error: input (a damaged store, no
/// volume), cancelled.
[[nodiscard]] Beside look_beside(const std::string& store, const Arguments& arguments);

/// Can the store be used? Says so, or why it is built anew. Throws Error{usage} when something is in the way that is not to be replaced.
[[nodiscard]] bool is_usable(const std::string& store, const Arguments& arguments, Terminal& terminal);

/// arguments.file if it is a store; else `store`, built from it unless it is usable.
[[nodiscard]] std::string store_for(const Arguments& arguments, Terminal& terminal, const std::string& store);

}  // namespace isoatlas::cli

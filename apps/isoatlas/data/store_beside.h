// The store of a volume in the current folder: built on demand, reused while it equals what a build with these options would write.
//
// It is a cache: a store made by `isoatlas FILE` or `isoatlas view` is rebuilt when volume or options differ, with a note that names the
// difference. A store that the user has built (`isoatlas build`) is never replaced without --restart: there a difference is an error.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "options/arguments.h"

namespace isoatlas::cli {

class Terminal;

/// scan.nii.gz, scan.nrrd and scan.atlas all give scan.
[[nodiscard]] std::string stem_of(const std::string& file);

/// Of the file; for objects of low values scan.low: page and store of their own.
[[nodiscard]] std::string stem_of(const Arguments& arguments);
/// The same of the volume, of either polarity: with the dataset, channel, time step, ... that were chosen.
[[nodiscard]] std::string stem_of_volume(const Arguments& arguments);

/// scan.atlas.html and scan.html stand beside scan.atlas.
[[nodiscard]] std::string store_beside(const std::string& page);

/// The file at the path of the store of arguments.file.
struct Beside {
    bool is_there = false;        ///< any directory entry
    bool is_store = false;        ///< a store that can be opened
    bool is_replaceable = false;  ///< BuildOptions::is_replaceable
    bool is_present = true;       ///< Atlas::has_present_values()
    std::string differs;          ///< difference of volume or options; "": none

    [[nodiscard]] bool is_usable() const { return is_store && differs.empty(); }
};

/// Compares header, options and samples; of more than 1 GiB of samples, the times of the files. Throws Error: input (a damaged store, no
/// volume), cancelled.
[[nodiscard]] Beside look_beside(const std::string& store, const Arguments& arguments);

/// Can the store be used? Prints a note, also with the reason for a rebuild. Throws Error{usage} when there is a file that must not be
/// replaced.
[[nodiscard]] bool is_usable(const std::string& store, const Arguments& arguments, Terminal& terminal);

/// arguments.file if it is a store; else `store`, built from the volume unless it is usable. high_values: BuildOptions::high_values.
[[nodiscard]] std::string store_for(const Arguments& arguments, Terminal& terminal, const std::string& store,
                                    const std::function<void(const std::string&, const Context&)>& high_values);

}  // namespace isoatlas::cli

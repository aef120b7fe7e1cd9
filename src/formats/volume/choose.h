// Which volume of a file is read: one time step, channel and level of several, one array of many.
//
// Each function throws Error{usage} when there are several and the options choose none, or choose one that is not there; the error has the
// list (ErrorText::choices) and a Reason that a program turns into its own option.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Selects one of several volumes that follow each other in a file.
struct TimeStep {
    std::int64_t index = 0;
    std::int64_t count = 1;
};
/// options.time_step, which is optional only when there is one. count: at least 1.
[[nodiscard]] TimeStep choose_time_step(const std::string& path, const OpenOptions& options, std::int64_t count);

/// The number of options.channel, which is optional only when there is one: an exact name, else one without regard to case, else a number.
/// names: one for each channel, "" where the file gives none.
[[nodiscard]] std::int64_t choose_channel(const std::string& path, const OpenOptions& options, std::span<const std::string> names);

/// options.level; unset: 0, the finest. count: at least 1.
[[nodiscard]] std::int64_t choose_level(const std::string& path, const OpenOptions& options, std::int64_t count);

/// The number of options.dataset among arrays whose words are their paths in the file ("/a/b"; leading "/" may be missing); unset: the only
/// one. choices: at least one.
[[nodiscard]] std::size_t choose_dataset(const std::string& path, const OpenOptions& options, std::span<const ErrorChoice> choices);

/// The number of options.series among series: its word, or its number from 0; unset: the only one. choices: at least one.
[[nodiscard]] std::size_t choose_series(const std::string& path, const OpenOptions& options, std::span<const ErrorChoice> choices);

}  // namespace isoatlas

// What the command line assumes about the samples of a file unless told otherwise: fill values, labels, how much to smooth.
#pragma once

#include <string>

#include "options/arguments.h"

namespace isoatlas::cli {

class Terminal;

/// Looks at the samples of arguments.file, where the verb analyses a volume file, and completes the arguments:
/// missing.no_data, gaussian, inputs.are_labels, inputs.assumed. A file that cannot be read is left to the verb, which reports it.
/// Throws Error{cancelled}. Cost: reads the file once; --gaussian auto: some of it again.
void assume_inputs(Arguments& arguments, Terminal& terminal);

/// "the noise is 4.7 % of the range of values: --gaussian auto (sigma 1) smooths it"; "" where it is not strong, or was filtered.
[[nodiscard]] std::string noise_advice(const Arguments& arguments, const VolumeInfo& info);

}  // namespace isoatlas::cli

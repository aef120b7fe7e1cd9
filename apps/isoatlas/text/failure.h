// Converts failures of isoatlas, of the operating system, and bugs to one Error.
#pragma once

#include <isoatlas/error.h>

namespace isoatlas::cli {

/// Of the exception that is being handled. Lack of memory, threads or open files is Error{resource}, wherever it occurs.
[[nodiscard]] Error failure() noexcept;

/// From now on the program ends with a message and its exit code also where no exception can be caught: in a thread of a library, before
/// main(), while another exception is handled.
void end_with_exit_codes();

}  // namespace isoatlas::cli

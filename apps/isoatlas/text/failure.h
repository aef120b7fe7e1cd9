// What went wrong, as one Error: of isoatlas, of the operating system, or a bug.
#pragma once

#include <isoatlas/error.h>

namespace isoatlas::cli {

/// Of the exception that is being handled. What the system refuses (memory, threads, open files) is Error{resource}, whoever asked for it.
[[nodiscard]] Error failure() noexcept;

/// From now on the program ends with a message and its exit code also where nobody can handle an exception: in a thread of a library,
/// before main(), while another exception is handled.
void end_with_exit_codes();

}  // namespace isoatlas::cli

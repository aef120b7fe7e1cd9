// Reports a failure: one message on standard error, with --json also a document on standard output, and the exit code.
#pragma once

#include <isoatlas/error.h>

namespace isoatlas::cli {

class Terminal;

/// Names the options that help (text/advice.h). Returns the exit code.
int report(const Error& error, bool json, Terminal& terminal);

}  // namespace isoatlas::cli

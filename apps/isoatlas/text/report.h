// Reports a failure: one message on standard error, with --json also a document on standard output, and the exit code.
#pragma once

#include <string>
#include <vector>

#include <isoatlas/error.h>

namespace isoatlas::cli {

class Terminal;

/// Names the options that help (text/advice.h), and the commands for what can be chosen. words: of the command line. Returns the exit code.
int report(const Error& error, const std::vector<std::string>& words, bool json, Terminal& terminal);

}  // namespace isoatlas::cli

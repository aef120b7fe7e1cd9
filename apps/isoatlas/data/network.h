// Files of other machines, for the command line.
#pragma once

#include "options/arguments.h"

namespace isoatlas::cli {

class Terminal;

/// Lets the libraries read addresses, with --cache and the token of the environment.
void use_network(const Arguments& arguments);
/// With -v: what was fetched.
void tell_traffic(Terminal& terminal);

}  // namespace isoatlas::cli

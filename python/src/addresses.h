// Addresses (https://...) as paths of files to read.
#pragma once

namespace isoatlas::python {

/// For modules that open files, each of which has its own copy of the libraries. The token of servers is ISOATLAS_BEARER_TOKEN.
void read_addresses();

}  // namespace isoatlas::python

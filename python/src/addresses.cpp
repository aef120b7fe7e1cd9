#include "addresses.h"

#include <cstdlib>

#include <isoatlas/remote.h>

namespace isoatlas::python {

void read_addresses() {
    RemoteOptions options;
    if (const char* token = std::getenv("ISOATLAS_BEARER_TOKEN")) options.token = token;  // NOLINT(concurrency-mt-unsafe): nobody sets it
    use_remote_files(options);
}

}  // namespace isoatlas::python

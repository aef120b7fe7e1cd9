#include "base/refusals.h"

namespace isoatlas {

Error threads_refused(const std::string& reason) {
    return {ErrorKind::resource,
            {.what = "the system refuses a thread: " + reason,
             .next = "allow this process more memory and threads (ulimit -v, ulimit -u), or use fewer threads"}};
}

}  // namespace isoatlas

#include "base/refusals.h"

namespace isoatlas {

Error threads_refused(const std::string& reason) {
    return {ErrorKind::resource,
            {.what = "the system refuses a thread: " + reason,
             .next = "allow this process more memory and threads, or use fewer threads",
             .reason = Reason::threads_refused}};
}

}  // namespace isoatlas

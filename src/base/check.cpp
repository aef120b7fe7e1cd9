#include "base/check.h"

#include <string>

namespace isoatlas {

void check_failed(const char* condition, const char* file, int line) {
    const std::string path = file;
    const std::string name = path.substr(path.find_last_of('/') + 1);
    throw Error(ErrorKind::internal, {.where = name + ":" + std::to_string(line),
                                      .what = std::string("internal check failed: ") + condition,
                                      .next = "this is a bug of isoatlas; please report it with what led to it and, if you can, the volume",
                                      .reason = Reason::bug});
}

}  // namespace isoatlas

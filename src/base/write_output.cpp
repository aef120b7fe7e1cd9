#include "base/atomic_file.h"
#include "isoatlas/output_file.h"

namespace isoatlas {

void write_output(const std::string& path, std::string_view bytes) {
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

}  // namespace isoatlas

#include "cold.h"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace bench {

void drop_pages(const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw std::runtime_error("cannot open " + path);
    const bool dropped = ::fsync(descriptor) == 0 && ::posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED) == 0;
    ::close(descriptor);
    if (!dropped) throw std::runtime_error("cannot drop the pages of " + path);
}

std::int64_t bytes_from_disk() {
    std::ifstream counters("/proc/self/io");
    std::string name;
    std::int64_t value = -1;
    while (counters >> name >> value) {
        if (name == "read_bytes:") return value;
    }
    return -1;
}

}  // namespace bench

#include "cold.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
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

void copy_to_new_memory(const std::string& path, std::int64_t bytes, std::int64_t reads) {
    const std::int64_t at_once = std::max<std::int64_t>(1, (bytes + reads - 1) / std::max<std::int64_t>(reads, 1));
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw std::runtime_error("cannot open " + path);
    const std::int64_t size = ::lseek(descriptor, 0, SEEK_END);
    void* memory = ::mmap(nullptr, static_cast<std::size_t>(bytes), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    bool copied = size > 0 && memory != MAP_FAILED;
    for (std::int64_t done = 0; copied && done < bytes;) {
        const std::int64_t from = done % size, wanted = std::min({at_once, bytes - done, size - from});
        copied = ::pread(descriptor, static_cast<char*>(memory) + done, static_cast<std::size_t>(wanted), from) == wanted;
        done += wanted;
    }
    if (memory != MAP_FAILED) ::munmap(memory, static_cast<std::size_t>(bytes));
    ::close(descriptor);
    if (!copied) throw std::runtime_error("cannot copy " + path);
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

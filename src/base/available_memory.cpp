// How much memory this process may use.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/memory_limit.h"

namespace isoatlas {
namespace {

/// The limit of a control group, or of its parents; nothing when there is none.
std::int64_t control_group_limit() {
    std::ifstream own("/proc/self/cgroup");
    std::int64_t min = INT64_MAX;
    const auto look = [&](const std::string& path) {
        std::ifstream file(path);
        std::int64_t bytes = 0;
        if (file >> bytes && bytes > 0) min = std::min(min, bytes);
    };
    for (std::string line; std::getline(own, line);) {
        const std::size_t colon = line.rfind(':');
        if (line.rfind("0::", 0) == 0) {
            for (std::string path = line.substr(colon + 1);; path.resize(path.rfind('/'))) {
                look("/sys/fs/cgroup" + path + "/memory.max");
                if (path.empty() || path == "/") break;
            }
        } else if (line.find(":memory:") != std::string::npos) {
            look("/sys/fs/cgroup/memory" + line.substr(colon + 1) + "/memory.limit_in_bytes");
        }
    }
    return min;
}

}  // namespace

std::int64_t available_memory() {
    const std::int64_t machine = static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGE_SIZE);
    return std::min(machine, control_group_limit());
}

std::int64_t peak_memory() {
    std::ifstream status("/proc/self/status");  // getrusage() would count what the program before exec() had
    for (std::string line; std::getline(status, line);) {
        long long kilobytes = 0;
        if (std::sscanf(line.c_str(), "VmHWM: %lld", &kilobytes) == 1) return kilobytes * 1024;
    }
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * std::int64_t{1024};
}

}  // namespace isoatlas

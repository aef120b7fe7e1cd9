#include "base/virtual_array.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <new>

namespace isoatlas {

VirtualArray::VirtualArray(std::size_t bytes) : data_(nullptr), bytes_(bytes) {
    if (bytes == 0) return;
    void* mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<std::byte*>(mapped);
}

VirtualArray::~VirtualArray() {
    if (data_ != nullptr) munmap(data_, bytes_);
}

std::size_t VirtualArray::page_bytes() {
    static const auto kBytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    return kBytes;
}

void VirtualArray::commit([[maybe_unused]] std::size_t first, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    const std::size_t begin = first / page_bytes() * page_bytes(), end = std::min(first + bytes, bytes_);
    if (begin < end) (void)madvise(data_ + begin, end - begin, MADV_POPULATE_WRITE);
#endif
}

void VirtualArray::release(std::size_t first, std::size_t bytes) {
    if (first < bytes_) madvise(data_ + first, std::min(bytes, bytes_ - first), MADV_DONTNEED);
}

}  // namespace isoatlas

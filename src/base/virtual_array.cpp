#include "base/virtual_array.h"

#include <sys/mman.h>

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

void VirtualArray::clear() {
    if (data_ != nullptr) madvise(data_, bytes_, MADV_DONTNEED);
}

}  // namespace isoatlas

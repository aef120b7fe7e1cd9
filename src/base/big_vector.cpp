#include "base/big_vector.h"

#include <sys/mman.h>

#include <cstdint>
#include <limits>
#include <new>

namespace isoatlas {
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
constexpr std::size_t kSmall = 2 * kHugePage;  // below: the ordinary heap

std::size_t rounded(std::size_t bytes) { return (bytes + kHugePage - 1) / kHugePage * kHugePage; }

/// Fresh memory from the system, aligned to huge pages; null when there is none.
char* map_memory(std::size_t size) {
    void* mapped = mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) return nullptr;
    char* const begin = static_cast<char*>(mapped);
    const std::size_t head = (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
    if (head > 0) munmap(begin, head);
    munmap(begin + head + size, kHugePage - head);
    madvise(begin + head, size, MADV_HUGEPAGE);  // a wish: refused or not, the memory is there
    return begin + head;
}

}  // namespace

void* allocate_big(std::size_t bytes) {
    if (bytes < kSmall) return ::operator new(bytes);
    if (bytes > std::numeric_limits<std::size_t>::max() / 2) throw std::bad_alloc();
    char* const memory = map_memory(rounded(bytes));
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void free_big(void* memory, std::size_t bytes) noexcept {
    if (bytes < kSmall) {
        ::operator delete(memory);
    } else {
        munmap(memory, rounded(bytes));
    }
}

}  // namespace isoatlas

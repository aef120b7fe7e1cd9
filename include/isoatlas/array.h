// Array: a std::vector for large results.
//
// Freed memory is kept for the next array (fresh pages cost more than much of the work done on them), but hardly more than was in use at
// once; trim_memory_pool() releases it. New elements are not initialised: resize() before writing every element.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace isoatlas {

/// Memory for `bytes`, aligned to huge pages if it is large; throws std::bad_alloc.
[[nodiscard]] void* allocate_big(std::size_t bytes);
void free_big(void* memory, std::size_t bytes) noexcept;
/// Returns the memory that is kept for reuse to the system.
void trim_memory_pool() noexcept;

template <class T>
struct ArrayAllocator {
    using value_type = T;
    ArrayAllocator() = default;
    template <class U>
    ArrayAllocator(const ArrayAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): what an allocator must offer

    [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(allocate_big(n * sizeof(T))); }
    void deallocate(T* memory, std::size_t n) noexcept { free_big(memory, n * sizeof(T)); }

    template <class U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;  // default-initialised: no zeros are written
    }
    template <class U, class... Args>
    void construct(U* place, Args&&... args) {
        ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
    }
    friend bool operator==(const ArrayAllocator&, const ArrayAllocator&) { return true; }
};

template <class T>
using Array = std::vector<T, ArrayAllocator<T>>;

}  // namespace isoatlas

// BigVector: a vector for the large arrays of the engine.
//
// Freed memory is kept for the next array (fresh pages cost more than much of the work done on them), but never more than was in use at
// once; return_big_memory() gives it back. Arrays are aligned to huge pages, which the system uses if it likes; asking for them is a loss
// where it must fetch them from a host (docs/decisions/0006). New elements are not initialised: resize() before writing every element.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace isoatlas {

/// Memory for `bytes`; throws std::bad_alloc.
[[nodiscard]] void* allocate_big(std::size_t bytes);
void free_big(void* memory, std::size_t bytes) noexcept;
/// Gives the memory that is kept for reuse back to the system.
void return_big_memory() noexcept;

template <class T>
struct BigAllocator {
    using value_type = T;
    BigAllocator() = default;
    template <class U>
    BigAllocator(const BigAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): what an allocator must offer

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
    friend bool operator==(const BigAllocator&, const BigAllocator&) { return true; }
};

template <class T>
using BigVector = std::vector<T, BigAllocator<T>>;

/// Empties a vector and gives its memory back (`v = {}` keeps it).
template <class T>
void release(BigVector<T>& vector) {
    BigVector<T>().swap(vector);
}

}  // namespace isoatlas

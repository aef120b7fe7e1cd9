// BigVector: a vector for the large arrays of the engine.
//
// Memory comes from the system in huge pages where it offers them (random access to an array of 100 MB costs half as much) and goes back to it
// at once when the vector dies. New elements are not initialised: resize() before writing every element.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace isoatlas {

/// Memory for `bytes`; throws std::bad_alloc.
[[nodiscard]] void* allocate_big(std::size_t bytes);
void free_big(void* memory, std::size_t bytes) noexcept;

template <class T>
struct BigAllocator {
    using value_type = T;
    BigAllocator() = default;
    template <class U>
    BigAllocator(const BigAllocator<U>&) noexcept {}

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

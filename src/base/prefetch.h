// Software prefetch, where the processor cannot predict the next address.
//
// In assembler where possible: g++ 12 takes a function that only prefetches to have no effect, and drops its calls.
#pragma once

#include <cstddef>

namespace isoatlas {

/// Prefetches the cache line of an address, which need not be readable.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__x86_64__) && defined(__GNUC__)
    asm volatile("prefetcht0 %0" : : "m"(*static_cast<const char*>(address)));
#elif defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

/// The same for writing.
inline void prefetch_to_write([[maybe_unused]] const void* address) {
#if defined(__x86_64__) && defined(__GNUC__)
    asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(address)));
#elif defined(__GNUC__)
    __builtin_prefetch(address, 1);
#endif
}
/// prefetch() of every cache line of an array.
template <class T>
void prefetch(const T* begin, const T* end) {
    constexpr std::ptrdiff_t kLine = 64;
    const auto *first = reinterpret_cast<const char*>(begin), *last = reinterpret_cast<const char*>(end);
    for (; first < last; first += kLine) prefetch(static_cast<const void*>(first));
}

}  // namespace isoatlas

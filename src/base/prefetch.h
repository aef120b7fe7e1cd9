// Asking for memory before it is needed, where the processor cannot guess the next address.
//
// In assembler where that is known: g++ 12 takes a function that does nothing but ask to have no effect, and drops its calls.
#pragma once

namespace isoatlas {

/// Asks for the cache line of an address; it need not be one that may be read.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__x86_64__) && defined(__GNUC__)
    asm volatile("prefetcht0 %0" : : "m"(*static_cast<const char*>(address)));
#elif defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

}  // namespace isoatlas

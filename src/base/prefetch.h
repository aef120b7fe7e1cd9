// Asking for memory before it is needed, where the processor cannot guess the next address.
#pragma once

namespace isoatlas {

/// Asks for the cache line of an address; it need not be one that may be read.
inline void prefetch([[maybe_unused]] const void* address) {
#if defined(__GNUC__)
    __builtin_prefetch(address);
#endif
}

}  // namespace isoatlas

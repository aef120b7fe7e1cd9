// Functions that are compiled for the widest vectors of the processor too, and chosen when the program starts. Results are the same bytes:
// every operation rounds as it does alone (contraction is off, cmake/warnings.cmake).
#pragma once

/// Before the definition of a function, no template. What it calls must be inlined into it to gain anything.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ISOATLAS_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ISOATLAS_WIDE
#endif

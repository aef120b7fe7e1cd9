// Functions for the widest vectors of the processor, chosen when the program runs. Results are the same bytes: every operation rounds as it
// does alone (contraction is off, cmake/warnings.cmake).
#pragma once

#include <cstdlib>

/// Compiled for several processors, the best one chosen when the program starts. Before the definition of a function, or of a template that
/// is instantiated explicitly. What it calls must be inlined into it to gain anything.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__GLIBC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ISOATLAS_WIDE __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ISOATLAS_WIDE
#endif

/// Functions with fused multiply-add and vectors of 256 bits, where it gives the same bytes as without: ISOATLAS_FUSED before them, called
/// only where kHasFused.
#if defined(__x86_64__) && defined(__GNUC__)
#define ISOATLAS_FUSED __attribute__((target("avx2,fma")))

namespace isoatlas {

/// Can this processor run them? No, where ISOATLAS_PLAIN is set.
inline const bool kHasFused = std::getenv("ISOATLAS_PLAIN") == nullptr && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");

}  // namespace isoatlas

#else
#define ISOATLAS_FUSED

namespace isoatlas {

inline constexpr bool kHasFused = false;

}  // namespace isoatlas
#endif

/// Functions written for vectors of 512 bits: ISOATLAS_WIDE_512 before them, called only where kHasWide512.
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

#define ISOATLAS_HAS_WIDE_512 1
#define ISOATLAS_WIDE_512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi,avx512vbmi2,bmi,bmi2,lzcnt,popcnt")))

namespace isoatlas {

/// Can this processor run them? No, where ISOATLAS_PLAIN is set: so tests reach the loops that other processors run.
inline const bool kHasWide512 = std::getenv("ISOATLAS_PLAIN") == nullptr && __builtin_cpu_supports("avx512f") &&
                                __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                                __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi") &&
                                __builtin_cpu_supports("avx512vbmi2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                                __builtin_cpu_supports("lzcnt") && __builtin_cpu_supports("popcnt");

}  // namespace isoatlas

#else
#define ISOATLAS_HAS_WIDE_512 0
#endif

// Function multiversioning: code for the widest vectors of the processor, chosen at run time. Results are the same bytes as of scalar code:
// every operation rounds alike (contraction is off, cmake/warnings.cmake).
#pragma once

#include <cstdlib>
#include <string_view>

namespace isoatlas {

/// The widest vectors that functions written for some use: ISOATLAS_SIMD=scalar or avx2 in the environment sets it, so that tests reach
/// every code path that the processor has.
enum class SimdLevel : unsigned char { scalar, avx2, widest };
inline SimdLevel simd_level() {
    const char* typed = std::getenv("ISOATLAS_SIMD");
    const std::string_view level = typed == nullptr ? "" : typed;
    return level == "scalar" ? SimdLevel::scalar : level == "avx2" ? SimdLevel::avx2 : SimdLevel::widest;
}

}  // namespace isoatlas

/// Compiled for several processors, the best one chosen when the program starts. Before the definition of a function, or of a template that
/// is instantiated explicitly. What it calls must be inlined into it to gain anything.
#if defined(__x86_64__) && defined(__GNUC__) && defined(__GLIBC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define ISOATLAS_TARGET_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define ISOATLAS_TARGET_CLONES
#endif

/// Functions with fused multiply-add and vectors of 256 bits, where it gives the same bytes as without: ISOATLAS_FUSED before them, called
/// only where kHasFused.
#if defined(__x86_64__) && defined(__GNUC__)
#define ISOATLAS_FUSED __attribute__((target("avx2,fma")))

namespace isoatlas {

/// Can this processor run them? No, where ISOATLAS_SIMD=scalar.
inline const bool kHasFused = simd_level() >= SimdLevel::avx2 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");

}  // namespace isoatlas

#else
#define ISOATLAS_FUSED

namespace isoatlas {

inline constexpr bool kHasFused = false;

}  // namespace isoatlas
#endif

/// Functions written for vectors of 512 bits: ISOATLAS_AVX512 before them, called only where kHasAvx512.
#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>

#define ISOATLAS_HAS_AVX512 1
#define ISOATLAS_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi,avx512vbmi2,bmi,bmi2,lzcnt,popcnt")))

namespace isoatlas {

/// Can this processor run them? No, where ISOATLAS_SIMD is scalar or avx2.
inline const bool kHasAvx512 = simd_level() == SimdLevel::widest && __builtin_cpu_supports("avx512f") &&
                               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi") &&
                               __builtin_cpu_supports("avx512vbmi2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                               __builtin_cpu_supports("lzcnt") && __builtin_cpu_supports("popcnt");

}  // namespace isoatlas

#else
#define ISOATLAS_HAS_AVX512 0
#endif

// CHECK: a condition that only a bug of isoatlas can break. Stays in release builds; throws Error{internal}.
#pragma once

#include "isoatlas/error.h"

namespace isoatlas {

[[noreturn]] void check_failed(const char* condition, const char* file, int line);

}  // namespace isoatlas

#define ISOATLAS_CHECK(condition)                                                   \
    do {                                                                            \
        if (!(condition)) ::isoatlas::check_failed(#condition, __FILE__, __LINE__); \
    } while (false)

#ifdef NDEBUG
#define ISOATLAS_DCHECK(condition) \
    do {                           \
    } while (false)
#else
#define ISOATLAS_DCHECK(condition) ISOATLAS_CHECK(condition)
#endif

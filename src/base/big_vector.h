// BigVector: a vector for the large arrays of the engine, in the same memory as results (isoatlas/array.h).
//
// Arrays are aligned to huge pages, which the system may use; requesting them is a loss where it must fetch them from a host
// (docs/decisions/0006).
#pragma once

#include <span>

#include "isoatlas/array.h"

namespace isoatlas {

template <class T>
using BigVector = Array<T>;

/// v.resize(count) that does not keep the content of v. A vector that was used before gets room to grow.
template <class T>
void resize_for_overwrite(BigVector<T>& v, std::size_t count) {
    if (count > v.capacity()) {
        const std::size_t room = v.capacity() == 0 ? count : count + count / 8;
        v = {};
        v.shrink_to_fit();
        v.reserve(room);
    }
    v.resize(count);
}

/// Empties a vector and releases its memory (`v = {}` keeps it).
template <class T>
void release(BigVector<T>& vector) {
    BigVector<T>().swap(vector);
}

}  // namespace isoatlas

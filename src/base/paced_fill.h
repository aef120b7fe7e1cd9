// Filling large arrays while memory is limited: written in one go, an array would be resident as a whole before the limit is checked.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/big_vector.h"
#include "base/memory_limit.h"

namespace isoatlas {

/// Resizes the array to count items of a value; its content is lost.
template <class T>
void fill_fresh(BigVector<T>& array, std::size_t count, const T& value) {
    constexpr std::size_t kBlock = std::size_t{1} << 13;
    array.clear();
    array.resize(count);  // writes nothing
    BudgetPoll memory;
    for (std::size_t first = 0; first < count; first += kBlock) {
        const std::size_t some = std::min(kBlock, count - first);
        memory.step(some * sizeof(T));
        std::fill_n(array.data() + first, some, value);
    }
}

/// An empty array, one of many: while memory is limited it has room enough to lie in the scratch file, as many small ones would add up.
template <class T>
[[nodiscard]] BigVector<T> scratch_chunk() {
    BigVector<T> array;
    if (memory_is_limited()) array.reserve(kMinScratch / sizeof(T) + 1);
    return array;
}

template <class T>
[[nodiscard]] BigVector<T> filled(std::size_t count, const T& value) {
    BigVector<T> array;
    fill_fresh(array, count, value);
    return array;
}

}  // namespace isoatlas

// SharedVector: elements are added at its end by several threads at once, and stay where they are.
#pragma once

#include <tbb/concurrent_vector.h>

#include <cstddef>

namespace isoatlas {

template <class T>
class SharedVector {
public:
    /// The number of the new element; which one it is depends on the other threads.
    std::size_t add(const T& element) { return static_cast<std::size_t>(elements_.push_back(element) - elements_.begin()); }
    [[nodiscard]] T& operator[](std::size_t i) { return elements_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return elements_[i]; }

private:
    tbb::concurrent_vector<T> elements_;
};

}  // namespace isoatlas

// Whole arrays of a store as vectors, and the error for inconsistent arrays.
#pragma once

#include <cstdint>
#include <type_traits>

#include "base/big_vector.h"
#include "isoatlas/error.h"
#include "store/container.h"

namespace isoatlas {

template <class N>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<N, double>) return "float64";
    if constexpr (std::is_same_v<N, std::uint16_t>) return "uint16";
    if constexpr (std::is_same_v<N, std::uint32_t>) return "uint32";
    return "uint64";
}

[[noreturn]] inline void contradiction(const Container& store, const char* what) {
    throw Error(ErrorKind::input,
                {.file = store.path(), .where = "trees", .what = what, .next = "the store is damaged: build it again from the volume"});
}

/// Throws Error{input} when there is no such array of this type.
template <class N>
void read_array(const Container& store, const char* name, const char* type, BigVector<N>& numbers) {
    const StoredArray& array = store.contents().array(name, type);
    numbers.resize(static_cast<std::size_t>(array.count()));
    store.read(array, 0, std::as_writable_bytes(std::span<N>(numbers)));
}

}  // namespace isoatlas

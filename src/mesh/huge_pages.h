// Room for large results in huge pages where the system offers them: fewer page faults while the arrays are filled for the first time.
#pragma once

#include <cstddef>
#include <vector>

namespace isoatlas {

/// Asks for huge pages in a range of fresh memory; does nothing where that is not possible.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// v.resize(count) when nobody needs what is in v. A vector that was used before gets room to grow.
template <class T>
void resize_fresh(std::vector<T>& v, std::size_t count) {
    if (count > v.capacity()) {
        const std::size_t room = v.empty() ? count : count + count / 8;
        v.clear();
        v.reserve(room);
        prefer_huge_pages(v.data(), room * sizeof(T));
    }
    v.resize(count);
}

}  // namespace isoatlas

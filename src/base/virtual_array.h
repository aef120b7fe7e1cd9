// VirtualArray: address space for a sparsely filled array; pages that were never written take no memory.
#pragma once

#include <cstddef>

#include "base/big_vector.h"

namespace isoatlas {

class VirtualArray {
public:
    /// Zeros. Throws std::bad_alloc when the addresses cannot be reserved.
    explicit VirtualArray(std::size_t bytes);
    ~VirtualArray();
    VirtualArray(const VirtualArray&) = delete;
    VirtualArray& operator=(const VirtualArray&) = delete;

    [[nodiscard]] std::byte* data() { return data_; }
    [[nodiscard]] const std::byte* data() const { return data_; }
    /// Bytes of a page of memory.
    [[nodiscard]] static std::size_t page_bytes();
    /// Commits the pages of some bytes that will be written: one call is cheaper than a fault for each page. No effect where the system
    /// cannot; they are committed when they are written.
    void commit(std::size_t first, std::size_t bytes);
    /// Releases the memory of whole pages; they are zero afterwards. first: a multiple of page_bytes(). bytes may reach into the last page,
    /// or beyond the end.
    void release(std::size_t first, std::size_t bytes);

private:
    std::byte* data_;
    std::size_t bytes_;
};

}  // namespace isoatlas

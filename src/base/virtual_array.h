// Room for an array that is filled here and there: pages that nobody has written take no memory.
#pragma once

#include <cstddef>

namespace isoatlas {

class VirtualArray {
public:
    /// Zeros. Throws std::bad_alloc when the system has no room for the addresses.
    explicit VirtualArray(std::size_t bytes);
    ~VirtualArray();
    VirtualArray(const VirtualArray&) = delete;
    VirtualArray& operator=(const VirtualArray&) = delete;

    [[nodiscard]] std::byte* data() { return data_; }
    [[nodiscard]] const std::byte* data() const { return data_; }
    /// Bytes of a page of memory.
    [[nodiscard]] static std::size_t page_bytes();
    /// Takes the memory of the pages of some bytes that will be written: one call is cheaper than a fault for each page. Where the system
    /// cannot, nothing happens; they are taken when they are written.
    void commit(std::size_t first, std::size_t bytes);
    /// Gives the memory of whole pages back; they are zero afterwards. first: a multiple of page_bytes(). bytes may reach into the last
    /// page, or beyond the end.
    void release(std::size_t first, std::size_t bytes);

private:
    std::byte* data_;
    std::size_t bytes_;
};

}  // namespace isoatlas

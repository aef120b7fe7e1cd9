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
    /// Gives the memory of whole pages back; they are zero afterwards. first: a multiple of page_bytes(). bytes may reach into the last
    /// page, or beyond the end.
    void give_back(std::size_t first, std::size_t bytes);

private:
    std::byte* data_;
    std::size_t bytes_;
};

}  // namespace isoatlas

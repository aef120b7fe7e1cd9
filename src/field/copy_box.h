// Copies a box of samples between two arrays, x fastest.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

#include "isoatlas/index3.h"

namespace isoatlas {

/// An array of this size, and the corner of a box in it. Byte is std::byte, or const for what is read.
template <class Byte>
struct BoxPlace {
    std::span<Byte> bytes;
    Index3 size, corner;
    [[nodiscard]] Byte* row(std::int64_t y, std::int64_t z, std::size_t sample) const {
        return bytes.data() + static_cast<std::size_t>(corner[0] + size[0] * (corner[1] + y + size[1] * (corner[2] + z))) * sample;
    }
};

/// box: samples along each axis; it lies in both arrays. sample: bytes of one.
inline void copy_box(const Index3& box, const BoxPlace<const std::byte>& from, const BoxPlace<std::byte>& to, std::size_t sample) {
    for (std::int64_t z = 0; z < box[2]; ++z) {
        for (std::int64_t y = 0; y < box[1]; ++y)
            std::memcpy(to.row(y, z, sample), from.row(y, z, sample), static_cast<std::size_t>(box[0]) * sample);
    }
}

}  // namespace isoatlas

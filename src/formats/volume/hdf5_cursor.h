// Reads the bytes of a structure of HDF5 one after another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "formats/volume/hdf5_frame.h"

namespace isoatlas {

/// Reads forward; the first read beyond the end fails it.
struct Hdf5Cursor {
    std::span<const std::byte> bytes;
    std::size_t at = 0;
    bool is_sound = true;

    bool skip(std::uint64_t count) {
        is_sound = is_sound && count <= bytes.size() - at;
        if (is_sound) at += static_cast<std::size_t>(count);
        return is_sound;
    }
    std::uint64_t number(std::size_t count) {
        const std::size_t from = at;
        return skip(count) ? hdf5_number(bytes, from, count) : 0;
    }
    /// A name and the zero behind it, before version 3 filled up to a multiple of 8.
    void skip_name(std::uint64_t version) {
        const auto rest = bytes.subspan(at);
        const auto end = std::ranges::find(rest, std::byte{0});
        const auto size = static_cast<std::uint64_t>(end - rest.begin()) + 1;
        if (end == rest.end()) is_sound = false;
        skip(version >= 3 ? size : (size + 7) / 8 * 8);
    }
};

}  // namespace isoatlas

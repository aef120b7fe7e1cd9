// The bytes of an HDF5 file as they lie there, for what HDF5 reads without a look at sizes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

/// Where addresses of an HDF5 file begin, and how many bytes an address and a length have: 2, 4 or 8.
struct Hdf5Frame {
    File* file = nullptr;
    std::uint64_t base = 0;
    std::size_t address_bytes = 0, length_bytes = 0;
    std::optional<std::uint64_t> extension{};  ///< address of a header with what the superblock has not
    std::uint64_t root = 0;                    ///< address of the header of the first group

    /// Bytes from an address to the end of the file; 0: beyond it.
    [[nodiscard]] std::uint64_t rest(std::uint64_t address) const;
    /// false: they do not all lie in the file.
    [[nodiscard]] bool read(std::uint64_t address, std::span<std::byte> out) const;
};

/// nullopt: the file has no superblock of HDF5.
[[nodiscard]] std::optional<Hdf5Frame> hdf5_frame_of(File& file);

/// Little endian, at most 8 bytes, which the caller guarantees to be there.
[[nodiscard]] std::uint64_t hdf5_number(std::span<const std::byte> bytes, std::size_t at, std::size_t count);

/// A collection of the global heap, objects behind one another; empty: it is damaged, or larger than 64 MiB.
[[nodiscard]] std::vector<std::byte> read_hdf5_collection(const Hdf5Frame& frame, std::uint64_t address);
/// The object of that number in a collection; empty: there is none.
[[nodiscard]] std::span<const std::byte> hdf5_object(const Hdf5Frame& frame, std::span<const std::byte> collection, std::uint64_t number);
/// Whether all objects of a collection lie in it, behind one another.
[[nodiscard]] bool is_sound_hdf5_collection(const Hdf5Frame& frame, std::span<const std::byte> collection);

}  // namespace isoatlas

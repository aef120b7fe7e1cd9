// The filters of HDF5 that chunks pass through, undone here: HDF5 itself does not check that the bytes they give fill a chunk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace isoatlas {

struct Hdf5ChunkFilter {
    int id = 0;                             ///< as the HDF Group registers it
    std::vector<std::uint32_t> settings{};  ///< as the file gives them, at most 32
};

/// Whether undo_hdf5_filters() knows it: deflate, shuffle, Fletcher32, scale-offset of integers, bzip2, LZF, Blosc, LZ4, Zstandard.
[[nodiscard]] bool is_known_hdf5_filter(const Hdf5ChunkFilter& filter);

/// Undoes filters, given in the order of encoding, without those whose bit is set in `skipped`. `value` holds the stored bytes, then the
/// decoded ones: exactly `bytes` of them. scratch: memory to use again. Takes no more memory than the stored bytes can stand for. Returns a
/// description of the error, "" for none.
[[nodiscard]] std::string undo_hdf5_filters(std::span<const Hdf5ChunkFilter> filters, std::uint32_t skipped, std::size_t bytes,
                                            std::vector<std::byte>& value, std::vector<std::byte>& scratch);

}  // namespace isoatlas

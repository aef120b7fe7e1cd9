// A VolumeReader of samples that lie in chunks: boxes of one size, each read as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "isoatlas/volume.h"

namespace isoatlas {

/// Fills `out` with the samples of the chunk of that index, x fastest, in host byte order; chunks at the end of an axis are as large as the
/// others, their samples outside the volume are not looked at. out.size() == info.chunk.product() * size_of(info.type).
/// Throws Error{input}.
using ReadChunk = std::function<void(const Index3& chunk, std::span<std::byte> out)>;

/// Decoded chunks kept for the next read.
inline constexpr std::int64_t kChunkCacheBytes = std::int64_t{64} << 20;

/// Reads any box through the chunks that it meets. A chunk that a box takes in part is kept, the one not used for the longest time is
/// dropped beyond cache_bytes. Sets info.slab_readable. The caller guarantees info.extent and a positive info.chunk whose bytes fit in
/// memory. Memory: cache_bytes and one chunk.
[[nodiscard]] std::unique_ptr<VolumeReader> make_chunk_reader(VolumeInfo info, ReadChunk read_chunk,
                                                              std::int64_t cache_bytes = kChunkCacheBytes);

}  // namespace isoatlas

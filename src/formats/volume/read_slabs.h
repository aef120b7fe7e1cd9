// Reads a volume file slab by slab.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/phase.h"
#include "isoatlas/context.h"
#include "isoatlas/error.h"
#include "isoatlas/volume.h"

namespace isoatlas {

inline constexpr std::int64_t kSlabBytes = 16 * 1024 * 1024;  // large enough for full disk speed, small enough for prompt cancellation

/// Whole layers of chunks, where such a slab needs no memory of its own or little: no chunk is decoded twice.
inline std::int64_t slab_slices(const VolumeInfo& info, const Context& context, bool has_room) {
    if (context.slab_slices > 0) return std::min(context.slab_slices, info.extent.size[2]);
    constexpr std::int64_t kMostBytes = 4 * kSlabBytes;
    const std::int64_t slice_bytes = info.extent.slice() * static_cast<std::int64_t>(size_of(info.type));
    const std::int64_t slices = std::clamp<std::int64_t>(kSlabBytes / slice_bytes, 1, info.extent.size[2]), layer = info.chunk[2];
    if (layer <= 1 || (!has_room && layer > kMostBytes / slice_bytes)) return slices;
    return std::min((slices + layer - 1) / layer * layer, info.extent.size[2]);
}

/// Calls use(z_begin, samples) for each slab in order; the samples lie in `whole` when it is given, else in one slab of memory.
template <class Use>
void for_each_slab(VolumeReader& reader, const Context& context, std::span<std::byte> whole, const Use& use) {
    const VolumeInfo& info = reader.info();
    const std::int64_t slices = info.extent.size[2], step = slab_slices(info, context, !whole.empty());
    const std::size_t slice_bytes = static_cast<std::size_t>(info.extent.slice()) * size_of(info.type);
    std::vector<std::byte> slab(whole.empty() ? static_cast<std::size_t>(step) * slice_bytes : 0);
    for (std::int64_t z = 0; z < slices; z += step) {
        if (context.cancelled && context.cancelled())
            throw Error(ErrorKind::cancelled, {.file = info.path, .what = "reading was cancelled"});
        report(context, only_phase("read"), static_cast<double>(z) / static_cast<double>(slices));
        const std::int64_t end = std::min(slices, z + step);
        std::byte* begin = whole.empty() ? slab.data() : whole.data() + static_cast<std::size_t>(z) * slice_bytes;
        const std::span<std::byte> samples(begin, static_cast<std::size_t>(end - z) * slice_bytes);
        reader.read(z, end, samples);
        use(z, samples);
    }
    report(context, only_phase("read"), 1);
}

}  // namespace isoatlas

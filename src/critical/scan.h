// The slab pass: samples in, links of the voxels and critical elements out (docs/theory/2-critical-elements.md).
//
// Everything is decided from three slices: a vertex by its neighbours, an ambiguous face by the two cells that share it.
// The owner of a face is the slab of its corner a. Elements come out in raster order of their owner voxel, the vertex first, then faces xy,
// xz, yz; body points come before the row of their cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "base/paced_fill.h"
#include "field/grid.h"
#include "field/order.h"

namespace isoatlas {

struct SlabScan {
    static constexpr std::size_t kChunk = std::size_t{1} << 18;  ///< a list that grows without copying nor reserve
    std::vector<BigVector<KeyedElement>> chunks;                 ///< critical elements owned by the slab; all but the last are full
    std::int64_t maxima = 0, minima = 0;                         ///< how many of them have no upper / no lower link

    /// -0.0 becomes 0.0: which of two equal elements comes first must not show in what is reported.
    void add(const KeyedElement& element) {
        if (chunks.empty() || chunks.back().size() == kChunk) chunks.push_back(scratch_chunk<KeyedElement>());
        chunks.back().push_back({element.value + 0.0, element.code});
    }
};

/// links: one byte per voxel of the slab (critical/links.h). Reads the slices [z_begin - 1, z_end] that exist.
/// Cost: O(voxels + ambiguous faces) time, O(slice + critical elements) memory.
/// tunnel_height: of tunnel_height_of (critical/bodies.h); infinite: faces only.
template <class T>
SlabScan scan_slab(const GridView<T>& grid, Slab slab, std::span<std::uint8_t> links, double tunnel_height);

/// Change of the Euler characteristic of the High set when an element passes: l0 - h0 in 3D; in 2D a saddle (2,2) gives -1.
constexpr int delta_chi(ElementCode code, int rank) {
    if (rank == 3) return code.l0() - code.h0();
    return code.h0() == 2 ? -1 : 1;
}

}  // namespace isoatlas

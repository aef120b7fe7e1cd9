#include "critical/tiled_basins.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/sample_types.h"
#include "base/streamed.h"
#include "critical/elements_with_extrema.h"
#include "critical/grid_scan.h"

namespace isoatlas {
namespace {

/// Visits the maxima in the order of their old numbers.
template <class Visit>
void for_maxima(std::span<const std::uint8_t> links, const Visit& visit) {
    constexpr std::size_t kBlock = std::size_t{1} << 18;
    for (const Block block : streamed_blocks(links.size(), kBlock)) {
        const auto end = links.begin() + static_cast<std::ptrdiff_t>(block.end);
        auto at = links.begin() + static_cast<std::ptrdiff_t>(block.first);
        for (; (at = std::find(at, end, std::uint8_t{0})) != end; ++at) visit(at - links.begin());
    }
}

/// Calls visit(voxel, tile, border) for the voxels of a slice; border: a voxel of another tile may be a neighbour, also across an edge.
template <class Visit>
void for_voxels_of_slice(const Extent& extent, const Tiling& tiling, std::int64_t z, const Visit& visit) {
    const std::int64_t nx = extent.size[0], ny = extent.size[1], side = tiling.side(0);
    const auto is_border = [&](std::int64_t at, int axis) { return at % tiling.side(axis) == 0 || (at + 1) % tiling.side(axis) == 0; };
    const bool border_slice = extent.size[2] > 1 && is_border(z, 2);
    for (std::int64_t y = 0; y < ny; ++y) {
        const bool border_row = border_slice || is_border(y, 1);
        const std::int64_t row = nx * (y + ny * z);
        std::int64_t tile = tiling.tile_of_voxel(row);
        for (std::int64_t first = 0; first < nx; first += side, ++tile) {
            const std::int64_t last = std::min(first + side, nx) - 1;
            for (std::int64_t x = first; x <= last; ++x) visit(row + x, tile, border_row || x == first || x == last);
        }
    }
}

}  // namespace

template <class T, class Number>
TiledBasins<Number> tiled_basins(const GridView<T>& grid, const Tiling& tiling, const Context& context) {
    const Extent& extent = grid.extent;
    const BigVector<std::uint8_t> links = links_of_grid(grid, context);
    BigVector<Number> basin = basins_of_maxima<Number>(extent, links, context);
    std::vector<Number> first(static_cast<std::size_t>(tiling.count()) + 1, Number{0});
    for_maxima(links, [&](std::int64_t voxel) { ++first[tiling.tile_of_voxel(voxel)]; });
    Number maxima = 0;
    for (Number& of_tile : first) maxima += std::exchange(of_tile, maxima);
    BigVector<Number> number;
    {
        const PinInMemory keep;
        number.reserve(maxima);
    }
    std::vector<Number> next = first;
    for_maxima(links, [&](std::int64_t voxel) { number.push_back(next[tiling.tile_of_voxel(voxel)]++); });
    TiledBasins<Number> result{std::move(basin), std::move(first), BitRanks(maxima)};
    for_each_block(context.threads, extent.size[2], [&](std::int64_t z) {
        for_voxels_of_slice(extent, tiling, z, [&](std::int64_t voxel, std::int64_t tile, bool border) {
            const Number maximum = number[Basins<Number>::number(result.maximum[voxel])];
            result.maximum[voxel] = maximum;
            if (border || maximum < result.first[tile] || maximum >= result.first[tile + 1]) result.open.add(maximum);
        });
    });
    return result;
}

#define ISOATLAS_TILED(T)                                                                                \
    template TiledBasins<std::uint32_t> tiled_basins(const GridView<T>&, const Tiling&, const Context&); \
    template TiledBasins<std::uint64_t> tiled_basins(const GridView<T>&, const Tiling&, const Context&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_TILED)
#undef ISOATLAS_TILED

}  // namespace isoatlas

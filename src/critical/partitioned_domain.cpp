#include "critical/partitioned_domain.h"

#include <algorithm>
#include <utility>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "base/part_streams.h"
#include "base/phase.h"
#include "base/streamed.h"
#include "critical/elements_with_extrema.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxTiles = std::int64_t{1} << 16;
constexpr std::int64_t kBytesAVoxel = 80;  // of noise, while a tile is reduced
constexpr std::int64_t kUnlimitedTile = std::int64_t{1} << 20;

/// Numbers of extrema, tile after tile: those of a tile follow each other.
template <class Extremum>
struct Renumbering {
    IdArray<Extremum, Extremum> number;  // by old number
    std::vector<Extremum> first;         // by tile, and of the end
};

/// Calls visit(tile, code) for all elements.
template <class Visit>
void for_elements(const GridScan& scan, const Tiling& tiling, const Visit& visit) {
    for (const BigVector<KeyedElement>& chunk : scan.chunks) {
        for (const std::size_t i : streamed(chunk.size(), in_order(8))) {
            visit(static_cast<std::size_t>(tiling.tile_of(chunk[i].code)), chunk[i].code);
        }
    }
}

/// Elements of extrema come in the order of their old numbers, which begin at min.
template <class Extremum, class IsExtremum>
Renumbering<Extremum> renumber(const GridScan& scan, const Tiling& tiling, std::int64_t extrema, Extremum min,
                               const IsExtremum& is_extremum) {
    using Number = typename Extremum::Number;
    const PinInMemory keep;
    Renumbering<Extremum> result;
    result.number.items().resize(static_cast<std::size_t>(extrema) + min.index());
    std::vector<Number> count(static_cast<std::size_t>(tiling.count()) + 1, Number{0});
    for_elements(scan, tiling, [&](std::size_t tile, ElementCode code) { count[tile] += is_extremum(code); });
    Extremum next = min;
    for (const Number of_tile : count) result.first.push_back(std::exchange(next, Extremum(next.number() + of_tile)));
    std::vector<Extremum> number = result.first;
    Extremum old(0);
    for (; old < min; ++old) result.number[old] = old;
    for_elements(scan, tiling, [&](std::size_t tile, ElementCode code) {
        if (!is_extremum(code)) return;
        result.number[old] = number[tile];
        ++old, ++number[tile];
    });
    return result;
}

std::vector<std::size_t> first_of_tiles(const GridScan& scan, const Tiling& tiling) {
    std::vector<std::size_t> first(static_cast<std::size_t>(tiling.count()) + 1, 0);
    for_elements(scan, tiling, [&](std::size_t tile, ElementCode) { ++first[tile]; });
    std::size_t next = 0;
    for (std::size_t& place : first) next += std::exchange(place, next);
    return first;
}

/// Sorts the elements: keys by rank. Returns their ends, by rank.
template <class Number>
ByElement<Number, Representatives<Number>> sort_elements(ChunksWithExtrema<Number> chunks, const Above& above,
                                                         PartitionedCriticals<Number>& result, int threads) {
    using Element = ElementWithExtrema<Number>;
    ByElement<Number, Representatives<Number>> representatives;
    const auto allocate = [&](std::size_t n) {
        result.value.items().resize(n);
        result.code.items().resize(n);
        representatives.items().resize(n);
    };
    const auto put = [&](std::size_t first, std::span<const Element> elements) {
        const auto part = [&](auto& array) { return std::span(array).subspan(first, elements.size()); };
        write_fields(part(result.value.items()), elements, [](const Element& element) { return element.key.value; });
        write_fields(part(result.code.items()), elements, [](const Element& element) { return element.key.code.bits; });
        write_fields(part(representatives.items()), elements, [](const Element& element) { return element.representatives; });
    };
    sort_chunks(
        threads, std::move(chunks), [](const Element& element) { return -element.key.value; },
        [&](const Element& p, const Element& q) { return above(p.key, q.key); }, allocate, put);
    return representatives;
}

/// Hands the elements to their tiles, in the order of ranks.
template <class Number>
void cut(const ByElement<Number, Representatives<Number>>& representatives, const Tiling& tiling, PartitionedCriticals<Number>& result) {
    const std::size_t n = result.code.size();
    result.part_of.resize(n);
    result.set.elements.resize(n);
    PartWriters<PartitionedElement<Number>> parts(result.set.elements, result.set.first);
    for (const auto r : streamed<ElementIdOf<Number>>(n, in_order(8))) {
        const ElementCode code{result.code[r]};
        const auto tile = static_cast<std::uint16_t>(tiling.tile_of(code));
        result.part_of[r.index()] = tile;
        parts.put(tile, {representatives[r], branches_of(code.h0(), code.l0())});
    }
    parts.finish();
}

}  // namespace

Tiling tiling_for(const Extent& extent, const Context& context) {
    std::int64_t side = context.slab_slices;
    if (side <= 0) {
        const std::int64_t limit = memory_limit();
        const std::int64_t voxels = limit > 0 ? limit / 4 / thread_count(context.threads) / kBytesAVoxel : kUnlimitedTile;
        const auto fits = [&](std::int64_t s) {
            return std::min(Tiling::kLonger * s, extent.size[0]) * std::min(s, extent.size[1]) * std::min(s, extent.size[2]) <= voxels;
        };
        side = std::max({extent.size[0], extent.size[1], extent.size[2]});
        while (side > 8 && !fits(side)) side -= (side + 7) / 8;
    }
    while (Tiling(extent, side).count() > kMaxTiles) side += (side + 7) / 8;
    return {extent, side};
}

template <class Number>
PartitionedCriticals<Number> parted_criticals(const Extent& extent, GridScan scan, const Tiling& tiling, const Context& context) {
    PartitionedCriticals<Number> result;
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["basins"], 0);
    ChunksWithExtrema<Number> elements;
    result.set.first = first_of_tiles(scan, tiling);
    {
        const auto maxima = renumber(scan, tiling, scan.maxima, MaximumIdOf<Number>(0), [](ElementCode code) { return code.h0() == 0; });
        const auto minima = renumber(scan, tiling, scan.minima, MinimumIdOf<Number>(1), [](ElementCode code) { return code.l0() == 0; });
        elements = elements_with_extrema<Number>(extent, scan, maxima.number, minima.number, nullptr, context.threads);
        result.set.first_maximum = maxima.first;
        result.set.first_minimum = minima.first;
    }
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["sort"], 0);
    const ByElement<Number, Representatives<Number>> representatives =
        sort_elements<Number>(std::move(elements), Above{GridSteps(extent)}, result, context.threads);
    cut(representatives, tiling, result);
    return result;
}

template PartitionedCriticals<std::uint32_t> parted_criticals(const Extent&, GridScan, const Tiling&, const Context&);
template PartitionedCriticals<std::uint64_t> parted_criticals(const Extent&, GridScan, const Tiling&, const Context&);

}  // namespace isoatlas

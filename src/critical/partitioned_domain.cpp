#include "critical/partitioned_domain.h"

#include <algorithm>
#include <utility>

#include "base/cancel.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "base/part_streams.h"
#include "base/phase.h"
#include "critical/elements_with_extrema.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMaxTiles = std::int64_t{1} << 16;
constexpr std::int64_t kBytesAVoxel = 80;  // of noise, while a tile is reduced
constexpr std::int64_t kUnlimitedTile = std::int64_t{1} << 20;

/// Numbers of extrema, tile after tile: those of a tile follow each other.
template <class Id>
struct Renumbering {
    BigVector<Id> number;   // by old number
    std::vector<Id> first;  // by tile, and of the end
};

/// Elements of extrema come in the order of their old numbers, which begin at min.
template <class Id, class IsExtremum>
Renumbering<Id> renumber(const GridScan& scan, const Tiling& tiling, std::int64_t extrema, Id min, const IsExtremum& is_extremum) {
    const PinInMemory keep;
    Renumbering<Id> result;
    result.number.resize(static_cast<std::size_t>(extrema) + min);
    result.first.assign(static_cast<std::size_t>(tiling.count()) + 1, Id{0});
    BudgetPoll memory;
    const auto for_extrema = [&](const auto& visit) {
        for (const BigVector<KeyedElement>& chunk : scan.chunks) {
            for (const KeyedElement& element : chunk) {
                memory.step();
                if (is_extremum(element.code)) visit(static_cast<std::size_t>(tiling.tile_of(element.code)));
            }
        }
    };
    for_extrema([&](std::size_t tile) { ++result.first[tile]; });
    Id next = min;
    for (Id& first : result.first) next += std::exchange(first, next);
    std::vector<Id> number = result.first;
    std::size_t old = 0;
    for (; old < min; ++old) result.number[old] = static_cast<Id>(old);
    for_extrema([&](std::size_t tile) { result.number[old++] = number[tile]++; });
    return result;
}

std::vector<std::size_t> first_of_tiles(const GridScan& scan, const Tiling& tiling) {
    std::vector<std::size_t> first(static_cast<std::size_t>(tiling.count()) + 1, 0);
    BudgetPoll memory;
    for (const BigVector<KeyedElement>& chunk : scan.chunks) {
        for (const KeyedElement& element : chunk) {
            memory.step();
            ++first[tiling.tile_of(element.code)];
        }
    }
    std::size_t next = 0;
    for (std::size_t& place : first) next += std::exchange(place, next);
    return first;
}

/// Sorts the elements: keys by rank. Returns their ends, by rank.
template <class Id>
BigVector<Representatives<Id>> sort_elements(ChunksWithExtrema<Id> chunks, const Above& above, PartitionedCriticals<Id>& result,
                                             int threads) {
    using Element = ElementWithExtrema<Id>;
    BigVector<Representatives<Id>> representatives;
    const auto allocate = [&](std::size_t n) {
        result.value.resize(n);
        result.code.resize(n);
        representatives.resize(n);
    };
    const auto put = [&](std::size_t first, std::span<const Element> elements) {
        const auto part = [&](auto& array) { return std::span(array).subspan(first, elements.size()); };
        write_fields(part(result.value), elements, [](const Element& element) { return element.key.value; });
        write_fields(part(result.code), elements, [](const Element& element) { return element.key.code.bits; });
        write_fields(part(representatives), elements, [](const Element& element) { return element.representatives; });
    };
    sort_chunks(
        threads, std::move(chunks), [](const Element& element) { return -element.key.value; },
        [&](const Element& p, const Element& q) { return above(p.key, q.key); }, allocate, put);
    return representatives;
}

/// Hands the elements to their tiles, in the order of ranks.
template <class Id>
void cut(const BigVector<Representatives<Id>>& representatives, const Tiling& tiling, PartitionedCriticals<Id>& result) {
    const std::size_t n = result.code.size();
    result.part_of.resize(n);
    result.set.elements.resize(n);
    PartWriters<PartitionedElement<Id>> parts(result.set.elements, result.set.first);
    BudgetPoll memory;
    for (std::size_t r = 0; r < n; ++r) {
        memory.step();
        const ElementCode code{result.code[r]};
        const auto tile = static_cast<std::uint16_t>(tiling.tile_of(code));
        result.part_of[r] = tile;
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

template <class Id>
PartitionedCriticals<Id> parted_criticals(const Extent& extent, GridScan scan, const Tiling& tiling, const Context& context) {
    PartitionedCriticals<Id> result;
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["basins"], 0);
    ChunksWithExtrema<Id> elements;
    result.set.first = first_of_tiles(scan, tiling);
    {
        const Renumbering<Id> maxima = renumber<Id>(scan, tiling, scan.maxima, Id{0}, [](ElementCode code) { return code.h0() == 0; });
        const Renumbering<Id> minima = renumber<Id>(scan, tiling, scan.minima, Id{1}, [](ElementCode code) { return code.l0() == 0; });
        elements = elements_with_extrema<Id>(extent, scan, maxima.number, minima.number, nullptr, context.threads);
        result.set.first_maximum = maxima.first;
        result.set.first_minimum = minima.first;
    }
    stop_if_cancelled(context);
    report(context, kAnalysisPhases["sort"], 0);
    const BigVector<Representatives<Id>> representatives =
        sort_elements<Id>(std::move(elements), Above{GridSteps(extent)}, result, context.threads);
    cut(representatives, tiling, result);
    return result;
}

template PartitionedCriticals<std::uint32_t> parted_criticals(const Extent&, GridScan, const Tiling&, const Context&);
template PartitionedCriticals<std::uint64_t> parted_criticals(const Extent&, GridScan, const Tiling&, const Context&);

}  // namespace isoatlas

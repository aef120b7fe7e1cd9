#include "critical/elements_with_extrema.h"

#include <algorithm>
#include <utility>

#include "base/memory_limit.h"
#include "base/paced_fill.h"
#include "base/parallel.h"
#include "base/part_streams.h"

namespace isoatlas {
namespace {

/// Per slab: how many maxima lie in the slabs before.
std::vector<std::int64_t> first_of_slabs(const Extent& extent, std::int64_t height, std::span<const std::uint8_t> links, int threads) {
    std::vector<std::int64_t> first(static_cast<std::size_t>((extent.size[2] + height - 1) / height));
    for_each_block(threads, static_cast<std::int64_t>(first.size()), [&](std::int64_t slab) {
        const std::int64_t z = slab * height, slices = std::min(height, extent.size[2] - z);
        first[slab] = std::ranges::count(links.subspan(z * extent.slice(), slices * extent.slice()), std::uint8_t{0});
    });
    std::int64_t maxima = 0;
    for (std::int64_t& of_slab : first) maxima += std::exchange(of_slab, maxima);
    return first;
}

template <class Id>
std::array<Id, 2> renumbered(std::array<Id, 2> names, std::span<const Id> number) {
    if (number.empty()) return names;
    return {number[names[0]], number[names[1]]};
}

template <class Id>
ChunksWithExtrema<Id> with_maxima(std::vector<BigVector<KeyedElement>> chunks, const RepresentativeLookup<Id>& leads,
                                  std::span<const Id> number, int threads) {
    ChunksWithExtrema<Id> result(chunks.size());
    for_each_block(threads, static_cast<std::int64_t>(chunks.size()), [&](std::int64_t c) {
        result[c] = scratch_chunk<ElementWithExtrema<Id>>();
        result[c].resize(chunks[c].size());
        const std::size_t first = 0;
        PartWriters<ElementWithExtrema<Id>> elements(result[c], {&first, 1});
        BudgetPoll memory;
        for (const KeyedElement& element : chunks[c]) {
            memory.step();
            elements.put(0, {element, {renumbered<Id>(leads.above(element.code), number), {}}});
        }
        elements.finish();
        release(chunks[c]);
    });
    return result;
}

template <class Id>
void add_minima(ChunksWithExtrema<Id>& chunks, const RepresentativeLookup<Id>& leads, std::span<const Id> number, int threads) {
    for_each_block(threads, static_cast<std::int64_t>(chunks.size()), [&](std::int64_t c) {
        constexpr std::size_t kPiece = std::size_t{1} << 12;
        for (std::size_t first = 0; first < chunks[c].size(); first += kPiece, check_memory()) {
            const std::size_t count = std::min(kPiece, chunks[c].size() - first);
            change_part(std::span(chunks[c]).subspan(first, count), [&](std::span<ElementWithExtrema<Id>> piece) {
                for (auto& element : piece) element.representatives.below = renumbered<Id>(leads.below(element.key.code), number);
            });
        }
    });
}

}  // namespace

template <class Id>
BigVector<Id> resolve_basins(const Extent& extent, std::int64_t height, Direction direction, std::span<const std::uint8_t> links,
                             const std::vector<std::int64_t>& first_number, int threads) {
    BigVector<Id> basin(static_cast<std::size_t>(extent.voxels()));
    const auto slabs = static_cast<std::int64_t>(first_number.size());
    Basins<Id> basins(extent, height, direction, links, basin);
    for_each_block(threads, slabs, [&](std::int64_t slab) { basins.forward(slab, first_number[slab]); });
    if (slabs > 1) {
        basins.exits();
        for_each_block(threads, slabs, [&](std::int64_t slab) { basins.finish(slab); });
    }
    return basin;
}

template <class Id>
BigVector<Id> basins_of_maxima(const Extent& extent, std::span<const std::uint8_t> links, const Context& context) {
    const std::int64_t height = slab_height(extent, context);
    return resolve_basins<Id>(extent, height, Direction::up, links, first_of_slabs(extent, height, links, context.threads),
                              context.threads);
}

template <class Id>
ChunksWithExtrema<Id> elements_with_extrema(const Extent& extent, GridScan& scan, std::span<const Id> new_maximum,
                                            std::span<const Id> new_minimum, BigVector<Id>* upward, int threads) {
    ChunksWithExtrema<Id> elements;
    {
        BigVector<Id> up = resolve_basins<Id>(extent, scan.height, Direction::up, scan.links, scan.first_maximum, threads);
        elements = with_maxima<Id>(std::move(scan.chunks), {extent, up}, new_maximum, threads);
        if (upward != nullptr) *upward = std::move(up);
    }
    const BigVector<Id> down = resolve_basins<Id>(extent, scan.height, Direction::down, scan.links, scan.first_minimum, threads);
    release(scan.links);
    add_minima<Id>(elements, {extent, down}, new_minimum, threads);
    return elements;
}

#define ISOATLAS_LEADING(Id)                                                                                                 \
    template BigVector<Id> resolve_basins(const Extent&, std::int64_t, Direction, std::span<const std::uint8_t>,             \
                                          const std::vector<std::int64_t>&, int);                                            \
    template BigVector<Id> basins_of_maxima(const Extent&, std::span<const std::uint8_t>, const Context&);                   \
    template ChunksWithExtrema<Id> elements_with_extrema(const Extent&, GridScan&, std::span<const Id>, std::span<const Id>, \
                                                         BigVector<Id>*, int);
ISOATLAS_LEADING(std::uint32_t)
ISOATLAS_LEADING(std::uint64_t)
#undef ISOATLAS_LEADING

}  // namespace isoatlas

#include "critical/elements_with_extrema.h"

#include <algorithm>
#include <utility>

#include "base/paced_fill.h"
#include "base/parallel.h"
#include "base/part_streams.h"
#include "base/streamed.h"

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

template <class Extremum>
std::array<Extremum, 2> renumbered(std::array<Extremum, 2> names, IdSpan<Extremum, const Extremum> number) {
    if (number.empty()) return names;
    return {number[names[0]], number[names[1]]};
}

template <class Number>
ChunksWithExtrema<Number> with_maxima(std::vector<BigVector<KeyedElement>> chunks, const RepresentativeLookup<Number>& leads,
                                      IdSpan<MaximumIdOf<Number>, const MaximumIdOf<Number>> number, int threads) {
    ChunksWithExtrema<Number> result(chunks.size());
    for_each_block(threads, static_cast<std::int64_t>(chunks.size()), [&](std::int64_t c) {
        result[c] = scratch_chunk<ElementWithExtrema<Number>>();
        result[c].resize(chunks[c].size());
        const std::size_t first = 0;
        PartWriters<ElementWithExtrema<Number>> elements(result[c], {&first, 1});
        for (const std::size_t i : streamed(chunks[c].size(), in_order(8))) {
            const KeyedElement& element = chunks[c][i];
            elements.put(0, {element, {renumbered(leads.above(element.code), number), {}}});
        }
        elements.finish();
        release(chunks[c]);
    });
    return result;
}

template <class Number>
void add_minima(ChunksWithExtrema<Number>& chunks, const RepresentativeLookup<Number>& leads,
                IdSpan<MinimumIdOf<Number>, const MinimumIdOf<Number>> number, int threads) {
    for_each_block(threads, static_cast<std::int64_t>(chunks.size()), [&](std::int64_t c) {
        constexpr std::size_t kPiece = std::size_t{1} << 12;
        for (const Block block : streamed_blocks(chunks[c].size(), kPiece)) {
            change_part(std::span(chunks[c]).subspan(block.first, block.size()), [&](std::span<ElementWithExtrema<Number>> piece) {
                for (auto& element : piece) element.representatives.below = renumbered(leads.below(element.key.code), number);
            });
        }
    });
}

}  // namespace

template <class Number>
BigVector<Number> resolve_basins(const Extent& extent, std::int64_t height, Direction direction, std::span<const std::uint8_t> links,
                                 const std::vector<std::int64_t>& first_number, int threads) {
    BigVector<Number> basin(static_cast<std::size_t>(extent.voxels()));
    const auto slabs = static_cast<std::int64_t>(first_number.size());
    Basins<Number> basins(extent, height, direction, links, basin);
    for_each_block(threads, slabs, [&](std::int64_t slab) { basins.forward(slab, first_number[slab]); });
    if (slabs > 1) {
        basins.exits();
        for_each_block(threads, slabs, [&](std::int64_t slab) { basins.finish(slab); });
    }
    return basin;
}

template <class Number>
BigVector<Number> basins_of_maxima(const Extent& extent, std::span<const std::uint8_t> links, const Context& context) {
    const std::int64_t height = slab_height(extent, context);
    return resolve_basins<Number>(extent, height, Direction::up, links, first_of_slabs(extent, height, links, context.threads),
                                  context.threads);
}

template <class Number>
ChunksWithExtrema<Number> elements_with_extrema(const Extent& extent, GridScan& scan,
                                                IdSpan<MaximumIdOf<Number>, const MaximumIdOf<Number>> new_maximum,
                                                IdSpan<MinimumIdOf<Number>, const MinimumIdOf<Number>> new_minimum,
                                                BigVector<Number>* upward, int threads) {
    ChunksWithExtrema<Number> elements;
    {
        BigVector<Number> up = resolve_basins<Number>(extent, scan.height, Direction::up, scan.links, scan.first_maximum, threads);
        elements = with_maxima<Number>(std::move(scan.chunks), {extent, up}, new_maximum, threads);
        if (upward != nullptr) *upward = std::move(up);
    }
    const BigVector<Number> down = resolve_basins<Number>(extent, scan.height, Direction::down, scan.links, scan.first_minimum, threads);
    release(scan.links);
    add_minima<Number>(elements, {extent, down}, new_minimum, threads);
    return elements;
}

// NOLINTBEGIN(bugprone-macro-parentheses): Number is a type
#define ISOATLAS_LEADING(Number)                                                                                     \
    template BigVector<Number> resolve_basins(const Extent&, std::int64_t, Direction, std::span<const std::uint8_t>, \
                                              const std::vector<std::int64_t>&, int);                                \
    template BigVector<Number> basins_of_maxima(const Extent&, std::span<const std::uint8_t>, const Context&);       \
    template ChunksWithExtrema<Number> elements_with_extrema(                                                        \
        const Extent&, GridScan&, IdSpan<MaximumIdOf<Number>, const MaximumIdOf<Number>>,                            \
        IdSpan<MinimumIdOf<Number>, const MinimumIdOf<Number>>, BigVector<Number>*, int);
ISOATLAS_LEADING(std::uint32_t)
ISOATLAS_LEADING(std::uint64_t)
#undef ISOATLAS_LEADING
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas

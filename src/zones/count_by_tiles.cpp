#include "zones/count_voxels.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/memory_limit.h"
#include "base/part_streams.h"
#include "base/sample_types.h"
#include "base/streamed.h"
#include "critical/partitioned_domain.h"
#include "field/slab_work.h"
#include "tree/marked_sets.h"
#include "zones/count_tile.h"

namespace isoatlas {
namespace {

/// Elements tile after tile, descending within a tile.
template <class Id>
struct TiledElements {
    BigVector<std::uint16_t> tile;   // by rank
    std::vector<std::size_t> first;  // per tile, and of the end
    BigVector<KeyedElement> key;
    BigVector<CountedElement<Id>> counted;

    TiledElements(std::span<const double> value, std::span<const std::uint64_t> code, const Tiling& tiling)
        : tile(code.size()), first(static_cast<std::size_t>(tiling.count()) + 1, 0), key(code.size()), counted(code.size()) {
        for (const std::size_t r : streamed(code.size(), in_order(8))) {
            tile[r] = static_cast<std::uint16_t>(tiling.tile_of(ElementCode{code[r]}));
            ++first[tile[r]];
        }
        std::size_t end = 0;
        for (std::size_t& of_tile : first) end += std::exchange(of_tile, end);
        PartWriters<KeyedElement> keys(key, first);
        for (const std::size_t r : streamed(code.size(), in_order(8))) keys.put(tile[r], {value[r], ElementCode{code[r]}});
        keys.finish();
    }
    template <class Array>
    [[nodiscard]] auto of(std::size_t t, Array& array) const {
        return std::span(array).subspan(first[t], first[t + 1] - first[t]);
    }
};

/// Values that cut the elements into so many runs, about equal.
std::vector<double> bounds_of_buckets(std::span<const double> value, std::size_t buckets) {
    std::vector<double> bounds;
    for (const std::size_t b : streamed(buckets - 1, at_random())) {
        const double bound = value[(b + 1) * value.size() / buckets];
        if (bounds.empty() || bound < bounds.back()) bounds.push_back(bound);
    }
    return bounds;
}

std::size_t bucket_count(std::int64_t voxels, std::size_t bytes) {
    constexpr std::int64_t kMax = 1024, kUnlimited = std::int64_t{1} << 28;
    const std::int64_t limit = memory_limit() > 0 ? memory_limit() : kUnlimited;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(voxels * static_cast<std::int64_t>(bytes) / (limit / 32), 1, kMax));
}

/// All elements in the order of ranks: counts within tiles are taken over, voxels of open components go to the last element of theirs.
template <class T, class Id>
BigVector<Id> merge(std::span<const double> value, const TiledElements<Id>& elements, std::size_t representatives,
                    OpenVoxelBuckets<T, Id>& open, int threads) {
    const std::size_t n = value.size();
    BigVector<Id> voxels(n);
    MarkedSets<Id, ArrayAllocator<Id>> components;  // marks: the last element
    components.start(representatives, [](Id) { return Id{0}; });
    PartReaders<CountedElement<Id>> counted(elements.counted, elements.first);
    const auto pass = [&](std::size_t r) {
        const CountedElement<Id>& element = counted.next(elements.tile[r]);
        voxels[r] = element.voxels;
        auto [a, b] = element.representatives;
        if (a == kNoRepresentative<Id>) std::swap(a, b);
        if (a == kNoRepresentative<Id>) return;
        a = components.find(a);
        if (b != kNoRepresentative<Id>) a = components.join(a, components.find(b));
        components.mark(a) = static_cast<Id>(r);
    };
    StreamedLoops ranks;
    std::size_t r = 0;
    const auto pass_up_to = [&](std::size_t end) { ranks.over(std::exchange(r, end), end, in_order(8), pass); };
    for (std::size_t bucket = 0; bucket < open.count(); ++bucket) {
        open.take(bucket, threads, [&](const OpenVoxels<T, Id>& record) {
            std::size_t end = r;
            while (end < n && value[end] >= static_cast<double>(record.value)) ++end;
            pass_up_to(end);
            voxels[components.mark(components.find(record.representative))] += record.count;
        });
    }
    pass_up_to(n);
    return voxels;
}

}  // namespace

template <class T, class Id>
ByElement<Id, Id> voxels_by_tiles(const GridView<T>& grid, ByElementView<Id, double> values, ByElementView<Id, std::uint64_t> codes,
                                  const Context& context) {
    const std::span<const double> value = values.items();
    const std::span<const std::uint64_t> code = codes.items();
    const Tiling tiling = tiling_for(grid.extent, context);
    TiledBasins<Id> basins = tiled_basins<T, Id>(grid, tiling, context);
    const std::size_t representatives = basins.open.count();
    TiledElements<Id> elements(value, code, tiling);
    OpenVoxelBuckets<T, Id> open(bounds_of_buckets(value, bucket_count(grid.extent.voxels(), sizeof(OpenVoxels<T, Id>))));
    for_each_slab_of(1, context, kAnalysisPhases["zones"], tiling.count(), [&](const Slab& tile) {
        const auto t = static_cast<std::size_t>(tile.z_begin);
        count_tile<T, Id>(grid, tiling, tile.z_begin, basins, elements.of(t, elements.key), elements.of(t, elements.counted), open);
    });
    release(basins.maximum);
    release(elements.key);
    const PinInMemory keep;
    return ByElement<Id, Id>(merge(value, elements, representatives, open, context.threads));
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define ISOATLAS_BY_TILES(T)                                                                                                       \
    template ByElement<std::uint32_t, std::uint32_t> voxels_by_tiles(const GridView<T>&, ByElementView<std::uint32_t, double>,     \
                                                                     ByElementView<std::uint32_t, std::uint64_t>, const Context&); \
    template ByElement<std::uint64_t, std::uint64_t> voxels_by_tiles(const GridView<T>&, ByElementView<std::uint64_t, double>,     \
                                                                     ByElementView<std::uint64_t, std::uint64_t>, const Context&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_BY_TILES)
#undef ISOATLAS_BY_TILES
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas

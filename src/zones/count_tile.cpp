#include "zones/count_tile.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/part_streams.h"
#include "base/sample_types.h"
#include "critical/representative_lookup.h"
#include "tree/local_numbers.h"
#include "tree/marked_sets.h"

namespace isoatlas {
namespace {

template <class T, class Id>
struct TileVoxel {
    T value;
    Id maximum;
};

/// Few different values: counted. Many: sorted.
template <class T, class Id>
void sort_descending(std::vector<TileVoxel<T, Id>>& voxels) {
    using Voxel = TileVoxel<T, Id>;
    if constexpr (std::is_integral_v<T> && sizeof(T) <= 2) {
        constexpr int kHighest = std::numeric_limits<T>::max();
        const auto [low, high] = std::minmax_element(voxels.begin(), voxels.end(), [](auto p, auto q) { return p.value < q.value; });
        const int max = high->value, range = max - low->value + 1;
        static_assert(kHighest <= 65535);
        std::vector<std::size_t> place(static_cast<std::size_t>(range), 0);
        for (const Voxel& voxel : voxels) ++place[max - voxel.value];
        std::size_t next = 0;
        for (std::size_t& of_value : place) next += std::exchange(of_value, next);
        std::vector<Voxel> sorted(voxels.size());
        for (const Voxel& voxel : voxels) sorted[place[max - voxel.value]++] = voxel;
        voxels.swap(sorted);
    } else {
        sort_by_steps(
            std::span(voxels), [](const Voxel& voxel) { return -static_cast<double>(voxel.value); },
            [](const Voxel& p, const Voxel& q) { return p.value > q.value; });
    }
}

template <class T, class Id>
std::vector<TileVoxel<T, Id>> voxels_of_tile(const GridView<T>& grid, const Tiling& tiling, std::int64_t tile,
                                             std::span<const Id> maximum) {
    const auto begin = tiling.begin(tile), end = tiling.end(tile);
    std::vector<TileVoxel<T, Id>> voxels;
    voxels.reserve(static_cast<std::size_t>((end - begin).product()));
    const std::int64_t nx = grid.extent.size[0], rows = end[1] - begin[1], length = end[0] - begin[0];
    std::vector<T> sample_buffer;
    std::vector<Id> maximum_buffer;
    for (std::int64_t z = begin[2]; z < end[2]; ++z) {
        const auto first = static_cast<std::size_t>(begin[0] + nx * (begin[1] + grid.extent.size[1] * z));
        const auto count = static_cast<std::size_t>((rows - 1) * nx + length);
        const std::span<const T> samples = part_in_memory<T>({grid.samples + first, count}, sample_buffer);
        const std::span<const Id> maxima = part_in_memory<Id>(maximum.subspan(first, count), maximum_buffer);
        for (std::int64_t row = 0; row < rows * nx; row += nx) {
            for (std::int64_t v = row; v < row + length; ++v) voxels.push_back({samples[v], maxima[v]});
        }
    }
    return voxels;
}

/// The sweep over the elements of a tile.
template <class Id>
class TileSweep {
public:
    TileSweep(const TiledBasins<Id>& basins, const LocalNumbers<Id>& numbers)
        : last_(numbers.size(), Id{0}), representative_(numbers.size()) {
        components_.start(numbers.size(), [](Id c) { return c; });
        for (Id c = 0; c < representative_.size(); ++c) {
            const Id maximum = numbers.global(c);
            representative_[c] = basins.open.has(maximum) ? static_cast<Id>(basins.open.rank(maximum)) : kNoRepresentative<Id>;
        }
    }
    /// Returns the representatives of the open components that it meets.
    [[nodiscard]] std::array<Id, 2> pass(Id element, Id first, Id second) {
        const Id a = components_.find(first), b = components_.find(second);
        const std::array<Id, 2> representatives{representative_[a], a == b ? kNoRepresentative<Id> : representative_[b]};
        const Id both = components_.join(a, b);
        representative_[both] = representatives[0] != kNoRepresentative<Id> ? representatives[0] : representatives[1];
        last_[both] = element;
        return representatives;
    }
    [[nodiscard]] Id find(Id maximum) { return components_.find(maximum); }
    [[nodiscard]] Id last(Id component) const { return last_[component]; }
    [[nodiscard]] Id representative(Id component) const { return representative_[component]; }

private:
    MarkedSets<Id> components_;
    std::vector<Id> last_, representative_;
};

}  // namespace

template <class T, class Id>
void count_tile(const GridView<T>& grid, const Tiling& tiling, std::int64_t tile, const TiledBasins<Id>& basins,
                std::span<const KeyedElement> elements, std::span<CountedElement<Id>> counted, OpenVoxelBuckets<T, Id>& open) {
    using Record = OpenVoxels<T, Id>;
    std::vector<TileVoxel<T, Id>> voxels = voxels_of_tile<T, Id>(grid, tiling, tile, basins.maximum);
    sort_descending(voxels);
    const RepresentativeLookup<Id> leads(grid.extent, basins.maximum);
    const Id begin = basins.first[tile], end = basins.first[tile + 1];
    std::vector<std::array<Id, 2>> above(elements.size());
    std::vector<Id> foreign;
    const auto note = [&](Id maximum) {
        if (maximum < begin || maximum >= end) foreign.push_back(maximum);
    };
    for (std::size_t e = 0; e < above.size(); ++e) {
        const auto [first, second] = leads.above(elements[e].code);
        above[e] = {first.number(), second.number()};
        for (const Id maximum : above[e]) note(maximum);
    }
    for (const TileVoxel<T, Id>& voxel : voxels) note(voxel.maximum);
    const LocalNumbers<Id> numbers(begin, end, std::move(foreign));

    TileSweep<Id> sweep(basins, numbers);
    std::vector<Record> records;
    std::size_t next = 0;
    const auto pass_down_to = [&](double value) {
        for (; next < above.size() && elements[next].value >= value; ++next) {
            const std::array<Id, 2> representatives =
                sweep.pass(static_cast<Id>(next), numbers.local(above[next][0]), numbers.local(above[next][1]));
            counted[next] = {0, representatives};
        }
    };
    for (const TileVoxel<T, Id>& voxel : voxels) {
        pass_down_to(static_cast<double>(voxel.value));
        const Id component = sweep.find(numbers.local(voxel.maximum)), representative = sweep.representative(component);
        if (representative == kNoRepresentative<Id>) {
            ++counted[sweep.last(component)].voxels;
        } else if (!records.empty() && records.back().value == voxel.value && records.back().representative == representative) {
            ++records.back().count;
        } else {
            records.push_back({voxel.value, representative, 1});
        }
    }
    pass_down_to(-std::numeric_limits<double>::infinity());
    open.add(records);
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define ISOATLAS_COUNT_TILE(T)                                                                                   \
    template void count_tile(const GridView<T>&, const Tiling&, std::int64_t, const TiledBasins<std::uint32_t>&, \
                             std::span<const KeyedElement>, std::span<CountedElement<std::uint32_t>>,            \
                             OpenVoxelBuckets<T, std::uint32_t>&);                                               \
    template void count_tile(const GridView<T>&, const Tiling&, std::int64_t, const TiledBasins<std::uint64_t>&, \
                             std::span<const KeyedElement>, std::span<CountedElement<std::uint64_t>>,            \
                             OpenVoxelBuckets<T, std::uint64_t>&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_COUNT_TILE)
#undef ISOATLAS_COUNT_TILE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace isoatlas

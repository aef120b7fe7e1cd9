#include "critical/grid_domain.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "critical/links.h"

namespace isoatlas {
namespace {

constexpr int kPhases = 5;  // of analyse(): classify, basins, sort, trees, zones

void stop_if_cancelled(const Context& context) {
    if (context.cancelled && context.cancelled()) throw Error(ErrorKind::cancelled, {.what = "cancelled"});
}

/// Where the surroundings of a critical element lead (theory.md section 4, step 2).
template <class Id>
class Representatives {
public:
    Representatives(const Extent& extent, std::span<const Id> up, std::span<const Id> down)
        : extent_(extent), steps_(extent), up_(up), down_(down) {}

    [[nodiscard]] std::array<Id, 4> of(ElementCode code) const {
        if (code.kind() == CodeKind::vertex) return vertex(code);
        return code.is_body() ? body(code) : face(code);
    }

private:
    [[nodiscard]] Id high(std::int64_t v) const { return Basins<Id>::number(up_[v]); }
    [[nodiscard]] Id low(std::int64_t v) const { return Basins<Id>::number(down_[v]); }

    [[nodiscard]] std::array<Id, 4> vertex(ElementCode code) const {
        const std::int64_t v = code.index();
        if (code.h0() == 2) {
            const std::int64_t step = steps_.axis[code.axis()];
            const auto [low_a, low_b] = code.l0() == 2 ? lows(v, 1 - code.axis()) : std::array{low(v), low(v)};
            return {high(v - step), high(v + step), low_a, low_b};
        }
        const auto [low_a, low_b] = code.l0() == 2 ? lows(v, code.axis()) : std::array{low(v), low(v)};
        return {high(v), high(v), low_a, low_b};
    }

    /// Outside the grid lies the outside.
    [[nodiscard]] std::array<Id, 2> lows(std::int64_t v, int axis) const {
        const std::int64_t step = steps_.axis[axis], size = extent_.size[axis], position = v / step % size;
        return {position > 0 ? low(v - step) : Id{0}, position + 1 < size ? low(v + step) : Id{0}};
    }

    [[nodiscard]] std::array<Id, 4> face(ElementCode code) const {
        const int first_high = code.bd_high() ? 1 : 0, first_low = 1 - first_high;
        const auto corner = [&](int i) { return steps_.face_voxel(code.index(), i); };
        const Id high_a = high(corner(first_high)), low_a = low(corner(first_low));
        return {high_a, code.h0() == 2 ? high(corner(first_high + 2)) : high_a, low_a, code.l0() == 2 ? low(corner(first_low + 2)) : low_a};
    }

    [[nodiscard]] std::array<Id, 4> body(ElementCode code) const {
        const auto corner = [&](int i) { return steps_.cell_corner(code.cell(), code.body_corner(i)); };
        const std::int64_t a = corner(0), b = corner(1), ring = corner(2);
        if (code.kind() == CodeKind::body_open) return {high(a), high(b), low(ring), low(ring)};
        return {high(ring), high(ring), low(a), low(b)};
    }

    const Extent& extent_;
    GridSteps steps_;
    std::span<const Id> up_, down_;
};

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

/// Sorts the elements, takes them apart into arrays, and looks up where each one leads.
template <class Id>
CriticalSet<Id> sort_elements(std::vector<BigVector<KeyedElement>> chunks, const Above& above, const Representatives<Id>& leads,
                              int threads) {
    BigVector<KeyedElement> sorted =
        sort_chunks(threads, std::move(chunks), [](const KeyedElement& element) { return -element.value; }, above);
    const std::size_t n = sorted.size();
    CriticalSet<Id> set;
    set.value.resize(n);
    set.code.resize(n);
    for_each_index(threads, n, [&](std::size_t i) { set.value[i] = sorted[i].value, set.code[i] = sorted[i].code.bits; });
    release(sorted);
    for (BigVector<Id>* field : {&set.up_a, &set.up_b, &set.low_a, &set.low_b}) field->resize(n);
    for_each_index(threads, n, [&](std::size_t i) {
        const std::array<Id, 4> to = leads.of(ElementCode{set.code[i]});
        set.up_a[i] = to[0], set.up_b[i] = to[1], set.low_a[i] = to[2], set.low_b[i] = to[3];
    });
    return set;
}

}  // namespace

std::int64_t slab_height(const Extent& extent, const Context& context) {
    if (context.slab_slices > 0) return std::min(context.slab_slices, extent.size[2]);
    const std::int64_t slabs = std::int64_t{4} * thread_count(context.threads);
    return std::max<std::int64_t>({1, std::min<std::int64_t>(8, extent.size[2]), (extent.size[2] + slabs - 1) / slabs});
}

template <class T, class IdType>
Criticals<IdType> GridDomain<T, IdType>::critical(const Context& context) const {
    const Extent& extent = grid_.extent;
    const std::int64_t height = slab_height(extent, context), slabs = (extent.size[2] + height - 1) / height;
    BigVector<std::uint8_t> links(static_cast<std::size_t>(extent.voxels()));
    std::vector<SlabScan> scans(slabs);
    context.report("classify", 0, kPhases, 0);
    for_each_block(context.threads, slabs, [&](std::int64_t i) {
        stop_if_cancelled(context);
        const Slab slab = slab_at(i, height, extent.size[2]);
        const std::int64_t first = slab.z_begin * extent.slice(), count = (slab.z_end - slab.z_begin) * extent.slice();
        scans[i] = scan_slab(grid_, slab, std::span<std::uint8_t>(links).subspan(first, count), tunnel_height_);
    });

    std::vector<std::int64_t> first_maximum(slabs), first_minimum(slabs);
    std::int64_t maxima = 0, minima = 0;
    std::vector<BigVector<KeyedElement>> elements;
    for (std::int64_t i = 0; i < slabs; ++i) {
        first_maximum[i] = std::exchange(maxima, maxima + scans[i].maxima);
        first_minimum[i] = std::exchange(minima, minima + scans[i].minima);
        for (BigVector<KeyedElement>& chunk : scans[i].chunks) elements.push_back(std::move(chunk));
    }
    stop_if_cancelled(context);
    context.report("basins", 1, kPhases, 0);
    Criticals<Id> result;
    result.basin = resolve_basins<Id>(extent, height, Direction::up, links, first_maximum, context.threads);
    const BigVector<Id> down = resolve_basins<Id>(extent, height, Direction::down, links, first_minimum, context.threads);
    release(links);
    stop_if_cancelled(context);
    context.report("sort", 2, kPhases, 0);
    result.set = sort_elements<Id>(std::move(elements), above_, {extent, result.basin, down}, context.threads);
    result.set.maxima = maxima, result.set.minima = minima, result.set.rank = extent.rank;
    return result;
}

#define ISOATLAS_GRID(T)                         \
    template class GridDomain<T, std::uint32_t>; \
    template class GridDomain<T, std::uint64_t>;
ISOATLAS_GRID(std::uint8_t)
ISOATLAS_GRID(std::int8_t)
ISOATLAS_GRID(std::uint16_t)
ISOATLAS_GRID(std::int16_t)
ISOATLAS_GRID(std::uint32_t)
ISOATLAS_GRID(std::int32_t)
ISOATLAS_GRID(float)
ISOATLAS_GRID(double)
#undef ISOATLAS_GRID
static_assert(Domain<GridDomain<float, std::uint32_t>>);

}  // namespace isoatlas

#include "levelset/contour_counts.h"

#include <atomic>
#include <bit>

#include "critical/open_tunnel.h"
#include "field/slab_work.h"
#include "levelset/active_cells.h"

namespace isoatlas {
namespace {

/// Adds to shared totals; neighbouring cells mostly lie on one contour, so totals are touched when the contour changes only.
class Tally {
public:
    explicit Tally(ContourCounts& totals) : totals_(totals) {}
    Tally(const Tally&) = delete;
    Tally& operator=(const Tally&) = delete;
    ~Tally() { flush(); }

    void add(ContourNumber contour, int hits, int loops = 1) {
        if (contour != contour_) {
            flush();
            contour_ = contour;
        }
        hits_ += hits;
        loops_ += loops;
    }

private:
    void flush() {
        if (hits_ == 0 && loops_ == 0) return;
        std::atomic_ref(totals_.hits[contour_]).fetch_add(hits_, std::memory_order_relaxed);
        std::atomic_ref(totals_.loops[contour_]).fetch_add(loops_, std::memory_order_relaxed);
        hits_ = loops_ = 0;
    }
    ContourCounts& totals_;
    ContourNumber contour_ = ContourNumber::none();
    std::int64_t hits_ = 0, loops_ = 0;
};

/// The contour between two components, as a ComponentCursor gives them.
ContourNumber contour_between(const Components& components, std::int32_t object, std::int32_t low) {
    return components.contour_between(ObjectNumber(object), LowNumber(low));
}

/// tunnels: null where cells have none.
template <class T>
void count_cell_row(const FaceJoiner<T>& joiner, const TunnelFinder<T>* tunnels, const HighBits& high, const Components& components,
                    std::int64_t y, std::int64_t z, Tally& tally) {
    const CellCaseTables& cases = cell_cases();
    std::array<ComponentCursor, 4> cursor{ComponentCursor(components, y, z), ComponentCursor(components, y + 1, z),
                                          ComponentCursor(components, y, z + 1), ComponentCursor(components, y + 1, z + 1)};
    for_active_cells(cell_row(high, y, z), CellWindow::all(high.extent().size[0]), [&](std::int64_t p, int pattern) {
        std::array<std::int32_t, 8> component;
        for (int k = 0; k < 8; ++k) component[k] = cursor[k / 2].at(p + (k & 1));
        const int split = cases.split_faces[pattern];
        const int joined = split == 0 ? 0 : joiner.joined_mask({p - 1, y, z}, pattern, split);
        const CellLoops& loops = cases.loops[cases.case_of(pattern, joined)];
        for (int loop = 0; loop < loops.count; ++loop) {
            const std::array<int, 2>& ends = kEdgeCorners[loops.edge[loops.begin[loop]]];
            const bool first_is_high = pattern >> ends[0] & 1;
            tally.add(contour_between(components, component[ends[first_is_high ? 0 : 1]], component[ends[first_is_high ? 1 : 0]]),
                      loops.size(loop));
        }
        if (tunnels == nullptr || p == 0 || p == high.extent().size[0]) return;
        const std::optional<OpenTunnel> tunnel = (*tunnels)({p - 1, y, z}, pattern, joined);
        if (!tunnel) return;
        const std::int32_t joined_component = component[std::countr_zero(tunnel->a)], ring = component[std::countr_zero(tunnel->ring)];
        tally.add(
            tunnel->joins_highs ? contour_between(components, joined_component, ring) : contour_between(components, ring, joined_component),
            0, -2);
    });
}

/// 2D: corners 0 1 of row y, 2 3 of row y + 1. Every hit is an end of one segment in each of two squares.
void count_square_row(const HighBits& high, const Components& components, std::int64_t y, Tally& tally) {
    std::array<ComponentCursor, 2> cursor{ComponentCursor(components, y, 0), ComponentCursor(components, y + 1, 0)};
    static constexpr int kSides[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    for_active_cells(square_row(high, y), CellWindow::all(high.extent().size[0]), [&](std::int64_t p, int pattern) {
        std::array<std::int32_t, 4> component;
        for (int k = 0; k < 4; ++k) component[k] = cursor[k / 2].at(p + (k & 1));
        for (const auto& side : kSides) {
            const bool first_is_high = pattern >> side[0] & 1;
            if (first_is_high == (pattern >> side[1] & 1)) continue;
            tally.add(contour_between(components, component[side[first_is_high ? 0 : 1]], component[side[first_is_high ? 1 : 0]]), 1);
        }
    });
}

template <class T>
void count_3d(const SampleGrid<T>& grid, double tau, double tunnel_height, const HighBits& high, const Components& components,
              const Context& context, ContourCounts& counts) {
    const FaceJoiner<T> joiner{grid, tau};
    const TunnelFinder<T> tunnels(grid, tau, tunnel_height);
    const auto is_inner = [](std::int64_t row, std::int64_t size) { return row >= 0 && row + 1 < size; };
    std::atomic<std::int64_t> active{0};
    for_each_slab(context, kCutPhases["contours"], {grid.extent.size[2] + 1, grid.extent.slice()}, [&](const Slab& slab) {
        Tally tally(counts);
        std::int64_t cells = 0;
        for (std::int64_t z = slab.z_begin - 1; z < slab.z_end - 1; ++z) {
            for (std::int64_t y = -1; y < grid.extent.size[1]; ++y) {
                cells += count_active_cells(cell_row(high, y, z), CellWindow::all(grid.extent.size[0]));
                const bool has_tunnels = tunnels.finds_any() && is_inner(y, grid.extent.size[1]) && is_inner(z, grid.extent.size[2]);
                count_cell_row(joiner, has_tunnels ? &tunnels : nullptr, high, components, y, z, tally);
            }
        }
        active += cells;
    });
    counts.active_cells = active;
    for (std::int64_t& hits : counts.hits.items()) {
        ISOATLAS_CHECK(hits % 4 == 0);  // every edge lies in four cells
        hits /= 4;
    }
}

}  // namespace

ContourCounts count_contours(const SampleView& volume, double tau, double tunnel_height, const HighBits& high, const Components& components,
                             const Context& context) {
    const Extent& extent = volume.info->extent;
    const auto contours = static_cast<std::size_t>(components.contours());
    ContourCounts counts{{contours, 0}, {contours, 0}, 0};
    if (extent.rank == 2) {
        {
            Tally tally(counts);
            for (std::int64_t y = -1; y < extent.size[1]; ++y) {
                counts.active_cells += count_active_cells(square_row(high, y), CellWindow::all(extent.size[0]));
                count_square_row(high, components, y, tally);
            }
        }
        for (const ContourNumber c : counts.hits.ids()) {
            ISOATLAS_CHECK(counts.hits[c] % 2 == 0);
            counts.hits[c] /= 2;
            counts.loops[c] = 0;
        }
        return counts;
    }
    visit_grid(volume, [&](const auto& grid) { count_3d(grid, tau, tunnel_height, high, components, context, counts); });
    return counts;
}

}  // namespace isoatlas

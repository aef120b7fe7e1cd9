#include "mesh/count_cells.h"

#include <atomic>

#include "field/slab_work.h"
#include "mesh/extract_level.h"
#include "mesh/layout.h"

namespace isoatlas {
namespace {

/// Sum of count(y, z) over all rows of cells.
template <class Count>
std::int64_t sum_rows(const MeshDomain& domain, const Context& context, const Count& count) {
    if (domain.is_empty()) return 0;
    const bool flat = domain.is_2d();
    const std::int64_t rows_y = domain.y_end - domain.y_begin, rows_z = domain.z_end - domain.z_begin;
    const Slices slices = flat ? Slices{rows_y, domain.high.extent().size[0]} : Slices{rows_z, domain.high.extent().slice()};
    std::atomic<std::int64_t> sum = 0;
    for_each_slab(context, kSelectPhases["cells"], slices, [&](const Slab& slab) {
        std::int64_t own = 0;
        for (std::int64_t i = slab.z_begin; i < slab.z_end; ++i) {
            if (flat) own += count(domain.y_begin + i, domain.z_begin);
            for (std::int64_t y = 0; !flat && y < rows_y; ++y) own += count(domain.y_begin + y, domain.z_begin + i);
        }
        sum += own;
    });
    return sum;
}

/// Components at the corners of the cells of a row; kRows as in active_cells.h.
template <int kRows>
class CornerCursor {
public:
    CornerCursor(const Components& components, std::int64_t y, std::int64_t z) : components_(components) {
        for (int r = 0; r < kRows; ++r) cursors_.emplace_back(components, y + (r & 1), z + (r >> 1));
    }
    /// Does one of the chosen contours pass through cell p? p must not be smaller than in the call before.
    [[nodiscard]] bool meets(std::int64_t p, int pattern, IdSpan<ContourNumber, const std::uint8_t> chosen) {
        std::array<std::int32_t, 2 * kRows> corner;
        for (int r = 0; r < kRows; ++r) {
            corner[2 * r] = cursors_[r].at(p);
            corner[2 * r + 1] = cursors_[r].at(p + 1);
        }
        for (int c = 0; c < 2 * kRows; ++c) {
            for (int step = 1; step < 2 * kRows; step *= 2) {
                const int other = c ^ step;
                const bool high = pattern >> c & 1, other_high = pattern >> other & 1;
                if (!high || other_high) continue;
                if (chosen[components_.contour_between(ObjectNumber(corner[c]), LowNumber(corner[other]))]) return true;
            }
        }
        return false;
    }

private:
    const Components& components_;
    std::vector<ComponentCursor> cursors_;
};

template <int kRows>
std::int64_t count_row(const MeshDomain& domain, const CellRow<kRows>& rows, CornerCursor<kRows> corners,
                       IdSpan<ContourNumber, const std::uint8_t> chosen) {
    std::int64_t count = 0;
    for_active_cells(rows, domain.cells, [&](std::int64_t p, int pattern) { count += corners.meets(p, pattern, chosen); });
    return count;
}

}  // namespace

std::int64_t count_cells(const TauLevel& level, Boundary boundary, const Context& context) {
    const MeshDomain domain(level.high, boundary);
    return sum_rows(domain, context, [&](std::int64_t y, std::int64_t z) -> std::int64_t {
        if (level.high.candidates(y, z).empty()) return 0;
        if (domain.is_2d()) return count_active_cells(square_row(level.high, y), domain.cells);
        return count_active_cells(cell_row(level.high, y, z), domain.cells);
    });
}

std::int64_t count_cells(const TauLevel& level, Boundary boundary, const Components& components,
                         IdSpan<ContourNumber, const std::uint8_t> chosen, const Context& context) {
    const MeshDomain domain(level.high, boundary);
    return sum_rows(domain, context, [&](std::int64_t y, std::int64_t z) {
        if (domain.is_2d()) return count_row<2>(domain, square_row(level.high, y), {components, y, 0}, chosen);
        return count_row<4>(domain, cell_row(level.high, y, z), {components, y, z}, chosen);
    });
}

}  // namespace isoatlas

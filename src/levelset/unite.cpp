#include "levelset/unite.h"

#include <bit>

#include "critical/open_tunnel.h"
#include "field/slab_work.h"
#include "levelset/active_cells.h"

namespace isoatlas {
namespace {

template <class T>
class RunJoiner {
public:
    RunJoiner(const SampleGrid<T>& grid, double tau, double tunnel_height, const HighBits& high, const Runs& runs, RunSets& sets)
        : extent_(grid.extent), joined_{grid, tau}, tunnels_(grid, tau, tunnel_height), high_(high), runs_(runs), sets_(sets) {}

    /// All connections inside slice z.
    void join_inside(std::int64_t z) {
        for (std::int64_t y = 0; y + 1 < extent_.size[1]; ++y) {
            if (!high_.candidates(y, z).empty()) join_rows(y, z, y + 1, z, 0);
        }
    }
    /// All connections between slices z and z + 1, the faces and the cells between them.
    void join_upwards(std::int64_t z) {
        for (std::int64_t y = 0; y < extent_.size[1]; ++y) {
            if (high_.candidates(y, z).empty()) continue;
            join_rows(y, z, y, z + 1, 1);
            if (y + 1 < extent_.size[1]) join_faces_across(y, z);
            if (y + 1 < extent_.size[1] && tunnels_.finds_any()) join_tunnels(y, z);
        }
    }

private:
    /// Run i of row a and run j of row b. What lies outside is represented by the first run of the other row: rows at a time belong to one
    /// thread, and their last run is the first of the next row.
    void join(const RunRow& a, std::int64_t i, const RunRow& b, std::int64_t j) {
        if (a.is_outside(i) && b.is_outside(j)) return;
        const RunId from = a.is_outside(i) ? b.first_run : a.run(i), to = b.is_outside(j) ? a.first_run : b.run(j);
        sets_.join(from.number(), to.number());
    }

    /// Overlapping runs of one class, and the 4-hit faces between two neighbouring rows (orientation xy or xz).
    void join_rows(std::int64_t y0, std::int64_t z0, std::int64_t y1, std::int64_t z1, int orientation) {
        const RunRow a = runs_.row(y0, z0), b = runs_.row(y1, z1);
        const std::int64_t end = extent_.size[0] + 2;
        for (std::int64_t i = 0, j = 0;;) {
            if (((i ^ j) & 1) == 0) join(a, i, b, j);
            const std::int64_t end_a = i < a.changes ? a.change[i] : end, end_b = j < b.changes ? b.change[j] : end;
            if (end_a == end && end_b == end) return;
            if (end_a == end_b && ((i ^ j) & 1) == 1) {  // both rows change here, in opposite directions
                const bool a_is_high = i & 1;
                const bool joined = joined_({end_a - 2, y0, z0}, orientation, a_is_high ? Diagonal::ac : Diagonal::bd);
                if (a_is_high == joined)
                    join(a, i, b, j + 1);
                else
                    join(a, i + 1, b, j);
            }
            i += end_a <= end_b;
            j += end_b <= end_a;
        }
    }

    /// The 4-hit yz faces between the rows (y, z), (y + 1, z), (y, z + 1), (y + 1, z + 1).
    void join_faces_across(std::int64_t y, std::int64_t z) {
        const CellRow<4> rows = cell_row(high_, y, z);
        rows.candidates.for_each([&](std::int64_t w) {
            const std::uint64_t a = rows.row[0][w], b = rows.row[1][w], d = rows.row[2][w], c = rows.row[3][w];
            for (std::uint64_t rest = (a ^ b) & ~(a ^ c) & ~(b ^ d); rest != 0; rest &= rest - 1) {
                const int bit = std::countr_zero(rest);
                const std::int64_t p = 64 * w + bit;
                const bool a_is_high = a >> bit & 1;
                const bool joined = joined_({p - 1, y, z}, 2, a_is_high ? Diagonal::ac : Diagonal::bd);
                if (a_is_high == joined)
                    join_at(p, runs_.row(y, z), runs_.row(y + 1, z + 1));
                else
                    join_at(p, runs_.row(y + 1, z), runs_.row(y, z + 1));
            }
        });
    }
    void join_at(std::int64_t position, const RunRow& a, const RunRow& b) { join(a, a.index_at(position), b, b.index_at(position)); }

    /// The two regions that a tunnel through a cell of the row (y, z) joins.
    void join_tunnels(std::int64_t y, std::int64_t z) {
        const CellCaseTables& cases = cell_cases();
        for_active_cells(cell_row(high_, y, z), CellWindow::real(extent_.size[0]), [&](std::int64_t p, int pattern) {
            const int split = cases.split_faces[pattern];
            const int joined = split == 0 ? 0 : joined_.joined_mask({p - 1, y, z}, pattern, split);
            const std::optional<OpenTunnel> tunnel = tunnels_({p - 1, y, z}, pattern, joined);
            if (!tunnel) return;
            const int i = std::countr_zero(tunnel->a), j = std::countr_zero(tunnel->b);
            const auto row_of = [&](int corner) { return runs_.row(y + (corner >> 1 & 1), z + (corner >> 2)); };
            const RunRow a = row_of(i), b = row_of(j);
            join(a, a.index_at(p + (i & 1)), b, b.index_at(p + (j & 1)));
        });
    }

    const Extent& extent_;
    FaceJoiner<T> joined_;
    TunnelFinder<T> tunnels_;
    const HighBits& high_;
    const Runs& runs_;
    RunSets& sets_;
};

}  // namespace

RunSets unite_runs(const SampleView& volume, double tau, double tunnel_height, const HighBits& high, const Runs& runs,
                   const Context& context) {
    RunSets sets(static_cast<std::size_t>(runs.count()));
    visit_grid(volume, [&]<class T>(const SampleGrid<T>& grid) {
        RunJoiner<T> joiner(grid, tau, tunnel_height, high, runs, sets);
        const Slices slices{grid.extent.size[2], grid.extent.slice()};
        // Slabs own disjoint ranges of runs, so they may unite at the same time; the seams between them follow.
        for_each_slab(context, kCutPhases["objects"], slices, [&](const Slab& slab) {
            for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
                joiner.join_inside(z);
                if (z + 1 < slab.z_end) joiner.join_upwards(z);
            }
        });
        const std::int64_t height = slab_height(context, slices);
        for (std::int64_t z = height; z < slices.count; z += height) joiner.join_upwards(z - 1);
    });
    return sets;
}

}  // namespace isoatlas

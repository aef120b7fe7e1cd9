#include "levelset/component_representatives.h"

#include <algorithm>
#include <limits>

#include "field/slab_work.h"

namespace isoatlas {
namespace {

constexpr Extremum kNone{VoxelId::none(), 0};

/// The representative of Highs is their highest voxel, of Lows their lowest.
bool beats(bool high, const Extremum& a, const Extremum& b) {
    if (!a.voxel.exists() || !b.voxel.exists()) return a.voxel.exists();
    return high ? a.is_above(b) : b.is_above(a);
}

template <class T>
class Namer {
public:
    Namer(const SampleGrid<T>& grid, const LevelBricks* bricks, const Components& components)
        : grid_(grid), bricks_(bricks), components_(components), runs_(components.runs) {
        highest_.items().assign(static_cast<std::size_t>(components.objects()), kNone);
        lowest_.items().assign(static_cast<std::size_t>(components.lows()), kNone);
        if (bricks_ != nullptr) take_bricks();
    }

    /// From the samples: extremes of runs first, on several threads, then of components.
    void take_runs(const Context& context) {
        constexpr auto kNowhere = std::numeric_limits<std::uint32_t>::max();
        IdArray<RunId, std::uint32_t> found(static_cast<std::size_t>(runs_.count()), kNowhere);
        const std::int64_t ny = grid_.extent.size[1];
        for_each_row(context, kCutPhases["objects"], grid_.extent, [&](std::int64_t y, std::int64_t z) {
            for_named_runs(y + ny * z, [&](const RunRow& row, std::int64_t i, bool high) {
                const Extremum best = extreme_of_run(row, i, high, y, z);
                if (best.voxel.exists()) found[row.run(i)] = static_cast<std::uint32_t>(best.voxel.number() - grid_.extent.index(0, y, z));
            });
        });
        for (std::int64_t r = 0; r < runs_.rows(); ++r) {
            for_named_runs(r, [&](const RunRow& row, std::int64_t i, bool high) {
                const std::uint32_t x = found[row.run(i)];
                if (x != kNowhere) offer(high, row.run(i), extremum_at(r * grid_.extent.size[0] + x));
            });
        }
    }

    [[nodiscard]] const IdArray<ObjectNumber, Extremum>& highest() const { return highest_; }
    [[nodiscard]] const IdArray<LowNumber, Extremum>& lowest() const { return lowest_; }

private:
    /// Not the runs of the outside: it has no representative.
    template <class Visit>
    void for_named_runs(std::int64_t r, Visit&& visit) const {
        const RunRow row = runs_.row(r);
        for (std::int64_t i = 1; i < row.changes; ++i) {
            const bool high = i & 1;
            if (high || components_.low_of(row.run(i)) != LowNumber(0)) visit(row, i, high);
        }
    }

    [[nodiscard]] Extremum extremum_at(std::int64_t voxel) const {
        return {VoxelId(voxel), static_cast<double>(grid_.at(grid_.extent.voxel(voxel)))};
    }
    /// Of the component of a run so far.
    [[nodiscard]] Extremum& best(bool high, RunId run) {
        return high ? highest_[components_.object_of(run)] : lowest_[components_.low_of(run)];
    }
    [[nodiscard]] const Extremum& best(bool high, RunId run) const {
        return high ? highest_[components_.object_of(run)] : lowest_[components_.low_of(run)];
    }
    void offer(bool high, RunId run, const Extremum& extremum) {
        Extremum& known = best(high, run);
        if (beats(high, extremum, known)) known = extremum;
    }

    /// The extremes of bricks. A brick that is High as a whole has no better voxel; a divided one may have one for another component.
    void take_bricks() {
        const auto take = [&](bool high, const Extremum& extremum) {
            const Index3 at = grid_.extent.voxel(extremum.voxel.number());
            const RunRow row = runs_.row(at[1], at[2]);
            const RunId run = row.run_at(at[0] + 1);
            ISOATLAS_CHECK(row.is_high(run) == high);
            offer(high, run, extremum);
        };
        divided_.assign(static_cast<std::size_t>(bricks_->grid.size[1] * bricks_->grid.size[2]), {kNone, kNone});
        for (const BrickId b : bricks_->classes.ids()) {
            if (bricks_->classes[b] != BrickClass::low) take(true, bricks_->highest[b]);
            if (bricks_->classes[b] != BrickClass::high) take(false, bricks_->lowest[b]);
            if (bricks_->classes[b] != BrickClass::divided) continue;
            auto& [high, low] = divided_[b.index() / static_cast<std::size_t>(bricks_->grid.size[0])];
            if (beats(true, bricks_->highest[b], high)) high = bricks_->highest[b];
            if (beats(false, bricks_->lowest[b], low)) low = bricks_->lowest[b];
        }
    }

    /// The extreme voxel of a run, as far as it may become that of its component.
    [[nodiscard]] Extremum extreme_of_run(const RunRow& row, std::int64_t i, bool high, std::int64_t y, std::int64_t z) const {
        const std::int64_t begin = row.change[i - 1] - 1, end = row.change[i] - 1;
        if (bricks_ == nullptr) return extreme_of_stretch(begin, end, high, y, z);
        const Extremum& known = best(high, row.run(i));
        const std::int64_t row_of_bricks = y / kBrickSize[1] + bricks_->grid.size[1] * (z / kBrickSize[2]);
        const auto& [row_high, row_low] = divided_[row_of_bricks];
        Extremum found = kNone;
        if (!beats(high, high ? row_high : row_low, known)) return found;
        for (std::int64_t x = begin; x < end;) {
            const BrickId b(x / kBrickRow + bricks_->grid.size[0] * row_of_bricks);
            const std::int64_t next = std::min(end, (x / kBrickRow + 1) * kBrickRow);
            if (bricks_->classes[b] == BrickClass::divided && beats(high, high ? bricks_->highest[b] : bricks_->lowest[b], known)) {
                const Extremum here = extreme_of_stretch(x, next, high, y, z);
                if (beats(high, here, found)) found = here;
            }
            x = next;
        }
        return found;
    }

    /// Of a part of a row that lies in one brick, where there are bricks.
    [[nodiscard]] Extremum extreme_of_stretch(std::int64_t begin, std::int64_t end, bool high, std::int64_t y, std::int64_t z) const {
        const T* samples = grid_.samples + grid_.layout.at(begin, y, z);
        std::int64_t found = 0;
        if (high) {
            for (std::int64_t i = 1; i < end - begin; ++i) found = samples[i] >= samples[found] ? i : found;
        } else {
            for (std::int64_t i = 1; i < end - begin; ++i) found = samples[i] < samples[found] ? i : found;
        }
        return extremum_at(grid_.extent.index(begin + found, y, z));
    }

    const SampleGrid<T>& grid_;
    const LevelBricks* bricks_;
    const Components& components_;
    const Runs& runs_;
    IdArray<ObjectNumber, Extremum> highest_;
    IdArray<LowNumber, Extremum> lowest_;
    std::vector<std::array<Extremum, 2>> divided_;  ///< per row of bricks: highest and lowest voxel of its divided bricks
};

template <class Number>
IdArray<Number, VoxelId> voxels_of(const IdArray<Number, Extremum>& extrema) {
    IdArray<Number, VoxelId> voxels(extrema.size());
    for (const Number component : extrema.ids()) voxels[component] = extrema[component].voxel;
    return voxels;
}

}  // namespace

void find_representatives(const TauLevel& level, const Context& context, Components& components) {
    visit_grid(level.volume, [&]<class T>(const SampleGrid<T>& grid) {
        Namer<T> namer(grid, level.bricks, components);
        namer.take_runs(context);
        components.highest = voxels_of(namer.highest());
        components.lowest = voxels_of(namer.lowest());
    });
    components.lowest[LowNumber(0)] = VoxelId::none();  // the outside has no representative
}

}  // namespace isoatlas

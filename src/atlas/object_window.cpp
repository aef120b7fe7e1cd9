#include "atlas/object_window.h"

#include <algorithm>
#include <utility>

#include "bricks/stored_samples.h"
#include "levelset/components.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMargin = 3;
constexpr std::int64_t kSmallBox = 512;  ///< bricks

/// The flagged bricks, and one more on every side.
Box box_around(const BrickFlags& bricks, const BrickGrid& grid) {
    Box box{grid.size, {0, 0, 0}};
    for (const BrickId b : grid.bricks()) {
        if (!bricks[b]) continue;
        box.begin = min(box.begin, max(grid.place(b) - 1, {0, 0, 0}));
        box.end = max(box.end, min(grid.place(b) + 2, grid.size));
    }
    return box;
}

/// Bounds of the object that contains a voxel of the window; empty: the voxel is Low.
std::optional<Box> bounds_of(const StoredWindow& window, std::int64_t voxel, double tau, double tunnel_height, const Context& context) {
    const Components components = find_components(window.at(tau), tunnel_height, context);
    const Extent& extent = window.info.extent;
    const Index3 at = extent.voxel(voxel);
    const RunRow home = components.runs.row(at[1], at[2]);
    const RunId run = home.run_at(at[0] + 1);
    if (!home.is_high(run)) return std::nullopt;
    const ObjectNumber object = components.object_of(run);
    Box box{extent.size, {0, 0, 0}};
    for (std::int64_t r = 0; r < components.runs.rows(); ++r) {
        const RunRow row = components.runs.row(r);
        for (std::int64_t i = 1; i < row.changes; i += 2) {
            if (components.object_of(row.run(i)) != object) continue;
            const Index3 low{row.change[i - 1] - std::int64_t{1}, r % extent.size[1], r / extent.size[1]};
            const Index3 high{row.change[i] - std::int64_t{1}, low[1] + 1, low[2] + 1};
            box.begin = min(box.begin, low);
            box.end = max(box.end, high);
        }
    }
    return box;
}

/// Moves the ends of a box of bricks that are too close to the object. Returns whether any moved.
bool grow(Box& bricks, const Box& object, const StoredWindow& window, const BrickGrid& grid) {
    bool moved = false;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t step = bricks.size(axis);
        if (object.begin[axis] < kMargin && bricks.begin[axis] > 0) {
            bricks.begin[axis] = std::max<std::int64_t>(bricks.begin[axis] - step, 0);
            moved = true;
        }
        if (object.end[axis] > window.info.extent.size[axis] - kMargin && bricks.end[axis] < grid.size[axis]) {
            bricks.end[axis] = std::min(bricks.end[axis] + step, grid.size[axis]);
            moved = true;
        }
    }
    return moved;
}

}  // namespace

ObjectPart part_of_object(StoredSamples& samples, std::int64_t voxel, double tau, double tunnel_height, bool is_alone,
                          const Context& context, LevelQuery& query) {
    const BrickGrid& grid = samples.grid();
    ObjectPart part;
    if (grid.extent.rank == 2 || voxel < 0 || voxel >= grid.extent.voxels()) return part;
    const Index3 at = grid.extent.voxel(voxel);
    const Index3 home = BrickGrid::place_of(at);
    Box bricks{home, home + 1};
    Context alone = context;
    alone.threads = 1;
    alone.progress = nullptr;
    while (2 * bricks.count() <= grid.count()) {
        if (is_alone && bricks.count() > kSmallBox && part.bricks.empty()) {
            ObjectBricks found = samples.bricks_of_objects(tau, {voxel}, context, query, kWorthGrowing);
            part.bricks = std::move(found.bricks);
            if (found.is_tight) {
                bricks = box_around(part.bricks, grid);
                if (2 * bricks.count() <= grid.count()) part.window = samples.classify_window(tau, bricks, part.bricks, alone, query);
                return part;
            }
        }
        StoredWindow window = samples.classify_window(tau, bricks, BrickFlags(), alone, query);
        const std::int64_t local = window.info.extent.index(at - window.window.origin);
        const std::optional<Box> object = bounds_of(window, local, tau, tunnel_height, alone);
        if (!object) return part;
        if (!grow(bricks, *object, window, grid)) {
            part.window = std::move(window);
            return part;
        }
    }
    return part;
}

}  // namespace isoatlas

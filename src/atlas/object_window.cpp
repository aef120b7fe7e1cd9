#include "atlas/object_window.h"

#include <algorithm>

#include "bricks/stored_samples.h"
#include "levelset/components.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kMargin = 3;

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

std::optional<StoredWindow> window_of_object(StoredSamples& samples, std::int64_t voxel, double tau, double tunnel_height,
                                             const Context& context, LevelQuery& query) {
    const BrickGrid& grid = samples.grid();
    if (grid.extent.rank == 2 || voxel < 0 || voxel >= grid.extent.voxels()) return std::nullopt;
    const Index3 at = grid.extent.voxel(voxel);
    const Index3 home = BrickGrid::place_of(at);
    Box bricks{home, home + 1};
    Context alone = context;
    alone.threads = 1;
    alone.progress = nullptr;
    while (2 * bricks.count() <= grid.count()) {
        StoredWindow window = samples.classify_window(tau, bricks, alone, query);
        const std::int64_t local = window.info.extent.index(at - window.window.origin);
        const std::optional<Box> object = bounds_of(window, local, tau, tunnel_height, alone);
        if (!object) return std::nullopt;
        if (!grow(bricks, *object, window, grid)) return window;
    }
    return std::nullopt;
}

}  // namespace isoatlas

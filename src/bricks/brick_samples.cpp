#include "bricks/brick_samples.h"

#include <algorithm>

#include "base/check.h"
#include "base/sample_types.h"

namespace isoatlas {
namespace {

/// The first step at or after a sample, for steps that start at `begin`.
std::int64_t first_step(std::int64_t sample, std::int64_t begin, std::int64_t step) {
    return sample <= begin ? 0 : steps_along(sample - begin, step);
}

/// The steps of each axis of a box that lie in a brick.
Box steps_in(const Box& brick, const Box& box, std::int64_t step) {
    Box steps{};
    for (int a = 0; a < 3; ++a) {
        steps.begin[a] = first_step(brick.begin[a], box.begin[a], step);
        steps.end[a] = std::max(steps.begin[a], first_step(std::min(brick.end[a], box.end[a]), box.begin[a], step));
    }
    return steps;
}

std::vector<BrickId> bricks_with_steps(const BrickGrid& grid, const Box& box, std::int64_t step) {
    std::vector<BrickId> wanted;
    const Index3 first = BrickGrid::place_of(box.begin);
    const Index3 last = BrickGrid::place_of(box.end - 1);
    for (std::int64_t z = first[2]; z <= last[2]; ++z) {
        for (std::int64_t y = first[1]; y <= last[1]; ++y) {
            for (std::int64_t x = first[0]; x <= last[0]; ++x) {
                const BrickId brick = grid.brick({x, y, z});
                if (steps_in(grid.box(brick), box, step).count() > 0) wanted.push_back(brick);
            }
        }
    }
    return wanted;
}

/// The mean of a box of samples of a brick, which begins at (0, 0, 0).
template <class T>
float mean_of(std::span<const T> samples, const Index3& size, const Box& box) {
    double sum = 0;
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
            const T* row = samples.data() + size[0] * (y + size[1] * z);
            for (std::int64_t x = box.begin[0]; x < box.end[0]; ++x) sum += static_cast<double>(row[x]);
        }
    }
    return static_cast<float>(sum / static_cast<double>(box.count()));
}

}  // namespace

template <class T>
void read_samples(const BrickReader<T>& bricks, const Box& box, std::int64_t step, const Context& context, std::span<T> out,
                  IoCounters& counters) {
    const BrickGrid& grid = bricks.grid();
    const std::int64_t columns = steps_along(box.size(0), step), rows = steps_along(box.size(1), step);
    counters += bricks.read(bricks_with_steps(grid, box, step), context, [&](BrickId brick, std::span<const T> samples) {
        const Box own = grid.box(brick), steps = steps_in(own, box, step);
        const auto inside = [&](int axis, std::int64_t s) { return box.begin[axis] + s * step - own.begin[axis]; };
        for (std::int64_t z = steps.begin[2]; z < steps.end[2]; ++z) {
            for (std::int64_t y = steps.begin[1]; y < steps.end[1]; ++y) {
                const T* row = samples.data() + own.size(0) * (inside(1, y) + own.size(1) * inside(2, z));
                for (std::int64_t x = steps.begin[0]; x < steps.end[0]; ++x) out[x + columns * (y + rows * z)] = row[inside(0, x)];
            }
        }
    });
}

template <class T>
void read_means(const BrickReader<T>& bricks, std::int64_t step, std::int64_t layer, const Context& context, std::span<float> out,
                IoCounters& counters) {
    ISOATLAS_CHECK(step == 1 || step == 2 || step == 4 || step == 8);
    const BrickGrid& grid = bricks.grid();
    const Box whole{{0, 0, 0}, grid.extent.size};
    const std::int64_t columns = steps_along(grid.extent.size[0], step), rows = steps_along(grid.extent.size[1], step);
    std::vector<BrickId> wanted;
    for (const BrickId brick : grid.bricks_of_layer(layer)) wanted.push_back(brick);
    counters += bricks.read(std::move(wanted), context, [&](BrickId brick, std::span<const T> samples) {
        const Box own = grid.box(brick), cubes = steps_in(own, whole, step);
        for (std::int64_t z = cubes.begin[2]; z < cubes.end[2]; ++z) {
            for (std::int64_t y = cubes.begin[1]; y < cubes.end[1]; ++y) {
                for (std::int64_t x = cubes.begin[0]; x < cubes.end[0]; ++x) {
                    const Index3 begin = Index3{x * step, y * step, z * step} - own.begin;
                    out[x + columns * (y + rows * z)] = mean_of(samples, own.size(), {begin, min(begin + step, own.size())});
                }
            }
        }
    });
}

#define ISOATLAS_INSTANTIATE(T)                                                                                                \
    template void read_samples<T>(const BrickReader<T>&, const Box&, std::int64_t, const Context&, std::span<T>, IoCounters&); \
    template void read_means<T>(const BrickReader<T>&, std::int64_t, std::int64_t, const Context&, std::span<float>, IoCounters&);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas

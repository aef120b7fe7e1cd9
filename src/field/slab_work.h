// Slabs as the unit of parallel work, with progress and cancellation.
#pragma once

#include <functional>

#include "base/phase.h"
#include "field/grid.h"
#include "isoatlas/context.h"

namespace isoatlas {

/// Slices of equal size.
struct Slices {
    std::int64_t count;
    std::int64_t voxels;  ///< of one slice
};

/// Height of a slab: given by the context, or a few slabs for each thread, none too small to be worth a thread.
[[nodiscard]] std::int64_t slab_height(const Context& context, const Slices& slices);

/// Runs work on the slabs that cover all slices. Progress is reported, and cancellation polled, by the calling thread only.
/// Throws Error{cancelled}, or what work throws.
void for_each_slab(const Context& context, const Phase& phase, const Slices& slices, const std::function<void(const Slab&)>& work);

/// The same for slabs of a given height.
void for_each_slab_of(std::int64_t height, const Context& context, const Phase& phase, std::int64_t slices,
                      const std::function<void(const Slab&)>& work);

/// Calls visit(y, z) for every row of a volume: slabs of slices in 3D, of rows in 2D. Rows must not depend on each other.
template <class Visit>
void for_each_row(const Context& context, const Phase& phase, const Extent& extent, Visit&& visit) {
    const bool is_3d = extent.rank == 3;
    const Slices slices = is_3d ? Slices{extent.size[2], extent.slice()} : Slices{extent.size[1], extent.size[0]};
    for_each_slab(context, phase, slices, [&](const Slab& slab) {
        for (std::int64_t i = slab.z_begin; i < slab.z_end; ++i) {
            if (!is_3d) visit(i, std::int64_t{0});
            for (std::int64_t y = 0; is_3d && y < extent.size[1]; ++y) visit(y, i);
        }
    });
}

}  // namespace isoatlas

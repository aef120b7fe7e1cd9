// Slabs as the unit of parallel work, with progress and cancellation.
#pragma once

#include <functional>
#include <string_view>

#include "field/grid.h"
#include "isoatlas/context.h"

namespace isoatlas {

struct Phase {
    std::string_view name;
    int index, count;
};

/// Slices of equal size.
struct Slices {
    std::int64_t count;
    std::int64_t voxels;  ///< of one slice
};

/// Height of a slab: what the context says, or a few slabs for each thread, none too small to be worth a thread.
[[nodiscard]] std::int64_t slab_height(const Context& context, const Slices& slices);

/// Runs work on the slabs that cover all slices. Progress is reported, and cancellation polled, by the calling thread only.
/// Throws Error{cancelled}, or what work throws.
void for_each_slab(const Context& context, const Phase& phase, const Slices& slices, const std::function<void(const Slab&)>& work);

}  // namespace isoatlas

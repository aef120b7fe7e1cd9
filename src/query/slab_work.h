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

/// Height of a slab: what the context says, or a few slabs for each thread.
[[nodiscard]] std::int64_t slab_height(const Context& context, std::int64_t slices);

/// Runs work on the slabs that cover [0, slices). Progress is reported, and cancellation polled, by the calling thread only.
/// Throws Error{cancelled}, or what work throws.
void for_each_slab(const Context& context, const Phase& phase, std::int64_t slices, const std::function<void(const Slab&)>& work);

}  // namespace isoatlas

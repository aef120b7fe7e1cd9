#include "field/slab_work.h"

#include <algorithm>
#include <atomic>

#include "base/cancel.h"
#include "base/parallel.h"

namespace isoatlas {

std::int64_t slab_height(const Context& context, const Slices& slices) {
    if (context.slab_slices > 0) return context.slab_slices;
    constexpr std::int64_t kMinVoxels = 1 << 15;
    const std::int64_t slabs = 8 * static_cast<std::int64_t>(thread_count(context.threads));
    const std::int64_t shared = std::clamp<std::int64_t>((slices.count + slabs - 1) / slabs, 1, 64);
    return std::max(shared, kMinVoxels / std::max<std::int64_t>(slices.voxels, 1));
}

void for_each_slab(const Context& context, const Phase& phase, const Slices& slices, const std::function<void(const Slab&)>& work) {
    for_each_slab_of(slab_height(context, slices), context, phase, slices.count, work);
}

void for_each_slab_of(std::int64_t height, const Context& context, const Phase& phase, std::int64_t slices,
                      const std::function<void(const Slab&)>& work) {
    const std::int64_t slabs = (slices + height - 1) / height;
    const CallerLooks look(context);
    std::atomic<std::int64_t> done{0};
    context.report(phase.name, phase.index, phase.count, 0);
    stop_if_cancelled(context);
    for_each_block(context.threads, slabs, [&](std::int64_t i) {
        look();
        work(slab_at(i, height, slices));
        const std::int64_t finished = ++done;
        if (look.is_caller())
            context.report(phase.name, phase.index, phase.count, static_cast<double>(finished) / static_cast<double>(slabs));
    });
    stop_if_cancelled(context);
}

}  // namespace isoatlas

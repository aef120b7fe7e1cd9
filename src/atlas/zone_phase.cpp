#include "atlas/zone_phase.h"

#include <algorithm>

#include "atlas/event_arrays.h"
#include "atlas/object_arrays.h"
#include "atlas/tree_arrays.h"
#include "features/rank.h"

namespace isoatlas {
namespace {

void add_tables(const Analysis& analysis, const VolumeView& volume, const Context& quiet, const std::function<void(double)>& done,
                ZonePhase& phase) {
    const ObjectsAndCavities tables = rank_both(volume, analysis, {.top = kStoredEntries}, quiet, &phase.sums);
    done(0.9);
    const auto add = [&phase](std::vector<PackedArray> more) { std::ranges::move(more, std::back_inserter(phase.arrays)); };
    add(object_arrays(tables.objects, polarity_of(*volume.info)));
    add(cavity_arrays(tables.cavities));
    if (!stores_events(analysis)) return;
    add(event_arrays(analysis));
    phase.arrays.push_back(event_sum_array(phase.sums.height.items()));
}

Context silent(Context context) {
    context.progress = nullptr;
    return context;
}

}  // namespace

std::unique_ptr<ZonePhase> zone_phase(ContourArcs arcs, const VolumeView& volume, const Context& context, const Context& counting,
                                      const std::function<void(double)>& done) {
    auto phase = std::make_unique<ZonePhase>();
    phase->voxels = count_voxels(arcs, volume, counting);
    phase->arrays.push_back(voxel_array(phase->voxels));
    if (static_cast<std::int64_t>(arcs.elements()) > kTableElements) return phase;
    done(0);
    phase->analysis = make_analysis(std::move(arcs), phase->voxels, volume, silent(context));
    done(0.3);
    add_tables(*phase->analysis, volume, silent(context), done, *phase);
    return phase;
}

std::unique_ptr<ZonePhase> zone_tables(const Analysis& analysis, const VolumeView& volume, const Context& context) {
    auto phase = std::make_unique<ZonePhase>();
    if (analysis.element_count() <= kTableElements) add_tables(analysis, volume, silent(context), [](double) {}, *phase);
    return phase;
}

}  // namespace isoatlas

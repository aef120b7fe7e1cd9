// What the tree promises at an isovalue is what a cut finds there (cut_test.cpp compares cuts with the oracle).
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "oracle/bodies.h"
#include "oracle/compare.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

// Objects at tau are the events whose zone contains tau.
void tree_and_cut_agree_on_every_object() {
    const Grid grid = *arbitrary_grid(7, 343);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Elements elements = elements_of(grid, interpolant);
    const isoatlas::Volume volume = to_volume(grid);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const double tau = *rc::gen::elementOf(interesting_values(elements));
    const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.interpolant = interpolant});
    std::size_t objects = 0;
    for (const isoatlas::EventId i : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        const isoatlas::Event event = analysis.event(i);
        if (!(event.zone.tau_low < tau && tau <= event.zone.tau_high)) continue;
        ++objects;
        const auto found = std::find_if(cut.objects.begin(), cut.objects.end(), [&](const isoatlas::CutObject& o) {
            isoatlas::EventId zone = analysis.zone(isoatlas::VoxelId(o.id));
            while (analysis.event(zone).zone.tau_low >= tau) zone = analysis.event(zone).parent;
            return zone == i;
        });
        RC_ASSERT(found != cut.objects.end());
        RC_ASSERT(found->chi == event.chi);
        RC_ASSERT(found->b1 == event.b1);
        RC_ASSERT(found->b2 == event.b2);
        RC_ASSERT(found->contour_count == event.contours);
    }
    RC_ASSERT(objects == cut.objects.size());
}

RC_GTEST_PROP(TreeAndCut, AgreeOnEveryObject, ()) { tree_and_cut_agree_on_every_object(); }

}  // namespace
}  // namespace oracle

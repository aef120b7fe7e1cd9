// At every isovalue as many handles are open as the contours have tunnels.
#include "isoatlas/handles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/cut.h"
#include "isoatlas/phantom.h"
#include "oracle/difference.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Handle;
using isoatlas::Volume;

void handles_are_as_many_as_tunnels_at_every_isovalue() {
    const Grid grid = *arbitrary_grid(7, 200);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid);
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    const std::vector<Handle> handles = isoatlas::pair_handles(analysis);
    if (grid.rank == 2) RC_ASSERT(handles.empty());
    for (const double tau : interesting_values(elements_of(grid, interpolant))) {
        if (grid.rank == 2) break;
        const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.interpolant = interpolant});
        Index open = 0, genus = 0;
        for (const Handle& handle : handles) open += handle.closes < tau && tau <= handle.opens;
        for (const isoatlas::CutContour& contour : cut.contours) genus += contour.genus;
        RC_ASSERT(open == genus);
    }
    for (std::size_t i = 0; i < handles.size(); ++i) {
        RC_ASSERT(handles[i].persistence() > 0);
        if (i > 0) RC_ASSERT(handles[i - 1].persistence() >= handles[i].persistence());
        RC_ASSERT(analysis.event(handles[i].event).value >= handles[i].opens);
        RC_ASSERT(analysis.event(handles[i].event).zone.tau_low < handles[i].opens);
    }
    const double min = handles.empty() ? 1 : handles[handles.size() / 2].persistence();
    const auto many = std::count_if(handles.begin(), handles.end(), [&](const Handle& handle) { return handle.persistence() >= min; });
    RC_ASSERT(static_cast<std::ptrdiff_t>(isoatlas::pair_handles(analysis, min).size()) == many);
}

// The tunnels of a chain of tori stand out from all others.
TEST(Handles, OfAChainOfToriAreTheLongest) {
    const Volume volume = isoatlas::make_phantom("torus-chain", {.size = 32, .genus = 4});
    const std::vector<Handle> handles = isoatlas::pair_handles(isoatlas::analyse(volume));
    ASSERT_GE(handles.size(), 4U);
    EXPECT_GT(handles[3].persistence(), 0.4);
    const double next = handles.size() > 4 ? handles[4].persistence() : 0;
    EXPECT_LT(next, 0.5 * handles[3].persistence());
}

RC_GTEST_PROP(Handles, AreAsManyAsTunnelsAtEveryIsovalue, ()) { handles_are_as_many_as_tunnels_at_every_isovalue(); }

}  // namespace
}  // namespace oracle

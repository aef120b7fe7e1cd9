// Zones of volumes too large for the oracle, proved step by step: every voxel's value lies in its zone's interval; a voxel with a higher
// neighbour lies in the event that the neighbour's zone climbs to; one without lies in the event it makes, or in that of its plateau.
// Together these force T6 (docs/theory/3-trees.md#zones) by induction from high to low.
#include <gtest/gtest.h>

#include <cmath>

#include "isoatlas/phantom.h"
#include "oracle/compare.h"

namespace isoatlas {
namespace {

using oracle::Index;

void check_zones(const Volume& volume, const Context& context) {
    const oracle::Grid grid = oracle::to_grid(volume);
    const Analysis analysis = analyse(volume, {}, context);
    std::vector<Event> events;
    for (const EventId i : ids<EventId>(analysis.event_count())) events.push_back(analysis.event(i));
    std::vector<Index> voxels(events.size(), 0);
    for (Index v = 0; v < grid.voxels(); ++v) {
        const EventId zone = analysis.zone(VoxelId(v));
        const double value = grid.value[v];
        ASSERT_TRUE(events[zone.index()].zone.tau_low < value && value <= events[zone.index()].value) << "voxel " << v;
        ++voxels[zone.index()];
        bool is_maximum = true;
        for (int d = 0; d < grid.directions(); ++d) {
            const Index w = grid.neighbour(v, d);
            if (w < 0 || grid.value[w] < value) continue;
            is_maximum = false;
            EventId climbed = analysis.zone(VoxelId(w));
            while (events[climbed.index()].zone.tau_low >= value) climbed = events[climbed.index()].parent;
            ASSERT_EQ(climbed, zone) << "voxel " << v << " beside " << w;
        }
        if (is_maximum) {
            ASSERT_EQ(events[zone.index()].value, value) << "voxel " << v;
        }
    }
    for (std::size_t e = 0; e < events.size(); ++e) {
        ASSERT_EQ(voxels[e], events[e].zone.voxels) << "event " << e;
        Index object = voxels[e];
        for (const EventId child : events[e].children) object += events[child.index()].object_voxels;
        ASSERT_EQ(object, events[e].object_voxels) << "event " << e;
        if (events[e].objects_in == 0) {
            const std::array<double, 3>& p = events[e].position;
            const VoxelId highest(grid.index(static_cast<Index>(p[0]), static_cast<Index>(p[1]), static_cast<Index>(p[2])));
            ASSERT_EQ(analysis.zone(highest), EventId(e));
        }
    }
}

TEST(Zones, OfPhantomsFollowFromTheirNeighbours) {
    for (const char* name :
         {"figure-plateau", "figure-smooth", "nested-shells", "gyroid", "checkerboard", "marschner-lobb", "random-field", "noise"}) {
        SCOPED_TRACE(name);
        PhantomOptions options;
        if (std::string(name).find("figure") == std::string::npos) options.size = 18;
        options.shells = 1;
        check_zones(make_phantom(name, options), {});
        options.noise = 0.02;
        Context context;
        context.threads = 2;
        context.slab_slices = 5;
        check_zones(make_phantom(name, options), context);
        options.quantise = 64;
        check_zones(make_phantom(name, options), context);
    }
}

// Long paths whose values crowd at one end: the search by buckets must fall back.
TEST(Zones, OfSkewedValuesFollowFromTheirNeighbours) {
    PhantomOptions options;
    options.size = 16;
    const Volume volume = make_phantom("noise", options);
    for (const double power : {12.0, 0.02}) {
        Volume skewed = make_volume(volume.info.extent, ValueType::f64);
        for (Index v = 0; v < volume.info.extent.voxels(); ++v) {
            skewed.samples<double>()[static_cast<std::size_t>(v)] = std::pow(volume.value(v), power);
        }
        check_zones(skewed, {});
    }
}

}  // namespace
}  // namespace isoatlas

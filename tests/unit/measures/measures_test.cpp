// Measures of random volumes: the topology and voxels of cut(), the same bytes for any threads, from a store, and of single objects.
#include "isoatlas/measures.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>

#include "isoatlas/sink.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::ObjectMeasures;

/// Every number, as its bits.
std::string bits_of(const ObjectMeasures& object) {
    std::string bits;
    const auto put = [&](const auto& value) { bits.append(reinterpret_cast<const char*>(&value), sizeof value); };
    put(object.id), put(object.tau), put(object.voxels), put(object.voxel_volume), put(object.volume), put(object.area);
    put(object.equivalent_diameter), put(object.sphericity), put(object.values.mean), put(object.values.min), put(object.values.max);
    put(object.values.sum), put(object.values.deviation), put(object.centroid), put(object.axes.direction), put(object.axes.length);
    put(object.box.centre), put(object.box.size), put(object.feret.max), put(object.feret.min), put(object.feret.mean);
    put(object.feret.max_direction), put(object.feret.min_direction), put(object.euler), put(object.tunnels), put(object.cavities);
    put(object.touches_border), put(object.bounds), put(object.facets), put(object.thickness.min), put(object.thickness.median);
    return bits;
}

std::vector<std::string> bits_of(const std::vector<ObjectMeasures>& objects) {
    std::vector<std::string> bits;
    for (const ObjectMeasures& object : objects) bits.push_back(bits_of(object));
    return bits;
}

void objects_are_those_of_the_cut() {
    const Grid grid = *arbitrary_grid(7, 100);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    const double tau = arbitrary_tau(elements_of(grid, interpolant));
    const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.interpolant = interpolant});
    const std::vector<ObjectMeasures> objects = measure_objects(volume, tau, {.interpolant = interpolant}, arbitrary_context());
    RC_ASSERT(objects.size() == cut.objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const ObjectMeasures& object = objects[i];
        const isoatlas::CutObject& expected = cut.objects[i];
        RC_ASSERT(object.id == expected.id);
        RC_ASSERT(object.voxels == expected.voxels);
        RC_ASSERT(std::abs(object.voxel_volume - expected.measure) <= 1e-9 * expected.measure);
        RC_ASSERT(object.tunnels == expected.b1);
        RC_ASSERT(object.cavities == expected.b2);
        RC_ASSERT(object.euler == expected.chi);
        RC_ASSERT(object.volume > 0);
        RC_ASSERT(object.feret.max >= object.equivalent_diameter * (1 - 1e-9));
        RC_ASSERT(object.sphericity <= 1 + 1e-9);
        RC_ASSERT(object.values.min >= tau);
        RC_ASSERT(object.values.mean >= object.values.min);
        RC_ASSERT(object.values.max >= object.values.mean);
    }
}

RC_GTEST_PROP(Measures, ObjectsAreThoseOfTheCut, ()) { objects_are_those_of_the_cut(); }

RC_GTEST_PROP(Measures, OneObjectIsThatAmongAll, ()) {
    const Grid grid = *arbitrary_grid(7, 100);
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const double tau = arbitrary_tau(elements_of(grid, isoatlas::Interpolant::trilinear));
    const std::vector<ObjectMeasures> all = measure_objects(volume, tau);
    if (all.empty()) return;
    const std::size_t one = *rc::gen::inRange<std::size_t>(0, all.size());
    const std::vector<ObjectMeasures> alone = measure_objects(volume, tau, {.objects = {all[one].id}}, arbitrary_context());
    RC_ASSERT(alone.size() == 1U);
    RC_ASSERT(alone[0].id == all[one].id);
    RC_ASSERT(alone[0].values.sum == all[one].values.sum);
    RC_ASSERT(std::abs(alone[0].volume - all[one].volume) <= 1e-12 * all[one].volume);
    RC_ASSERT(alone[0].tunnels == all[one].tunnels);
}

RC_GTEST_FIXTURE_PROP(Stores, MeasuresAreThoseOfTheVolume, ()) {
    if (*rc::gen::inRange(0, 8) != 0) return;  // building a store takes long
    const Grid grid = arbitrary_volume();
    isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Atlas atlas(path_);
    isoatlas::Context one;
    one.threads = 1;
    const auto [low, high] = atlas.range();
    const double tau = low + (high - low) * *rc::gen::inRange(0, 11) / 10;
    const std::vector<ObjectMeasures> objects = measure_objects(volume, tau, {}, one);
    RC_ASSERT(bits_of(measure_objects(volume, tau, {}, arbitrary_context())) == bits_of(objects));
    if (volume.info.extent.rank == 3) {
        const std::vector<ObjectMeasures> thick = measure_objects(volume, tau, {.thickness = true}, one);
        RC_ASSERT(bits_of(measure_objects(volume, tau, {.thickness = true}, arbitrary_context())) == bits_of(thick));
        RC_ASSERT(bits_of(measure_objects(atlas, tau, {.thickness = true}, arbitrary_context())) == bits_of(thick));
        for (const ObjectMeasures& object : thick) RC_ASSERT(!(object.thickness.min > object.thickness.median));
    }
    RC_ASSERT(bits_of(measure_objects(atlas, tau, {}, arbitrary_context())) == bits_of(objects));
    const std::vector<double> taus{low - 1, low, low + (high - low) / 3, high, high + 1};
    RC_ASSERT(samples_below(atlas, taus) == samples_below(volume, taus));
    if (objects.empty()) return;
    const ObjectMeasures& some = objects[*rc::gen::inRange<std::size_t>(0, objects.size())];
    isoatlas::QueryCost cost;
    const std::vector<ObjectMeasures> alone = measure_objects(atlas, tau, {.objects = {some.id}}, {}, &cost);
    RC_ASSERT(alone.size() == 1U);
    RC_ASSERT(alone[0].values.sum == some.values.sum);
    RC_ASSERT(std::abs(alone[0].volume - some.volume) <= 1e-12 * some.volume);
}

TEST(Measures, LowVoxelsAreNoObjects) {
    const isoatlas::Volume volume = to_volume({3, {2, 2, 2}, {0, 0, 0, 0, 0, 0, 0, 1}});
    EXPECT_THROW((void)isoatlas::measure_objects(volume, 1, {.objects = {0}}), isoatlas::Error);
    EXPECT_TRUE(isoatlas::measure_objects(volume, 2).empty());
}

// The surface of a plane of many points: hulls of parts, one of which is flat.
TEST(Measures, LargeSurfacesGoInParts) {
    isoatlas::Volume volume = isoatlas::make_volume({3, {250, 250, 3}}, isoatlas::ValueType::u8);
    for (std::uint8_t& sample : volume.samples<std::uint8_t>()) sample = 1;
    const ObjectMeasures slab = isoatlas::measure_objects(volume, 0.5).at(0);
    EXPECT_TRUE(slab.touches_border);
    EXPECT_EQ(slab.voxels, 250 * 250 * 3);
    EXPECT_GT(slab.feret.max, std::hypot(249, 249));
    EXPECT_LT(slab.feret.max, std::hypot(251, 251, 5));
    EXPECT_GT(slab.feret.min, 1.9);
    EXPECT_LT(slab.feret.min, 4.1);
}

TEST(Measures, AsATable) {
    isoatlas::Volume volume = to_volume({3, {3, 3, 3}, std::vector<double>(27, 0)});
    volume.samples<double>()[13] = 1;
    volume.info.geometry.unit = "mm";
    volume.info.value_unit = "a \"unit\"\nof two lines";
    isoatlas::MemorySink sink("table.csv");
    write_measures(sink, volume.info, isoatlas::measure_objects(volume, 0.5));
    const std::string text = sink.bytes();
    EXPECT_TRUE(text.starts_with("line,id,tau,voxels,voxel_volume,volume,"));
    EXPECT_NE(text.find("\n1,13,0.5,1,1,0.1666"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with(",\"mm\",\"a \"\"unit\"\" of two lines\"\n")) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
    isoatlas::MemorySink wrong("table.txt");
    EXPECT_THROW(write_measures(wrong, volume.info, {}), isoatlas::Error);
}

}  // namespace
}  // namespace oracle

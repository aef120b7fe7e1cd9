// Units: one name for each, and what the user says instead of the header.
#include "isoatlas/units.h"

#include <gtest/gtest.h>

namespace isoatlas {
namespace {

TEST(Units, HaveOneName) {
    for (const char* micro : {"um", "\u00b5m", "\u03bcm", "micron", "Microns", " micrometer ", "micrometres", "UM"})
        EXPECT_EQ(unit_name(micro), "\u00b5m") << micro;
    for (const char* milli : {"mm", "MM", "millimeter", "Millimetres"}) EXPECT_EQ(unit_name(milli), "mm") << milli;
    for (const char* none : {"", " ", "pixel", "voxels", "none"}) EXPECT_EQ(unit_name(none), "") << none;
    for (const char* other : {"furlong", "degrees", "kpc", "mm2"}) EXPECT_EQ(unit_name(other), other);
    EXPECT_EQ(unit_name("angstrom"), unit_name("\u212b"));
    EXPECT_EQ(ascii_unit("\u00b5m"), "um");
    EXPECT_EQ(ascii_unit("\u00c5"), "angstrom");
    EXPECT_EQ(ascii_unit("mm"), "mm");
    for (const char* name : {"um", "mm", "angstrom", "pixel", "furlong"}) {
        EXPECT_EQ(unit_name(unit_name(name)), unit_name(name));
        EXPECT_EQ(unit_name(ascii_unit(name)), unit_name(name));
    }
}

TEST(Units, OfMeasuresAreNamedWithoutAUnitToo) {
    Geometry geometry;
    EXPECT_EQ(measure_unit_name(geometry, 3), "voxels");
    EXPECT_EQ(length_unit_name(geometry), "voxels");
    geometry.spacing[2] = 2;
    EXPECT_EQ(measure_unit_name(geometry, 3), "units\u00b3");
    EXPECT_EQ(measure_unit_name(geometry, 2), "units\u00b2");
    EXPECT_EQ(length_unit_name(geometry), "units");
    geometry.unit = "\u00b5m";
    EXPECT_EQ(measure_unit_name(geometry, 3), "\u00b5m\u00b3");
    EXPECT_EQ(length_unit_name(geometry), "\u00b5m");
    geometry = {};
    geometry.coordinates[0] = {0, 1, 4};
    EXPECT_EQ(measure_unit_name(geometry, 3), "units\u00b3");
}

VolumeInfo info_of(const Geometry& geometry) {
    VolumeInfo info;
    info.extent = {.rank = 3, .size = {3, 2, 2}};
    info.geometry = geometry;
    return info;
}

TEST(Corrections, ReplaceWhatTheHeaderSaysAndSaySo) {
    VolumeInfo info = info_of({.spacing = {1, 1, 3}, .origin = {5, 6, 7}, .space = "LPS", .unit = "mm"});
    correct(info, {.spacing = Vec3{0.5, 0.5, 3}, .unit = "micron", .value_unit = "HU"});
    EXPECT_EQ(info.geometry, (Geometry{.spacing = {0.5, 0.5, 3}, .origin = {5, 6, 7}, .space = "LPS", .unit = "\u00b5m"}));
    EXPECT_EQ(info.value_unit, "HU");
    EXPECT_EQ(info.notes,
              (std::vector<std::string>{"spacing 0.5 x 0.5 x 3 as given, instead of 1 x 1 x 3",
                                        "unit of length \u00b5m as given, instead of mm", "unit of values HU as given, instead of none"}));
    const VolumeInfo before = info;
    correct(info, {.spacing = Vec3{0.5, 0.5, 3}, .origin = Vec3{5, 6, 7}, .unit = "um", .value_unit = "HU"});
    EXPECT_EQ(info.notes, before.notes);
    correct(info, {.spacing = Vec3{0.5, -0.5, 3}});
    EXPECT_EQ(info.geometry.spacing, before.geometry.spacing);
    EXPECT_EQ(handedness(info.geometry), -1);
}

TEST(Corrections, OfUnevenStepsKeepTheFirstSampleWhereItIs) {
    Geometry uneven;
    uneven.coordinates = {{{1, 2, 10}, {0, 4}, {5, 6}}};
    uneven.origin = {100, 0, 0};
    VolumeInfo info = info_of(uneven);
    correct(info, {.origin = Vec3{0, 0, 1}});
    EXPECT_EQ(to_physical(info.geometry, {0, 0, 0}), (Vec3{0, 0, 1}));
    EXPECT_EQ(to_physical(info.geometry, {2, 0, 0}), (Vec3{9, 0, 1}));
    info = info_of(uneven);
    correct(info, {.spacing = Vec3{2, 2, 2}});
    EXPECT_EQ(info.geometry, (Geometry{.spacing = {2, 2, 2}, .origin = {101, 0, 5}, .unit = ""}));
    EXPECT_EQ(info.notes, std::vector<std::string>{"spacing 2 x 2 x 2 as given, instead of uneven steps"});
    for (const double wrong : {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(correct(info, {.spacing = Vec3{1, wrong, 1}}), Error);
}

}  // namespace
}  // namespace isoatlas

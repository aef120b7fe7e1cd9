// Legacy VTK files: what a writer may put before the samples, damage, refusals. tests/python/test_vtk_legacy.py has VTK's own files.
#include <gtest/gtest.h>

#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

std::string file_of(const std::string& encoding, const std::string& body, const std::string& grid = "STRUCTURED_POINTS") {
    return "# vtk DataFile Version 3.0\ntitle\n" + encoding + "\nDATASET " + grid + "\n" + body;
}
const std::string kGrid = "DIMENSIONS 2 3 4\nORIGIN 1 2 3\nSPACING 1 2 0.5\n";

std::string numbers(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += std::to_string(i) + (i % 5 == 4 ? "\n" : " ");
    return text + "\n";
}

std::string text_file(const std::string& before = "") {
    return file_of("ASCII", kGrid + "POINT_DATA 24\n" + before + "SCALARS s short\nLOOKUP_TABLE default\n" + numbers(24));
}
std::string binary_file(const std::string& samples) {
    return file_of("BINARY", kGrid + "POINT_DATA 24\nSCALARS s short 1\nLOOKUP_TABLE default\n" + samples + "\n");
}

TEST(VtkLegacy, TextAndBinaryAreTheSame) {
    const test::TestFolder folder;
    std::string little;
    for (int i = 0; i < 24; ++i) little += {static_cast<char>(i), '\0'};
    const Volume text = load_volume(folder.write("v.vtk", text_file()));
    const Volume binary = load_volume(folder.write("v.bin", binary_file(test::swapped(little, 2))));  // by content, not by name
    EXPECT_EQ(test::text_of_bytes(text), little);
    EXPECT_EQ(test::text_of_bytes(binary), little);
    EXPECT_EQ(text.info.extent, (Extent{3, {2, 3, 4}}));
    EXPECT_EQ(text.info.geometry, binary.info.geometry);
    EXPECT_EQ(text.info.geometry.spacing, (Vec3{1, 2, 0.5}));
    EXPECT_EQ(text.info.description, "title");
    test::expect_slabs_equal_whole(folder / "v.vtk");
    test::expect_slabs_equal_whole(folder / "v.bin");
}

TEST(VtkLegacy, WhatStandsBeforeTheSamplesIsSkipped) {
    const test::TestFolder folder;
    for (const std::string& before : {std::string("VECTORS v float\n") + numbers(72),
                                      "FIELD f 2\na 2 24 double\n" + numbers(48) + "METADATA\nINFORMATION 0\n\nb 3 1 int\n1 2 3\n",
                                      std::string("LOOKUP_TABLE t 2\n0 0 0 1 1 1 1 1\n"), "TEXTURE_COORDINATES t 2 float\n" + numbers(48),
                                      "COLOR_SCALARS c 3\n" + numbers(72)}) {
        SCOPED_TRACE(before.substr(0, 12));
        const Volume volume = load_volume(folder.write("v.vtk", text_file(before)));
        EXPECT_EQ(volume.info.type, ValueType::i16);
        EXPECT_EQ(volume.value(23), 23);
    }
}

TEST(VtkLegacy, CellsGiveWayToPoints) {
    const test::TestFolder folder;
    const std::string cells = "CELL_DATA 6\nSCALARS c float\nLOOKUP_TABLE default\n" + numbers(6);
    const std::string points = "POINT_DATA 24\nSCALARS p float\n" + numbers(24);  // no LOOKUP_TABLE
    EXPECT_EQ(load_volume(folder.write("v.vtk", file_of("ASCII", kGrid + cells + points))).info.extent, (Extent{3, {2, 3, 4}}));
    const Volume volume = load_volume(folder.write("v.vtk", file_of("ASCII", kGrid + cells)));
    EXPECT_EQ(volume.info.extent, (Extent{3, {1, 2, 3}}));
    EXPECT_EQ(volume.info.geometry.origin, (Vec3{1.5, 3, 3.25}));
}

TEST(VtkLegacy, Refusals) {
    const test::TestFolder folder;
    const auto refused = [&](const std::string& body, ErrorKind kind, const std::string& says,
                             const std::string& grid = "STRUCTURED_POINTS") {
        expect_helpful(failure_of_loading(folder.write("v.vtk", file_of("ASCII", body, grid))), kind, says);
    };
    refused(kGrid, ErrorKind::unsupported, "no array");
    refused(kGrid + "POINT_DATA 24\nVECTORS 'v' float\n" + numbers(72), ErrorKind::unsupported, "it has");
    std::string many;
    for (int i = 0; i < 21; ++i) many += "VECTORS v" + std::to_string(i) + " float\n" + numbers(72);
    refused(kGrid + "POINT_DATA 24\n" + many, ErrorKind::unsupported, "'v19', ...");
    refused(kGrid + "POINT_DATA 24\nSCALARS s vtkIdType\n" + numbers(24), ErrorKind::unsupported, "no array");
    refused(kGrid + "POINT_DATA 25\n", ErrorKind::input, "25 values on a grid with 24");
    refused("POINT_DATA 24\nSCALARS s int\n" + numbers(24), ErrorKind::input, "no dimensions");
    refused(kGrid + "POINT_DATA 24\nSCALARS s float 9\n", ErrorKind::input, "1 to 4");
    refused(kGrid + "POINT_DATA 24\nSCALARS s float\n" + numbers(23), ErrorKind::input, "ends inside");
    refused(kGrid + "POINT_DATA 24\nSCALARS s string\n", ErrorKind::input, "type of numbers");
    refused(kGrid + "NONSENSE\n", ErrorKind::input, "unknown keyword");
    refused("DIMENSIONS 0 1 1\n", ErrorKind::input, "a dimension");
    refused("DIMENSIONS 1099511627776 1099511627776 1099511627776\nPOINT_DATA 1\n", ErrorKind::input, "63 bits");
    refused("DIMENSIONS 2 1 1\nX_COORDINATES 3 float\n0 1 2\n", ErrorKind::unsupported, "no array", "RECTILINEAR_GRID");
    const std::string y_and_z = "Y_COORDINATES 1 float\n0\nZ_COORDINATES 1 float\n0\nPOINT_DATA 2\nSCALARS s int\n1 2\n";
    refused("DIMENSIONS 2 1 1\nX_COORDINATES 3 float\n0 1 2\n" + y_and_z, ErrorKind::input, "3 coordinates", "RECTILINEAR_GRID");
    refused("DIMENSIONS 2 1 1\nX_COORDINATES 2 float\n1 0\n" + y_and_z, ErrorKind::unsupported, "ascend", "RECTILINEAR_GRID");
    refused("DIMENSIONS 2 1 1\n" + y_and_z, ErrorKind::input, "0 coordinates", "RECTILINEAR_GRID");
    refused("", ErrorKind::unsupported, "polydata", "POLYDATA");
}

TEST(VtkLegacy, Damage) {
    const std::string text = text_file("COLOR_SCALARS c 3\n" + numbers(72)), binary = binary_file(test::telling_bytes(48));
    test::expect_truncations_refused("v.vtk", text, text.size() - 1);  // a separator is behind the last number
    test::expect_truncations_refused("v.vtk", binary, binary.size() - 1);
    test::expect_bit_flips_harmless("v.vtk", text, 0, std::string::npos, 8);
    test::expect_bit_flips_harmless("v.vtk", binary, 0, std::string::npos, 8);
}

}  // namespace
}  // namespace isoatlas

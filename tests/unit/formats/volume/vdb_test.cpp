// OpenVDB: what is written comes back in the box of its active voxels; a file that is cut off is refused; a build without it says so.
#include <gtest/gtest.h>

#include "isoatlas/output.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

/// 9 x 10 x 70 samples, zero but in the box from (1, 2, 3) to (7, 8, 67).
Volume framed(ValueType type) {
    Geometry geometry;
    geometry.spacing = {2, 3, 0.5}, geometry.origin = {10, 20, 30}, geometry.unit = "mm";
    geometry.direction = {{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}};
    Volume volume = make_volume({3, {9, 10, 70}}, type, geometry);
    visit_type(type, [&]<class T>(T) {
        for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) {
            const Index3 v = volume.info.extent.voxel(i);
            const bool inside = v[0] >= 1 && v[0] <= 7 && v[1] >= 2 && v[1] <= 8 && v[2] >= 3 && v[2] <= 67;
            volume.samples<T>()[static_cast<std::size_t>(i)] = static_cast<T>(inside ? 1 + i % 100 : 0);
        }
    });
    return volume;
}

/// Whether the build has OpenVDB; else what it says is checked.
bool has_openvdb(const test::TestFolder& folder) {
    const test::Failure failure = test::failure_of([&] { write_volume(folder / "v.vdb", framed(ValueType::u8)); });
    if (failure.message.empty()) return true;
    expect_reason(failure, ErrorKind::unsupported, Reason::built_without_format, "OpenVDB");
    const std::string magic("\x20\x42\x44\x56\0\0\0\0", 8);
    expect_reason(test::failure_of_loading(folder.write("w.vdb", magic)), ErrorKind::unsupported, Reason::built_without_format, "OpenVDB");
    return false;
}

TEST(Vdb, WhatIsWrittenComesBack) {
    const test::TestFolder folder;
    if (!has_openvdb(folder)) GTEST_SKIP() << "built without OpenVDB";
    for (const ValueType type :
         {ValueType::u8, ValueType::i16, ValueType::u16, ValueType::f32, ValueType::f64, ValueType::i32, ValueType::u32}) {
        const Volume volume = framed(type);
        write_volume(folder / "v.vdb", volume);
        const Volume back = load_volume(folder / "v.vdb");
        EXPECT_EQ(back.info.extent, (Extent{3, {7, 7, 65}}));
        EXPECT_EQ(back.info.geometry.spacing, volume.info.geometry.spacing);
        EXPECT_EQ(back.info.geometry.direction, volume.info.geometry.direction);
        EXPECT_EQ(back.info.geometry.origin, to_physical(volume.info.geometry, {1, 2, 3}));
        EXPECT_EQ(back.info.geometry.unit, "mm");
        for (std::int64_t i = 0; i < back.info.extent.voxels(); ++i)
            EXPECT_EQ(back.value(i), volume.value(volume.info.extent.index(back.info.extent.voxel(i) + Index3{1, 2, 3})));
        test::expect_slabs_equal_whole(folder / "v.vdb");
    }
}

TEST(Vdb, CutOffFilesAreRefused) {
    const test::TestFolder folder;
    if (!has_openvdb(folder)) GTEST_SKIP() << "built without OpenVDB";
    std::ifstream file(folder / "v.vdb", std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(file)), {});
    for (std::size_t size = 8; size < content.size(); size += 101)
        test::expect_user_error(test::failure_of_loading(folder.write("w.vdb", content.substr(0, size))), "cut at " + std::to_string(size));
}

TEST(Vdb, NamesOfGrids) {
    const test::TestFolder folder;
    if (!has_openvdb(folder)) GTEST_SKIP() << "built without OpenVDB";
    EXPECT_EQ(load_volume(folder / "v.vdb:/density").info.extent, (Extent{3, {7, 7, 65}}));
    expect_reason(test::failure_of_loading(folder / "v.vdb:/other"), ErrorKind::usage, Reason::no_such_dataset);
    Volume empty = make_volume({3, {4, 4, 4}}, ValueType::u8, {});
    write_volume(folder / "e.vdb", empty);
    test::expect_helpful(test::failure_of_loading(folder / "e.vdb"), ErrorKind::input, "no active voxels");
}

}  // namespace
}  // namespace isoatlas

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

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
std::string seed(const std::string& name) { return content_of(std::string(ISOATLAS_SOURCE_DIR) + "/tests/fuzz/corpus/openvdb/" + name); }

/// One voxel: whatever a damaged mask makes active, little is read.
OpenOptions one_voxel(const std::string& dataset) {
    OpenOptions options;
    if (!dataset.empty()) options.dataset = dataset;
    options.box = SampleBox{{0, 0, 0}, {1, 1, 1}};
    return options;
}

TEST(Vdb, CutOffFilesAreRefused) {
    const test::TestFolder folder;
    if (!has_openvdb(folder)) GTEST_SKIP() << "built without OpenVDB";
    for (const std::string& content : {content_of(folder / "v.vdb"), seed("leaf"), seed("old"), seed("two"), seed("bool")}) {
        for (std::size_t size = 8; size < content.size(); size += 101)
            test::expect_user_error(test::failure_of_loading(folder.write("w.vdb", content.substr(0, size))),
                                    "cut at " + std::to_string(size));
    }
    for (const std::string name : {"tiles", "empty"}) test::expect_truncations_refused("w.vdb", seed(name));
    for (const std::string name : {"instance", "stream", "same"})
        test::expect_truncations_refused("w.vdb", seed(name), std::string::npos, one_voxel("/density"));
}

TEST(Vdb, EveryFlippedBitIsRefusedOrRead) {
    const test::TestFolder folder;
    if (!has_openvdb(folder)) GTEST_SKIP() << "built without OpenVDB";
    constexpr std::int64_t kRatio = 8;
    test::expect_bit_flips_harmless("w.vdb", seed("instance"), 8, std::string::npos, kRatio, one_voxel("/again"));
    test::expect_bit_flips_harmless("w.vdb", seed("stream"), 8, std::string::npos, kRatio, one_voxel("/other"));
    for (const std::string name : {"leaf", "zip", "blosc", "bool", "old"}) {  // the last leaf
        const std::string content = seed(name);
        test::expect_bit_flips_harmless("w.vdb", content, content.size() - 40, content.size(), kRatio, one_voxel(""));
    }
}

/// As Python wrote them, in every form that the format has for values.
TEST(Vdb, FormsOfValues) {
    const test::TestFolder folder;
    if (!has_openvdb(folder)) GTEST_SKIP() << "built without OpenVDB";
    // The voxels of number 9 and 77 in a leaf are active; another one of the first ten has the value that is not.
    const auto samples = [&](const std::string& name) { return load_volume(folder.write(name + ".vdb", seed(name))); };
    const std::vector<std::tuple<std::string, ValueType, double, double>> files = {
        {"leaf", ValueType::f32, 1, 2}, {"zip", ValueType::f64, 10, 78}, {"blosc", ValueType::i32, 1, 2},
        {"half", ValueType::f32, 1, 2}, {"bool", ValueType::u8, 1, 1},   {"old", ValueType::f32, 5, 5}};
    for (const auto& [name, type, first, last] : files) {
        SCOPED_TRACE(name);
        const Volume volume = samples(name);
        EXPECT_EQ(volume.info.type, type);
        EXPECT_EQ(volume.info.extent, (Extent{3, {2, 1, name == "bool" ? 13 : 5}}));
        EXPECT_EQ(volume.value(0), first);
        EXPECT_EQ(volume.value(volume.info.extent.voxels() - 1), last);
    }
    const auto instance = open_volume(folder.write("i.vdb", seed("instance")), one_voxel("/again"));
    EXPECT_EQ(test::read_all(*instance, 1), std::string("\0\0\x80\x3f", 4));
    EXPECT_EQ(instance->info().geometry.origin, (Vec3{1, 2, 3}));
    expect_helpful(test::failure_of_loading(folder.write("v.vdb", seed("vectors")) + ":/v"), ErrorKind::unsupported, "vec3s");
    expect_helpful(test::failure_of_loading(folder.write("f.vdb", seed("frustum"))), ErrorKind::unsupported, "frustum");
    std::string nested = seed("frustum"), frustums;
    const std::size_t linear = nested.find(std::string("\x09\0\0\0AffineMap", 13));
    ASSERT_NE(linear, std::string::npos);
    for (int i = 0; i < 200'000; ++i) frustums += std::string("\x13\0\0\0NonlinearFrustumMap", 23) + std::string(64, '\0');
    nested.insert(linear, frustums);
    expect_helpful(test::failure_of_loading(folder.write("d.vdb", nested)), ErrorKind::input, "no transform of the name");
    std::string newer = seed("leaf");
    newer[8] = static_cast<char>(newer[8] + 1);
    expect_helpful(test::failure_of_loading(folder.write("n.vdb", newer)), ErrorKind::unsupported, "version 225");
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

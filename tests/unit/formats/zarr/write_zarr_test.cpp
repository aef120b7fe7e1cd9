// What is written as OME-Zarr comes back; folders appear whole or not at all. tests/python/test_zarr.py reads it with zarr-python.
#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>

#include "formats/zarr/folder_output.h"
#include "isoatlas/output.h"
#include "isoatlas/segmentation.h"
#include "isoatlas/sink.h"
#include "unit/formats/zarr/zarr_files.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

Volume volume_of(const Extent& extent, ValueType type, const Geometry& geometry = {}) {
    Volume volume = make_volume(extent, type, geometry);
    const std::string told = test::telling_bytes(volume.bytes.size());
    std::memcpy(volume.bytes.data(), told.data(), told.size());
    return volume;
}

std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

TEST(WriteZarr, EveryTypeComesBack) {
    const test::TestFolder folder;
    Geometry geometry;
    geometry.spacing = {0.5, 2, 3}, geometry.origin = {1, -2, 3}, geometry.unit = "\xc2\xb5m", geometry.space = "LPS";
    geometry.direction = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
    for (const ValueType type :
         {ValueType::u8, ValueType::i8, ValueType::u16, ValueType::i16, ValueType::u32, ValueType::i32, ValueType::f32, ValueType::f64}) {
        for (const Extent& extent : {Extent{3, {70, 5, 66}}, Extent{2, {9, 4, 1}}}) {
            Volume volume = volume_of(extent, type, geometry);
            volume.info.calibration = {.slope = 0.25, .intercept = -3};
            volume.info.value_unit = "HU", volume.info.description = "told";
            const std::string path = folder / (std::string(name_of(type)) + std::to_string(extent.rank) + ".ome.zarr");
            write_volume(path, volume);
            const Volume back = load_volume(path);
            EXPECT_EQ(back.info.extent, extent);
            EXPECT_EQ(back.info.type, type);
            Geometry kept = volume.info.geometry;
            if (extent.rank == 2) kept.spacing[2] = 1, kept.origin[2] = 0;  // an image has no axis z
            EXPECT_EQ(back.info.geometry, kept);
            EXPECT_EQ(back.info.calibration, volume.info.calibration);
            EXPECT_EQ(back.info.value_unit, "HU");
            EXPECT_EQ(back.info.description, "told");
            EXPECT_EQ(test::text_of_bytes(back), test::text_of_bytes(volume));
        }
    }
}

TEST(WriteZarr, LevelsAreMeans) {
    const test::TestFolder folder;
    Volume volume = make_volume({3, {300, 3, 2}}, ValueType::i16, {});
    const std::span<std::int16_t> samples = volume.samples<std::int16_t>();
    std::iota(samples.begin(), samples.end(), std::int16_t{-700});
    write_volume(folder / "v.zarr", volume);
    const VolumeInfo info = open_volume(folder / "v.zarr")->info();
    EXPECT_EQ(info.volumes.levels, (std::vector<Index3>{{300, 3, 2}, {150, 2, 1}, {75, 1, 1}}));
    OpenOptions second_level;
    second_level.level = 1;
    const Volume half = load_volume(folder / "v.zarr", second_level);
    EXPECT_EQ(half.info.geometry.spacing, (Vec3{2, 2, 2}));
    EXPECT_EQ(half.info.geometry.origin, (Vec3{0.5, 0.5, 0.5}));
    for (std::int64_t x = 0; x < 150; ++x) {
        double sum = 0;
        for (const std::int64_t dx : {0, 1}) {
            for (const std::int64_t y : {0, 1}) {
                for (const std::int64_t z : {0, 1}) sum += volume.value(volume.info.extent.index(2 * x + dx, y, z));
            }
        }
        EXPECT_EQ(half.value(x), std::nearbyint(sum / 8));
    }
}

TEST(WriteZarr, FoldersThatAreThereStay) {
    const test::TestFolder folder;
    const Volume volume = volume_of({3, {4, 4, 4}}, ValueType::u8);
    fs::create_directory(folder / "v.zarr");
    folder.write("v.zarr/mine", "x");
    test::expect_reason(test::failure_of([&] { write_volume(folder / "v.zarr", volume); }), ErrorKind::resource, Reason::output_is_folder);
    EXPECT_EQ(names_in(folder / ""), std::vector<std::string>{"v.zarr"});
    EXPECT_EQ(names_in(folder / "v.zarr"), std::vector<std::string>{"mine"});
    {
        FolderOutput unfinished(folder / "w.zarr");
        unfinished.put("a/b/c", "text");
    }
    EXPECT_EQ(names_in(folder / ""), std::vector<std::string>{"v.zarr"});
    FolderOutput busy(folder / "x.zarr");
    FolderOutput other(folder / "y.zarr");  // does not take the first for abandoned
    busy.put("a", "text");
    busy.commit();
    EXPECT_EQ(names_in(folder / "x.zarr"), std::vector<std::string>{"a"});
    MemorySink sink("v.zarr");
    test::expect_helpful(test::failure_of([&] { write_volume(sink, volume); }), ErrorKind::usage, "folder");
}

TEST(WriteZarr, LabelsAloneAndInAnImage) {
    const test::TestFolder folder;
    const Volume volume = volume_of({3, {5, 4, 3}}, ValueType::f32);
    std::vector<std::uint32_t> labels(60, 0);
    for (std::size_t i = 0; i < labels.size(); i += 7) labels[i] = i < 30 ? 1 : 300;
    const std::vector<Segment> segments{{.number = 1, .name = "one", .colour = {1, 2, 3}, .isovalue = 4.5, .voxels = 5},
                                        {.number = 300, .name = "", .colour = {9, 8, 7}, .isovalue = 2, .voxels = 4}};
    const auto expect_labels = [&](const std::string& path) {
        const Volume back = load_volume(path);
        EXPECT_EQ(back.info.type, ValueType::u16);
        for (std::size_t i = 0; i < labels.size(); ++i) EXPECT_EQ(back.value(static_cast<std::int64_t>(i)), labels[i]);
    };
    EXPECT_TRUE(write_segmentation(folder / "alone.zarr", labels, segments, volume.info).empty());
    expect_labels(folder / "alone.zarr");

    const std::string image = folder / "image.zarr";
    write_volume(image, volume);
    EXPECT_TRUE(write_segmentation(image, labels, segments, volume.info).empty());
    expect_labels(image + ":/labels/objects");
    const std::vector<std::string> warnings = write_segmentation(image, labels, segments, volume.info);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("objects-2"), std::string::npos);
    expect_labels(image + ":/labels/objects-2");
    write_labels(image, volume.info, labels);
    expect_labels(image + "/labels/labels");
    EXPECT_EQ(names_in(image + "/labels"), (std::vector<std::string>{".zattrs", ".zgroup", "labels", "objects", "objects-2"}));
    EXPECT_EQ(test::text_of_bytes(load_volume(image)), test::text_of_bytes(volume));  // the image is what the path opens

    const Volume other = volume_of({3, {4, 5, 3}}, ValueType::u8);
    test::expect_helpful(test::failure_of([&] { write_labels(image, other.info, labels); }), ErrorKind::usage, "other sizes");
    fs::create_directory(folder / "own.zarr");
    test::expect_helpful(test::failure_of([&] { write_labels(folder / "own.zarr", volume.info, labels); }), ErrorKind::usage,
                         "no OME-Zarr");
}

}  // namespace
}  // namespace isoatlas

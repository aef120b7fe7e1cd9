// Images of OME-Zarr: axes in any order, scales, units, channels, time, levels, labels, plates.
#include <gtest/gtest.h>

#include <filesystem>

#include "unit/formats/zarr/zarr_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;
using test::Keys;
using test::Layout;
using test::Sizes;

constexpr const char* kGroup = R"({"zarr_format":2})";
constexpr const char* kFiveAxes =
    R"([{"name":"t","type":"time","unit":"millisecond"},{"name":"c","type":"channel"},{"name":"z","type":"space","unit":"micrometer"},)"
    R"({"name":"y","type":"space","unit":"micrometer"},{"name":"x","type":"space","unit":"micrometer"}])";

std::string scale(const std::string& numbers) { return R"({"type":"scale","scale":)" + numbers + "}"; }
std::string translation(const std::string& numbers) { return R"({"type":"translation","translation":)" + numbers + "}"; }
std::string dataset(const std::string& path, const std::string& transformations) {
    return R"({"path":")" + path + R"(","coordinateTransformations":[)" + transformations + "]}";
}
std::string multiscales(const std::string& axes, const std::string& datasets, const std::string& more = "") {
    return R"("multiscales":[{"version":"0.4","name":"cells","axes":)" + axes + R"(,"datasets":[)" + datasets + "]" + more + "}]";
}

void add(Keys& keys, const Keys& more) { keys.insert(more.begin(), more.end()); }

/// t, c, z, y, x with two levels and labels; version 0.4 or 0.5.
Keys image(int version) {
    const Layout fine{.version = version, .shape = {2, 3, 4, 5, 6}, .chunk = {1, 2, 2, 3, 4}},
        coarse{.version = version, .shape = {2, 3, 4, 3, 3}, .chunk = {1, 1, 4, 3, 3}},
        labels{.version = version, .shape = {2, 1, 4, 5, 6}, .chunk = {1, 1, 4, 5, 6}, .type = "u1"};
    const std::string ome = multiscales(kFiveAxes,
                                        dataset("0", scale("[1,1,2,0.5,0.25]") + "," + translation("[0,0,10,20,30]")) + "," +
                                            dataset("1", scale("[1,1,2,1,0.5]")),
                                        R"(,"coordinateTransformations":[)" + scale("[100,1,2,2,2]") + "]") +
                            R"(,"omero":{"channels":[{"label":"DAPI"},{"label":"GFP"},{}]})";
    const std::string of_labels = multiscales(kFiveAxes, dataset("0", scale("[1,1,2,0.5,0.25]"))) + R"(,"image-label":{})";
    Keys keys;
    const auto group = [&](const std::string& path, const std::string& attributes) {
        if (version == 2) keys[path + ".zgroup"] = kGroup, keys[path + ".zattrs"] = "{" + attributes + "}";
        if (version == 3) keys[path + "zarr.json"] = R"({"zarr_format":3,"node_type":"group","attributes":{"ome":{)" + attributes + "}}}";
    };
    group("", ome), group("labels/", R"("labels":["nuclei"])"), group("labels/nuclei/", of_labels);
    add(keys, test::array_keys(fine, "0/")), add(keys, test::array_keys(coarse, "1/")),
        add(keys, test::array_keys(labels, "labels/nuclei/0/"));
    return keys;
}

TEST(OmeZarr, AxesScalesUnitsChannelsAndTimes) {
    const test::TestFolder folder;
    for (const int version : {2, 3}) {
        for (const bool zipped : {false, true}) {
            const std::string name = std::to_string(version);
            const std::string path =
                zipped ? folder.write(name + ".ozx", test::zip_of(image(version))) : test::folder_of(folder, name, image(version));
            OpenOptions options;
            test::expect_reason(failure_of_loading(path, options), ErrorKind::usage, Reason::time_step_needed, "1");
            options.time_step = 1;
            test::expect_reason(failure_of_loading(path, options), ErrorKind::usage, Reason::channel_needed);
            options.channel = "gfp";
            const Volume volume = load_volume(path, options);
            EXPECT_EQ(test::text_of_bytes(volume), test::expected_samples({.shape = {2, 3, 4, 5, 6}}, {1, 1}));
            const VolumeInfo& info = volume.info;
            EXPECT_EQ(info.format, "OME-Zarr");
            EXPECT_EQ(info.description, "cells");
            EXPECT_EQ(info.geometry.spacing, (Vec3{0.5, 1, 4}));
            EXPECT_EQ(info.geometry.origin, (Vec3{60, 40, 20}));
            EXPECT_EQ(info.geometry.unit, "\xc2\xb5m");
            EXPECT_EQ(info.volumes.channels, (std::vector<std::string>{"DAPI", "GFP", ""}));
            EXPECT_EQ(info.volumes.times, (std::vector<double>{0, 100}));
            EXPECT_EQ(info.volumes.time_unit, "ms");
            EXPECT_EQ(info.volumes.levels, (std::vector<Index3>{{6, 5, 4}, {3, 3, 4}}));
            options.level = 1;
            const Volume coarse = load_volume(path, options);
            EXPECT_EQ(test::text_of_bytes(coarse), test::expected_samples({.shape = {2, 3, 4, 3, 3}}, {1, 1}));
            EXPECT_EQ(coarse.info.geometry.spacing, (Vec3{1, 2, 4}));
            options.level = 2;
            test::expect_reason(failure_of_loading(path, options), ErrorKind::usage, Reason::no_such_level, "1");
        }
    }
}

TEST(OmeZarr, DatasetsInside) {
    const test::TestFolder folder;
    for (const int version : {2, 3}) {
        const std::string path = test::folder_of(folder, std::to_string(version) + ".zarr", image(version));
        OpenOptions options;
        options.time_step = 0, options.channel = "2";
        for (const std::string& one : {path + "/1", path + ":/1"}) {
            const Volume volume = load_volume(one, options);
            EXPECT_EQ(volume.info.geometry.spacing, (Vec3{1, 2, 4})) << one;
            EXPECT_EQ(test::text_of_bytes(volume), test::expected_samples({.shape = {2, 3, 4, 3, 3}}, {0, 2}));
        }
        options.channel.reset();
        for (const std::string& one :
             {path + "/labels/nuclei", path + ":/labels/nuclei", path + ":/labels", path + "/labels", path + ":/labels/nuclei/0"}) {
            const Volume volume = load_volume(one, options);
            EXPECT_EQ(volume.info.type, ValueType::u8) << one;
            EXPECT_EQ(volume.info.geometry.spacing, (Vec3{0.25, 0.5, 2})) << one;
        }
        OpenOptions first;
        first.time_step = 0, first.channel = "0";
        const VolumeInfo info = open_volume(path, first)->info();
        EXPECT_TRUE(
            std::ranges::any_of(info.notes, [](const std::string& note) { return note.find("/labels/nuclei") != std::string::npos; }));
        expect_helpful(failure_of_loading(path + ":/labels/nucleus", options), ErrorKind::usage, "nucleus");
    }
}

TEST(OmeZarr, AxesInAnyOrder) {
    const test::TestFolder folder;
    const Layout layout{.shape = {3, 4, 5}, .chunk = {2, 2, 2}};
    const std::string axes =
        R"([{"name":"x","type":"space","unit":"meter"},{"name":"y","type":"space","unit":"millimeter"},{"name":"z","type":"space","unit":"micrometer"}])";
    Keys keys{{".zgroup", kGroup}, {".zattrs", "{" + multiscales(axes, dataset("a", scale("[1,2,-3]"))) + "}"}};
    add(keys, test::array_keys(layout, "a/"));
    const Volume volume = load_volume(test::folder_of(folder, "v", keys));
    EXPECT_EQ(volume.info.extent.size, (Index3{3, 4, 5}));
    EXPECT_EQ(volume.info.geometry.unit, "m");
    EXPECT_DOUBLE_EQ(volume.info.geometry.spacing[1], 2e-3);
    EXPECT_DOUBLE_EQ(volume.info.geometry.spacing[2], 3e-6);
    EXPECT_EQ(volume.info.geometry.direction[2][2], -1);
    for (std::int64_t z = 0; z < 5; ++z) {
        for (std::int64_t x = 0; x < 3; ++x) EXPECT_EQ(volume.value(volume.info.extent.index(x, 2, z)), test::sample_at(layout, {x, 2, z}));
    }
}

TEST(OmeZarr, OldVersionsAndNoScale) {
    const test::TestFolder folder;
    Keys keys{{".zgroup", kGroup}, {".zattrs", R"({"multiscales":[{"version":"0.1","datasets":[{"path":"0"},{"path":"1"}]}]})"}};
    add(keys, test::array_keys({.shape = {1, 1, 4, 5, 6}, .chunk = {1, 1, 4, 5, 6}}, "0/"));
    const VolumeInfo info = open_volume(test::folder_of(folder, "old", keys))->info();
    EXPECT_EQ(info.extent, (Extent{3, {6, 5, 4}}));
    EXPECT_EQ(info.geometry, Geometry{});
    EXPECT_EQ(info.volumes.levels.size(), 1U);  // the second is missing
    keys[".zattrs"] = R"({"multiscales":[{"version":"0.3","axes":["z","y","x"],"datasets":[{"path":"0"}]}]})";
    add(keys, {});
    expect_helpful(failure_of_loading(test::folder_of(folder, "wrong", keys)), ErrorKind::input, "3 axes");
}

TEST(OmeZarr, SingleSlicesAreImages) {
    const test::TestFolder folder;
    Keys keys{{".zgroup", kGroup}, {".zattrs", "{" + multiscales(R"(["z","y","x"])", R"({"path":"0"})") + "}"}};
    add(keys, test::array_keys({.shape = {1, 5, 6}, .chunk = {1, 5, 6}}, "0/"));
    EXPECT_EQ(open_volume(test::folder_of(folder, "v", keys))->info().extent, (Extent{2, {6, 5, 1}}));
}

TEST(OmeZarr, GroupsOfImages) {
    const test::TestFolder folder;
    Keys keys{{".zgroup", kGroup},
              {".zattrs", R"({"bioformats2raw.layout":3})"},
              {"OME/.zgroup", kGroup},
              {"OME/.zattrs", R"({"series":["0","1"]})"}};
    for (const char* name : {"0", "1"}) {
        keys[std::string(name) + "/.zgroup"] = kGroup;
        keys[std::string(name) + "/.zattrs"] = "{" + multiscales(R"(["z","y","x"])", dataset("0", scale("[1,2,3]"))) + "}";
        add(keys, test::array_keys({}, std::string(name) + "/0/"));
    }
    const std::string path = test::folder_of(folder, "many", keys);
    const test::Failure failure = failure_of_loading(path);
    test::expect_reason(failure, ErrorKind::usage, Reason::dataset_needed);
    EXPECT_EQ(failure.text.choices, (std::vector<ErrorChoice>{{"/0", "image"}, {"/1", "image"}}));
    EXPECT_EQ(load_volume(path + ":/1").info.geometry.spacing, (Vec3{3, 2, 1}));
    test::expect_reason(failure_of_loading(path + ":/2"), ErrorKind::usage, Reason::no_such_dataset);

    Keys plate{{".zgroup", kGroup}, {".zattrs", R"({"plate":{"wells":[{"path":"A/1"},{"path":"B/2"},{"path":"../x"},{}]}})"}};
    for (const char* well : {"A/1", "B/2"}) {
        plate[std::string(well) + "/.zgroup"] = kGroup;
        plate[std::string(well) + "/.zattrs"] = R"({"well":{"images":[{"path":"0"}]}})";
        for (const auto& [key, value] : keys) {
            if (key.starts_with("0/")) plate[std::string(well) + "/" + key] = value;
        }
    }
    const test::Failure fields = failure_of_loading(test::folder_of(folder, "plate", plate));
    EXPECT_EQ(fields.text.choices, (std::vector<ErrorChoice>{{"/A/1/0", "image"}, {"/B/2/0", "image"}}));
    EXPECT_EQ(load_volume(folder / "plate:/B/2").info.geometry.spacing, (Vec3{3, 2, 1}));

    Keys plain{{".zgroup", kGroup}, {"times/.zarray", test::array_keys({.shape = {9}, .chunk = {9}}).at(".zarray")}};
    add(plain, test::array_keys({}, "deep/values/"));
    plain["deep/.zgroup"] = kGroup;
    EXPECT_EQ(test::text_of_bytes(load_volume(test::folder_of(folder, "plain", plain))), test::expected_samples({}, {}));  // the only one
}

TEST(OmeZarr, NamedAxesOfPlainArrays) {
    const test::TestFolder folder;
    const Layout two{.shape = {2, 3, 4, 5},
                     .chunk = {2, 3, 2, 2},
                     .attributes = R"({"_ARRAY_DIMENSIONS":["c","z","y","x"],"scale_factor":0.5,"add_offset":-3,"units":"K"})"};
    OpenOptions second_channel, second_step;
    second_channel.channel = "1", second_step.time_step = 1;
    const VolumeInfo info = open_volume(test::folder_of(folder, "two", test::array_keys(two)), second_channel)->info();
    EXPECT_EQ(info.extent, (Extent{3, {5, 4, 3}}));
    EXPECT_EQ(info.calibration.slope, 0.5);
    EXPECT_EQ(info.calibration.intercept, -3);
    EXPECT_EQ(info.value_unit, "K");
    const Layout three{.version = 3, .shape = {2, 3, 4}, .chunk = {2, 3, 2}, .dimension_names = R"(["t","y","x"])"};
    EXPECT_EQ(open_volume(test::folder_of(folder, "three", test::array_keys(three)), second_step)->info().extent, (Extent{2, {4, 3, 1}}));
    const Layout other{.version = 3, .shape = {2, 3, 4}, .chunk = {2, 3, 2}, .dimension_names = R"(["lat",null,"x"])"};
    EXPECT_EQ(open_volume(test::folder_of(folder, "other", test::array_keys(other)))->info().extent, (Extent{3, {4, 3, 2}}));
}

TEST(OmeZarr, DamagedMetadata) {
    const test::TestFolder folder;
    int number = 0;
    const auto refused = [&](const std::string& attributes, ErrorKind kind, const std::string& says) {
        Keys keys{{".zgroup", kGroup}, {".zattrs", "{" + attributes + "}"}};
        add(keys, test::array_keys({}, "0/"));
        expect_helpful(failure_of_loading(test::folder_of(folder, std::to_string(number++), keys)), kind, says);
    };
    const std::string zyx = R"(["z","y","x"])";
    refused(R"("multiscales":[])", ErrorKind::input, "");
    refused(R"("multiscales":7)", ErrorKind::input, "");
    refused(multiscales(zyx, ""), ErrorKind::input, "");
    refused(multiscales(zyx, R"({"path":"5"})"), ErrorKind::input, "missing");
    refused(multiscales(zyx, dataset("0", scale("[1,2]"))), ErrorKind::input, "scale");
    refused(multiscales(zyx, dataset("0", scale(R"([1,2,"3"])"))), ErrorKind::input, "scale");
    refused(multiscales(zyx, dataset("0", R"({"type":"affine"})")), ErrorKind::unsupported, "affine");
    refused(multiscales(zyx, dataset("0", R"({"type":"scale","path":"s"})")), ErrorKind::unsupported, "array");
    refused(multiscales(R"(["t","c","x"])", dataset("0", "")), ErrorKind::unsupported, "axes of space");
    refused(multiscales(R"(["c","d","x"])", dataset("0", "")), ErrorKind::unsupported, "alike");
}

}  // namespace
}  // namespace isoatlas

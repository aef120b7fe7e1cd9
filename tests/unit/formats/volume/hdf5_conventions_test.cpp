// Conventions of HDF5 files: which samples, where they lie, what they are called.
#include <gtest/gtest.h>

#include "unit/formats/volume/hdf5_files.h"
#include "unit/formats/volume/hostile_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;
using test::Hdf5Maker;

OpenOptions choosing(const std::string& path) {
    OpenOptions options;
    options.dataset = path;
    return options;
}

std::string all_samples(const std::string& path, const OpenOptions& options = {}) {
    const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
    return test::read_all(*reader, reader->info().extent.size[2]);
}

TEST(Hdf5Conventions, ImarisLevelsChannelsAndPadding) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.ims");
        for (const int level : {0, 1}) {
            const hsize_t n = level == 0 ? 4 : 2;
            for (const int channel : {0, 1}) {
                const std::string group =
                    "/DataSet/ResolutionLevel " + std::to_string(level) + "/TimePoint 0/Channel " + std::to_string(channel);
                maker.bytes(group + "/Data", {n, n, n},
                            std::string(static_cast<std::size_t>(n * n * n), static_cast<char>('a' + 2 * level + channel)));
                for (const char axis : {'X', 'Y', 'Z'})
                    maker.set_characters(group, std::string("ImageSize") + axis, level == 0 ? "3" : "2");
            }
        }
        maker.group("/DataSetInfo/Image"), maker.group("/DataSetInfo/Channel 0"), maker.group("/DataSetInfo/Channel 1");
        for (const char axis : {'0', '1', '2'}) {
            maker.set_characters("/DataSetInfo/Image", std::string("ExtMin") + axis, "10");
            maker.set_characters("/DataSetInfo/Image", std::string("ExtMax") + axis, "16");
        }
        maker.set_characters("/DataSetInfo/Image", "Unit", "um");
        maker.set_characters("/DataSetInfo/Channel 0", "Name", "DAPI");
        maker.set_characters("/DataSetInfo/Channel 1", "Name", "GFP");
    }
    EXPECT_EQ(failure_of_loading(folder / "v.ims").text.reason, Reason::channel_needed);
    OpenOptions options;
    options.channel = "gfp";
    const auto reader = open_volume(folder / "v.ims", options);
    EXPECT_EQ(reader->info().extent, (Extent{3, {3, 3, 3}}));
    EXPECT_EQ(reader->info().geometry.spacing, (Vec3{2, 2, 2}));
    EXPECT_EQ(reader->info().geometry.origin, (Vec3{11, 11, 11}));
    EXPECT_EQ(reader->info().geometry.unit, "\xc2\xb5m");
    EXPECT_EQ(reader->info().volumes.channels, (std::vector<std::string>{"DAPI", "GFP"}));
    EXPECT_EQ(reader->info().volumes.levels, (std::vector<Index3>{{3, 3, 3}, {2, 2, 2}}));
    EXPECT_EQ(test::read_all(*reader, 3), std::string(27, 'b'));
    options.level = 1;
    EXPECT_EQ(all_samples(folder / "v.ims", options), std::string(8, 'd'));
    EXPECT_EQ(open_volume(folder / "v.ims", options)->info().geometry.spacing, (Vec3{3, 3, 3}));
}

TEST(Hdf5Conventions, NexusAxes) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.nxs");
        maker.bytes("/entry/data/counts", {3, 2}, "abcdef");
        maker.bytes("/entry/other", {2, 2}, "1234");
        maker.doubles("/entry/data/up", {5, 4, 3});
        maker.doubles("/entry/data/across", {0.5, 2.5});
        maker.set("/entry/data/up", "units", "cm"), maker.set("/entry/data/across", "units", "mm");
        maker.set("/entry/data", "signal", "counts");
        maker.set_list("/entry/data", "axes", {"up", "across"});
        maker.set("/entry/data/counts", "units", "1/s");
        maker.set("/", "default", "entry"), maker.set("/entry", "default", "data");
    }
    const auto reader = open_volume(folder / "v.nxs");
    const VolumeInfo& info = reader->info();
    EXPECT_EQ(info.format, "NeXus");
    EXPECT_EQ(info.extent, (Extent{2, {2, 3, 1}}));
    EXPECT_EQ(info.geometry.unit, "mm");
    EXPECT_EQ(info.geometry.spacing, (Vec3{2, 10, 1}));
    EXPECT_EQ(to_physical(info.geometry, {1, 2, 0}), (Vec3{2.5, 30, 0}));
    EXPECT_EQ(info.value_unit, "1/s");
    EXPECT_EQ(test::read_all(*reader, 1), "abcdef");
}

TEST(Hdf5Conventions, UnevenAxesThatDescendAreTurned) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.nxs");
        maker.bytes("/d/v", {2, 3}, "abcdef");
        maker.doubles("/d/x", {9, 3, 1});
        maker.set("/d", "signal", "v");
        maker.set_list("/d", "axes", {".", "x"});
        maker.set("/", "default", "d");
    }
    const auto reader = open_volume(folder / "v.nxs");
    EXPECT_EQ(reader->info().geometry.coordinates[0], (std::vector<double>{1, 3, 9}));
    EXPECT_EQ(reader->info().geometry.coordinates[1], (std::vector<double>{0, 1}));
    EXPECT_EQ(test::read_all(*reader, 1), "cbafed");
    std::string box(2, '?');
    reader->read_box({{1, 1, 0}, {3, 2, 1}}, std::as_writable_bytes(std::span(box)));
    EXPECT_EQ(box, "ed");
}

TEST(Hdf5Conventions, OpenPmdMeshes) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.h5");
        maker.group("/data");
        maker.set("/", "openPMD", "1.1.0"), maker.set("/", "meshesPath", "meshes/");
        for (const char* step : {"9", "100"}) {
            const std::string meshes = std::string("/data/") + step + "/meshes";
            maker.bytes(meshes + "/E/x", {2, 2, 3}, std::string("abcdefghijk") + step[0]);
            maker.bytes(meshes + "/rho", {2, 2, 3}, "ABCDEFGHIJKL");
            maker.set_numbers(meshes + "/E", "gridSpacing", {4, 2, 1}), maker.set_numbers(meshes + "/E", "gridGlobalOffset", {10, 20, 30});
            maker.set_numbers(meshes + "/E", "gridUnitSI", {0.5}), maker.set_list(meshes + "/E", "axisLabels", {"x", "y", "z"});
            maker.set_numbers(meshes + "/E/x", "position", {0.5, 0, 0}), maker.set_numbers(meshes + "/E/x", "unitSI", {8});
            maker.set_numbers(std::string("/data/") + step, "time", {std::stod(step)}),
                maker.set_numbers(std::string("/data/") + step, "timeUnitSI", {2});
        }
    }
    EXPECT_EQ(failure_of_loading(folder / "v.h5").text.reason, Reason::time_step_needed);
    OpenOptions options = choosing("E/x");
    options.time_step = 1;
    const auto reader = open_volume(folder / "v.h5", options);
    const VolumeInfo& info = reader->info();
    EXPECT_EQ(info.volumes.times, (std::vector<double>{18, 200}));
    EXPECT_EQ(test::read_all(*reader, 2), "abcdefghijk1");
    EXPECT_EQ(info.geometry.unit, "m");
    EXPECT_EQ(info.calibration.slope, 8);
    EXPECT_EQ(to_physical(info.geometry, {0, 0, 0}), (Vec3{6, 10, 15}));
    EXPECT_EQ(to_physical(info.geometry, {1, 0, 0}), (Vec3{6, 10, 15.5}));
    EXPECT_EQ(to_physical(info.geometry, {0, 0, 1}), (Vec3{8, 10, 15}));
    EXPECT_EQ(all_samples(folder / "v.h5", choosing("/data/9/meshes/E/x")), "abcdefghijk9");
    options.dataset = "rho";
    EXPECT_EQ(all_samples(folder / "v.h5", options), "ABCDEFGHIJKL");
}

TEST(Hdf5Conventions, BigDataViewerSetups) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.h5");
        const std::vector<std::int16_t> samples{1, -1, 3, 4, 5, 6, 7, 8};
        for (const char* setup : {"s00", "s01"}) {
            maker.doubles(std::string("/") + setup + "/resolutions", {1, 1, 1, 2, 2, 1}, {2, 3});
            maker.array(std::string("/t00000/") + setup + "/0/cells", {2, 2, 2}, H5T_STD_I16LE, H5T_NATIVE_INT16, samples.data());
            maker.array(std::string("/t00000/") + setup + "/1/cells", {2, 1, 1}, H5T_STD_I16LE, H5T_NATIVE_INT16, samples.data());
        }
    }
    folder.write("v.xml",
                 "<SpimData><SequenceDescription><ViewSetups><ViewSetup><id>1</id><name>red</name><voxelSize><unit>micrometer</unit>"
                 "<size>0.5 0.5 2</size></voxelSize></ViewSetup></ViewSetups></SequenceDescription></SpimData>");
    OpenOptions options;
    options.channel = "red";
    const auto reader = open_volume(folder / "v.h5", options);
    EXPECT_EQ(reader->info().type, ValueType::u16);
    EXPECT_EQ(reader->info().geometry.spacing, (Vec3{0.5, 0.5, 2}));
    EXPECT_EQ(reader->info().geometry.unit, "\xc2\xb5m");
    EXPECT_EQ(load_volume(*reader).value(1), 65535);
    options.level = 1;
    EXPECT_EQ(open_volume(folder / "v.h5", options)->info().geometry.spacing, (Vec3{1, 1, 2}));
    EXPECT_EQ(open_volume(folder / "v.h5", options)->info().geometry.origin, (Vec3{0.25, 0.25, 0}));
}

TEST(Hdf5Conventions, VtkImages) {
    const test::TestFolder folder;
    {
        const Hdf5Maker maker(folder / "v.vtkhdf");
        maker.bytes("/VTKHDF/PointData/density", {2, 2, 3}, "abcdefghijkl");
        maker.bytes("/VTKHDF/PointData/velocity", {2, 2, 3, 3}, std::string(36, 'v'));
        maker.set_numbers("/VTKHDF", "Version", {1, 0}), maker.set("/VTKHDF", "Type", "ImageData");
        maker.set_numbers("/VTKHDF", "WholeExtent", {1, 3, 0, 1, 0, 1}), maker.set_numbers("/VTKHDF", "Origin", {10, 20, 30});
        maker.set_numbers("/VTKHDF", "Spacing", {1, 2, 4}), maker.set_numbers("/VTKHDF", "Direction", {0, 1, 0, -1, 0, 0, 0, 0, 1});
    }
    const auto reader = open_volume(folder / "v.vtkhdf");
    EXPECT_EQ(reader->info().format, "VTKHDF");
    EXPECT_EQ(to_physical(reader->info().geometry, {0, 0, 0}), (Vec3{10, 19, 30}));
    EXPECT_EQ(to_physical(reader->info().geometry, {0, 1, 0}), (Vec3{12, 19, 30}));
    EXPECT_EQ(test::read_all(*reader, 2), "abcdefghijkl");
    {
        const Hdf5Maker maker(folder / "u.vtkhdf");
        maker.group("/VTKHDF");
        maker.set_numbers("/VTKHDF", "Version", {1, 0}), maker.set("/VTKHDF", "Type", "UnstructuredGrid");
    }
    expect_helpful(failure_of_loading(folder / "u.vtkhdf"), ErrorKind::unsupported, "UnstructuredGrid");
    {
        const Hdf5Maker maker(folder / "vectors.vtkhdf");
        for (int i = 10; i < 35; ++i) maker.bytes("/VTKHDF/PointData/v" + std::to_string(i), {1, 1, 2, 3}, "abcdef");
        maker.set_numbers("/VTKHDF", "Version", {1, 0}), maker.set("/VTKHDF", "Type", "ImageData");
        maker.set_numbers("/VTKHDF", "WholeExtent", {0, 1, 0, 0, 0, 0}), maker.set_numbers("/VTKHDF", "Origin", {0, 0, 0});
        maker.set_numbers("/VTKHDF", "Spacing", {1, 1, 1}), maker.set_numbers("/VTKHDF", "Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
    }
    expect_helpful(failure_of_loading(folder / "vectors.vtkhdf"), ErrorKind::unsupported, "'v28', 'v29', ...");
}

}  // namespace
}  // namespace isoatlas

// write_labels: every format reads back with the smallest type and the geometry, also with readers of other people; failures leave nothing.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cerrno>
#include <filesystem>

#include "faults/faulty_files.h"
#include "isoatlas/output.h"
#include "unit/formats/common/external.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;

const std::vector<std::string> kNames = {"l.nrrd", "l.nii", "l.nii.gz", "l.tif", "L.TIFF"};

std::vector<std::uint32_t> labels_up_to(std::int64_t count, std::uint32_t largest) {
    std::vector<std::uint32_t> labels(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = i % 3 == 0 ? 0 : static_cast<std::uint32_t>((i * 2654435761U) % largest);
    labels.back() = largest;
    return labels;
}

void expect_labels(const std::string& path, const Extent& extent, const std::vector<std::uint32_t>& labels, ValueType type) {
    const Volume volume = load_volume(path);
    ASSERT_EQ(volume.info.extent, extent) << path;
    ASSERT_EQ(volume.info.type, type) << path;
    ASSERT_TRUE(volume.info.calibration.is_identity());
    for (std::size_t i = 0; i < labels.size(); ++i) ASSERT_EQ(volume.value(static_cast<std::int64_t>(i)), labels[i]) << path << " " << i;
}

TEST(Labels, SmallestTypeInEveryFormat) {
    const TestFolder folder;
    for (const Extent& extent :
         {Extent{.rank = 3, .size = {7, 5, 3}}, Extent{.rank = 2, .size = {9, 4, 1}}, Extent{.rank = 3, .size = {400, 300, 2}}}) {
        for (const std::uint32_t largest : {1U, 255U, 256U, 65535U, 65536U, 4294967295U}) {
            const auto labels = labels_up_to(extent.voxels(), largest);
            const ValueType type = largest < 256 ? ValueType::u8 : largest < 65536 ? ValueType::u16 : ValueType::u32;
            for (const std::string& name : kNames) {
                write_labels(folder / name, info_of(extent), labels);
                expect_labels(folder / name, extent, labels, type);
            }
        }
    }
}

RC_GTEST_PROP(Labels, AnyLabelsComeBack, ()) {
    const Extent extent{.rank = 3, .size = {*rc::gen::inRange(1, 8), *rc::gen::inRange(1, 8), *rc::gen::inRange(2, 6)}};
    const auto labels =
        *rc::gen::container<std::vector<std::uint32_t>>(static_cast<std::size_t>(extent.voxels()), rc::gen::arbitrary<std::uint32_t>());
    const TestFolder folder;
    for (const std::string& name : kNames) {
        write_labels(folder / name, info_of(extent), labels);
        const Volume volume = load_volume(folder / name);
        for (std::size_t i = 0; i < labels.size(); ++i) RC_ASSERT(volume.value(static_cast<std::int64_t>(i)) == labels[i]);
    }
}

/// NIfTI-1 rounds to float32 and turns to RAS; NRRD keeps everything.
TEST(Labels, GeometryIsKept) {
    const TestFolder folder;
    const Extent extent{.rank = 3, .size = {4, 3, 2}};
    const auto labels = labels_up_to(extent.voxels(), 9);
    const double c = std::cos(0.3), s = std::sin(0.3);
    for (const char* space : {"LPS", "RAS", "LAS", "unknown"}) {
        const Geometry geometry{.spacing = {0.5, 0.75, 2.5},
                                .origin = {-10, 20, 30.25},
                                .direction = {{{c, -s, 0}, {s, c, 0}, {0, 0, -1}}},
                                .space = space,
                                .unit = "mm"};
        for (const std::string name : {"l.nrrd", "l.nii", "l.nii.gz"}) {
            write_labels(folder / name, info_of(extent, geometry), labels);
            const Geometry back = load_volume(folder / name).info.geometry;
            const bool nifti = name != "l.nrrd";
            EXPECT_EQ(back.space, nifti ? "RAS" : space);
            EXPECT_EQ(back.unit, "mm");
            const std::string from = geometry.space == "unknown" ? back.space : geometry.space;
            for (const Vec3& voxel : {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 2, 0}, Vec3{0, 0, 1}}) {
                const Vec3 there = to_physical(geometry, voxel), here = to_physical(back, voxel);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double sign = from[axis] == back.space[axis] ? 1 : -1;
                    EXPECT_NEAR(sign * there[axis], here[axis], nifti ? 1e-5 : 1e-12) << name << " " << space << " axis " << axis;
                }
            }
        }
        write_labels(folder / "l.tif", info_of(extent, geometry), labels);
        const Geometry back = load_volume(folder / "l.tif").info.geometry;
        for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(back.spacing[axis], geometry.spacing[axis], 1e-6);
        EXPECT_EQ(back.unit, "mm");
    }
    for (const std::string& name : kNames) {  // nothing is invented, but NIfTI cannot say "unknown"
        write_labels(folder / name, info_of(extent), labels);
        Geometry expected;
        if (name.find(".nii") != std::string::npos) expected.space = "RAS";
        EXPECT_EQ(load_volume(folder / name).info.geometry, expected) << name;
    }
}

TEST(Labels, RectilinearGridsGetTheirMeanSpacing) {
    const TestFolder folder;
    Geometry geometry;
    geometry.coordinates = {{{1, 2, 3, 10}, {0, 1, 4}, {5, 6}}};
    const Extent extent{.rank = 3, .size = {4, 3, 2}};
    for (const std::string name : {"l.nrrd", "l.nii"}) {
        write_labels(folder / name, info_of(extent, geometry), labels_up_to(24, 9));
        const Geometry back = load_volume(folder / name).info.geometry;
        EXPECT_EQ(back.spacing, (Vec3{3, 2, 1}));
        EXPECT_EQ(back.origin, (Vec3{1, 0, 5}));
    }
    EXPECT_NE(load_volume(folder / "l.nii").info.description.find("rectilinear"), std::string::npos);
}

TEST(Labels, UnitsOfNifti) {
    const TestFolder folder;
    const Extent extent{.rank = 3, .size = {4, 3, 2}};
    const std::pair<const char*, std::pair<const char*, double>> units[] = {{"um", {"\u00b5m", 1}},    {"\u00b5m", {"\u00b5m", 1}},
                                                                            {"nm", {"\u00b5m", 1e-3}}, {"cm", {"mm", 10}},
                                                                            {"m", {"m", 1}},           {"furlong", {"", 1}}};
    for (const auto& [unit, expected] : units) {
        write_labels(folder / "l.nii", info_of(extent, {.spacing = {2, 2, 2}, .unit = unit}), labels_up_to(24, 9));
        const Geometry back = load_volume(folder / "l.nii").info.geometry;
        EXPECT_EQ(back.unit, expected.first);
        EXPECT_NEAR(back.spacing[0], 2 * expected.second, 1e-6);
    }
}

TEST(Labels, MrcHasNoUnsignedBytesAndNoWideIntegers) {
    const TestFolder folder;
    const Extent extent{.rank = 3, .size = {400, 300, 2}};
    const std::string path = folder / "l.mrc";
    for (const std::uint32_t largest : {1U, 255U, 256U, 65535U, 65536U, 16777215U, 16777216U}) {
        const auto labels = labels_up_to(extent.voxels(), largest);
        write_labels(path, info_of(extent), labels);
        expect_labels(path, extent, labels, largest < 65536 ? ValueType::u16 : ValueType::f32);
    }
    expect_helpful(failure_of([&] { write_labels(path, info_of(extent), labels_up_to(extent.voxels(), 16777217)); }),
                   ErrorKind::unsupported, "16777217");
    EXPECT_EQ(load_volume(path).value(extent.voxels() - 1), 16777216);  // the file of before
}

TEST(Labels, WrongUse) {
    const TestFolder folder;
    const Extent extent{.rank = 3, .size = {4, 3, 2}};
    const auto kind = [&](const std::string& name, std::size_t count) {
        return failure_of([&] { write_labels(folder / name, info_of(extent), std::vector<std::uint32_t>(count)); }).kind;
    };
    EXPECT_EQ(kind("l.png", 24), ErrorKind::usage);
    EXPECT_EQ(kind("nrrd", 24), ErrorKind::usage);
    EXPECT_EQ(kind("l.nrrd", 23), ErrorKind::usage);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "."));
}

TEST(Labels, FullDiskAndMissingFolderLeaveNothing) {
    const TestFolder folder;
    const Extent extent{.rank = 3, .size = {40, 30, 20}};
    const auto labels = labels_up_to(extent.voxels(), 1000000);
    for (const std::string& name : kNames) {
        for (const std::int64_t after : {0, 5, 400, 2000, 20000}) {
            const FullDisk fault(after, ENOSPC);
            expect_helpful(failure_of([&] { write_labels(folder / name, info_of(extent), labels); }), ErrorKind::resource, "No space left");
            ASSERT_TRUE(std::filesystem::is_empty(folder / ".")) << name << " " << after;
        }
        expect_helpful(failure_of([&] { write_labels(folder / "no/such/" + name, info_of(extent), labels); }), ErrorKind::resource,
                       "No such file");
    }
}

/// nibabel and tifffile see the same numbers.
TEST(Labels, OtherReadersAgree) {
    const TestFolder folder;
    const Extent extent{.rank = 3, .size = {7, 5, 3}};
    for (const std::uint32_t largest : {200U, 60000U, 3000000000U}) {
        const auto labels = labels_up_to(extent.voxels(), largest);
        std::string list = "[";
        for (const std::uint32_t label : labels) list += std::to_string(label) + ",";
        list += "]";
        const Geometry geometry{.spacing = {0.5, 0.75, 2.5}, .origin = {1, 2, 3}, .space = "LPS", .unit = "mm"};
        for (const std::string& name : kNames) write_labels(folder / name, info_of(extent, geometry), labels);
        if (external::run("/usr/bin/python3 -c 'import nibabel'").status != 0 ||
            external::run("/usr/bin/python3 -c 'import tifffile'").status != 0) {
            GTEST_SKIP() << "python3-nibabel or python3-tifffile is not installed";
        }
        const external::Result result = external::python(
            "import nibabel, tifffile, numpy\n"
            "labels = numpy.array(" +
            list +
            ").reshape(3, 5, 7)\n"
            "for name in ['l.nii', 'l.nii.gz']:\n"
            "    image = nibabel.load('" +
            folder / "." +
            "/' + name)\n"
            "    assert (numpy.asarray(image.dataobj).transpose() == labels).all(), name\n"
            "    assert numpy.allclose(image.affine, [[-0.5,0,0,-1],[0,-0.75,0,-2],[0,0,2.5,3],[0,0,0,1]]), image.affine\n"
            "    assert image.header.get_xyzt_units()[0] == 'mm'\n"
            "with tifffile.TiffFile('" +
            folder / "l.tif" +
            "') as tiff:\n"
            "    assert (tiff.asarray() == labels).all()\n"
            "    assert tiff.imagej_metadata['spacing'] == 2.5, tiff.imagej_metadata\n"
            "    x = tiff.pages[0].tags['XResolution'].value\n"
            "    assert abs(x[1] / x[0] - 0.5) < 1e-6\n");
        EXPECT_EQ(result.status, 0) << result.text;
    }
}

}  // namespace
}  // namespace isoatlas

// write_volume: every type and format reads back bit-exactly, with what the format can hold of the geometry; failures leave nothing.
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>

#include "faults/faulty_files.h"
#include "isoatlas/output.h"
#include "unit/formats/common/external.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;

const std::vector<std::string> kNames = {"v.nrrd", "v.npy", "v.raw", "v.mha", "v.vti", "v.nii", "v.nii.gz", "v.tif"};

Volume make(const Extent& extent, ValueType type, const Geometry& geometry = {}) {
    Volume volume = make_volume(extent, type, geometry);
    const std::string bytes = telling_bytes(volume.bytes.size());
    std::memcpy(volume.bytes.data(), bytes.data(), bytes.size());
    return volume;
}

TEST(WriteVolume, EveryTypeAndFormatComesBack) {
    const TestFolder folder;
    for (int t = 0; t < 8; ++t) {
        for (const Extent& extent : {Extent{.rank = 3, .size = {7, 5, 3}}, Extent{.rank = 2, .size = {9, 4, 1}}}) {
            const Volume volume = make(extent, static_cast<ValueType>(t));
            for (const std::string& name : kNames) {
                SCOPED_TRACE(std::string(name_of(volume.info.type)) + " " + name);
                write_volume(folder / name, volume);
                const Volume back = load_volume(folder / name);
                EXPECT_EQ(back.info.extent, extent);
                EXPECT_EQ(back.info.type, volume.info.type);
                Geometry expected;
                if (name.find(".nii") != std::string::npos) expected.space = "RAS";  // NIfTI cannot say "unknown"
                EXPECT_EQ(back.info.geometry, expected);
                EXPECT_TRUE(back.info.calibration.is_identity());
                EXPECT_TRUE(back.bytes == volume.bytes);
            }
        }
    }
}

TEST(WriteVolume, GeometryAndCalibration) {
    const TestFolder folder;
    for (const char* space : {"LPS", "RAS", "unknown"}) {
        const Geometry geometry{.spacing = {0.5, 0.75, 2.5},
                                .origin = {-10, 20, 30.25},
                                .direction = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}},
                                .space = space,
                                .unit = "mm"};
        Volume volume = make({.rank = 3, .size = {4, 3, 2}}, ValueType::i16, geometry);
        volume.info.calibration = {0.5, -3};
        for (const std::string name : {"v.nrrd", "v.mha", "v.nii"}) {
            SCOPED_TRACE(name + " " + space);
            write_volume(folder / name, volume);
            const Volume back = load_volume(folder / name);
            EXPECT_EQ(back.info.geometry.spacing, geometry.spacing);
            EXPECT_EQ(back.info.geometry.unit, "mm");
            if (name != "v.mha") {
                EXPECT_EQ(back.info.calibration, volume.info.calibration);
            }
            const std::string from = geometry.space == "unknown" ? back.info.geometry.space : geometry.space, to = back.info.geometry.space;
            EXPECT_EQ(to, name == "v.nii" ? "RAS" : geometry.space == "unknown" ? "unknown" : name == "v.mha" ? "LPS" : geometry.space);
            const Vec3 there = to_physical(geometry, {3, 2, 1}), here = to_physical(back.info.geometry, {3, 2, 1});
            for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(here[axis], from[axis] == to[axis] ? there[axis] : -there[axis]) << axis;
        }
        write_volume(folder / "v.raw", volume);
        const Geometry raw = load_volume(folder / "v.raw").info.geometry;
        EXPECT_EQ(raw.spacing, geometry.spacing);
        EXPECT_EQ(raw.origin, geometry.origin);
        EXPECT_EQ(raw.space, space);
        EXPECT_EQ(raw.unit, "mm");
    }
}

TEST(WriteVolume, TextsOfAFileCannotAddHeaderLines) {
    const TestFolder folder;
    Volume volume = make({.rank = 3, .size = {4, 3, 2}}, ValueType::u8, {.unit = "mm\nsizes: 9 9 9\""});
    volume.info.description = "one\nencoding: gzip";
    volume.info.value_unit = "a\nb:=c";
    for (const std::string& name : kNames) {
        write_volume(folder / name, volume);
        EXPECT_TRUE(load_volume(folder / name).bytes == volume.bytes) << name;
    }
}

TEST(WriteVolume, RawNamesAndSidecars) {
    const TestFolder folder;
    const Volume volume = make({.rank = 3, .size = {7, 5, 3}}, ValueType::f32);
    const std::string telling = folder / "v_7x5x3_float32.raw";
    write_volume(telling, volume);
    EXPECT_FALSE(std::filesystem::exists(telling + ".json"));
    EXPECT_TRUE(load_volume(telling).bytes == volume.bytes);
    write_volume(folder / "v.raw", volume);
    EXPECT_TRUE(std::filesystem::exists(folder / "v.raw.json"));
    expect_helpful(failure_of([&] { write_volume(folder / "v_7x5x4_float32.raw", volume); }), ErrorKind::usage, "7x5x3");
    expect_helpful(failure_of([&] { write_volume(folder / "v_uint8.raw", volume); }), ErrorKind::usage, "float32");
    // A sidecar of an earlier volume of this name must not stay and contradict.
    const Volume placed = make({.rank = 3, .size = {7, 5, 3}}, ValueType::f32, {.spacing = {2, 2, 2}, .unit = {}});
    write_volume(telling, placed);
    EXPECT_EQ(load_volume(telling).info.geometry.spacing, (Vec3{2, 2, 2}));
    write_volume(telling, volume);
    EXPECT_EQ(load_volume(telling).info.geometry.spacing, (Vec3{1, 1, 1}));
}

TEST(WriteVolume, LongAxesAndOddNumbersUseNifti2) {
    const TestFolder folder;
    const Volume longer = make({.rank = 2, .size = {40000, 2, 1}}, ValueType::u8);
    write_volume(folder / "v.nii", longer);
    EXPECT_EQ(load_volume(folder / "v.nii").info.format, "NIfTI-2");
    EXPECT_TRUE(load_volume(folder / "v.nii").bytes == longer.bytes);
    const Volume tiny = make({.rank = 3, .size = {2, 2, 2}}, ValueType::u8, {.spacing = {1e-60, 1, 1}, .unit = {}});
    write_volume(folder / "v.nii", tiny);
    EXPECT_EQ(load_volume(folder / "v.nii").info.format, "NIfTI-2");
}

TEST(WriteVolume, WrongUseAndFullDisk) {
    const TestFolder folder;
    Volume volume = make({.rank = 3, .size = {40, 30, 20}}, ValueType::f64);
    expect_helpful(failure_of([&] { write_volume(folder / "v.xyz", volume); }), ErrorKind::usage, "format");
    for (const std::string& name : kNames) {
        for (const std::int64_t after : {0, 100, 5000}) {
            const FullDisk fault(after, ENOSPC);
            expect_helpful(failure_of([&] { write_volume(folder / name, volume); }), ErrorKind::resource, "No space left");
            ASSERT_TRUE(std::filesystem::is_empty(folder / ".")) << name << " " << after;
        }
    }
    volume.bytes.pop_back();
    EXPECT_EQ(failure_of([&] { write_volume(folder / "v.nrrd", volume); }).kind, ErrorKind::usage);
}

TEST(WriteVolume, OtherReadersAgree) {
    if (external::run("/usr/bin/python3 -c 'import nibabel, numpy, tifffile'").status != 0)
        GTEST_SKIP() << "python3-nibabel or python3-tifffile is not installed";
    const TestFolder folder;
    static constexpr const char* kNumpy[] = {"uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64"};
    for (int t = 0; t < 8; ++t) {
        const Volume volume = make({.rank = 3, .size = {7, 5, 3}}, static_cast<ValueType>(t));
        for (const std::string& name : kNames) write_volume(folder / name, volume);
        const external::Result result = external::python(
            "import nibabel, numpy, tifffile\n"
            "folder = '" +
            folder / "." +
            "/'\n"
            "samples = numpy.fromfile(folder + 'v.raw', dtype='" +
            kNumpy[t] +
            "').reshape(3, 5, 7)\n"
            "assert (numpy.load(folder + 'v.npy') == samples).all()\n"
            "for name in ['v.nii', 'v.nii.gz']:\n"
            "    image = nibabel.load(folder + name)\n"
            "    assert image.get_data_dtype() == samples.dtype and (numpy.asarray(image.dataobj).transpose() == samples).all(), name\n"
            "pages = tifffile.imread(folder + 'v.tif')\n"
            "assert pages.dtype == samples.dtype and (pages == samples).all()\n"
            "whole = open(folder + 'v.mha', 'rb').read()\n"
            "assert whole.endswith(b'LOCAL\\n' + samples.tobytes())\n"
            "whole = open(folder + 'v.nrrd', 'rb').read()\n"
            "assert whole.endswith(b'\\n\\n' + samples.tobytes())\n");
        EXPECT_EQ(result.status, 0) << kNumpy[t] << ": " << result.text;
    }
}

/// nibabel's own files read back: the reader against an independent writer.
TEST(WriteVolume, FilesOfOthersAreRead) {
    if (external::run("/usr/bin/python3 -c 'import nibabel, numpy, tifffile'").status != 0)
        GTEST_SKIP() << "python3-nibabel or python3-tifffile is not installed";
    const TestFolder folder;
    const external::Result result = external::python(
        "import nibabel, numpy, tifffile\n"
        "folder = '" +
        folder / "." +
        "/'\n"
        "for name in ['uint8', 'int8', 'uint16', 'int16', 'uint32', 'int32', 'float32', 'float64']:\n"
        "    samples = (numpy.arange(105) % 120).astype(name).reshape(3, 5, 7)\n"
        "    samples.tofile(folder + name + '.expected')\n"
        "    affine = [[0,0,3,-4],[0,-2,0,5],[1.5,0,0,6],[0,0,0,1]]\n"
        "    nibabel.save(nibabel.Nifti1Image(samples.transpose(), affine, dtype=name), folder + name + '_1.nii.gz')\n"
        "    nibabel.save(nibabel.Nifti2Image(samples.transpose(), affine, dtype=name), folder + name + '_2.nii')\n"
        "    nibabel.save(nibabel.Nifti1Pair(samples.transpose(), affine, dtype=name), folder + name + '_3.hdr')\n"
        "    tifffile.imwrite(folder + name + '_4.tif', samples, photometric='minisblack')\n"
        "    tifffile.imwrite(folder + name + '_5.tif', samples, photometric='minisblack', byteorder='>', bigtiff=True, "
        "compression='zlib', predictor=name[0] != 'f')\n"
        "    tifffile.imwrite(folder + name + '_6.tif', samples, photometric='minisblack', tile=(16, 16), compression='zlib')\n"
        "    if name in ('uint8', 'uint16', 'float32'):\n"
        "        tifffile.imwrite(folder + name + '_7.tif', samples, imagej=True, resolution=(2, 2), metadata={'axes': 'ZYX', 'spacing': "
        "4, 'unit': 'um'})\n");
    ASSERT_EQ(result.status, 0) << result.text;
    for (int t = 0; t < 8; ++t) {
        const std::string type = name_of(static_cast<ValueType>(t));
        for (const char* end : {"_1.nii.gz", "_2.nii", "_3.hdr", "_4.tif", "_5.tif", "_6.tif", "_7.tif"}) {
            const std::string path = folder / (type + end);
            if (!std::filesystem::exists(path)) continue;
            SCOPED_TRACE(type + end);
            const Volume volume = load_volume(path);
            EXPECT_EQ(volume.info.extent, (Extent{.rank = 3, .size = {7, 5, 3}}));
            EXPECT_EQ(name_of(volume.info.type), type);
            OpenOptions options;
            options.dims = {7, 5, 3};
            options.type = static_cast<ValueType>(t);
            EXPECT_TRUE(volume.bytes == load_volume(folder / (type + ".expected"), options).bytes);
            if (end[1] <= '3') {
                EXPECT_EQ(volume.info.geometry, (Geometry{.spacing = {1.5, 2, 3},
                                                          .origin = {-4, 5, 6},
                                                          .direction = {{{0, 0, 1}, {0, -1, 0}, {1, 0, 0}}},
                                                          .space = "RAS",
                                                          .unit = volume.info.geometry.unit}));
            }
            if (end[1] == '7') {
                EXPECT_EQ(volume.info.geometry, (Geometry{.spacing = {0.5, 0.5, 4}, .unit = "\u00b5m"}));
            }
        }
    }
}

}  // namespace
}  // namespace isoatlas

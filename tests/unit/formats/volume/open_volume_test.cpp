// open_volume: content decides, options must agree with headers, and every refusal says what next.
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <filesystem>

#include "isoatlas/dataset_path.h"
#include "unit/formats/volume/bzip2_stream.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using test::expect_helpful;
using test::failure_of_loading;

const std::string kNrrd =
    "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nendian: little\nencoding: raw\nspacings: 1 2 3\n\n" + std::string(16, 'x');

TEST(OpenVolume, ContentDecides) {
    const test::TestFolder folder;
    for (const char* name : {"v.nrrd", "v.nhdr", "v.mha", "v", "v.dat", "volume of 5x5_uint8 samples.nii"}) {
        EXPECT_EQ(open_volume(folder.write(name, kNrrd))->info().format, "NRRD") << name;
    }
    const std::string meta = "NDims = 2\nDimSize = 1 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nx";
    EXPECT_EQ(open_volume(folder.write("v.nrrd", meta))->info().format, "MetaImage");
    EXPECT_EQ(open_volume(folder.write("w", "Comment = some text\n" + meta))->info().format, "MetaImage");
    EXPECT_EQ(open_volume(folder.write("x_1x2_u8.bin", "\x1f\x8b"))->info().format, "RAW");
    EXPECT_EQ(open_volume(folder.write("x_1x2_u8.raw", "II"))->info().format, "RAW");
}

TEST(OpenVolume, PathsThatAreNoVolume) {
    const test::TestFolder folder;
    folder.write("volume.nrrd", kNrrd);
    expect_helpful(failure_of_loading(folder / "volume.nrd"), ErrorKind::input, "did you mean");
    expect_helpful(failure_of_loading(folder / "volume.nrd"), ErrorKind::input, "volume.nrrd?");
    expect_helpful(failure_of_loading(folder / "something else"), ErrorKind::input, "there is no such file");
    expect_helpful(failure_of_loading(folder / "no folder/file"), ErrorKind::input, "there is no such file");
    expect_helpful(failure_of_loading(folder.write("empty.nrrd", "")), ErrorKind::input, "empty");
    expect_helpful(failure_of_loading(folder.write("bad.nrrd", "something")), ErrorKind::input, "named like NRRD");
    expect_helpful(failure_of_loading(folder.write("bad.npy", "something")), ErrorKind::input, "named like NumPy");
    expect_helpful(failure_of_loading(folder.write("scan.mat", "something")), ErrorKind::unsupported, "scipy");
    expect_helpful(failure_of_loading(folder.write("scan.nrrrd", "something")), ErrorKind::unsupported, "did you mean .nrrd?");
    expect_helpful(failure_of_loading(folder.write("scan.xyz", "something")), ErrorKind::unsupported, "MetaImage (.mha .mhd)");
    expect_helpful(failure_of_loading(folder.write("v.nrrd.gz", test::gzip(kNrrd))), ErrorKind::unsupported, "gunzip");
    expect_helpful(failure_of_loading(folder.write("v.nrrd.bz2", test::bzip2(kNrrd))), ErrorKind::unsupported, "bunzip2");
    expect_helpful(failure_of_loading(folder.write("v.mrc.bz2", test::bzip2(kNrrd).substr(0, 20))), ErrorKind::input, "ends early");
    const std::pair<std::string, const char*> archives[] = {
        {"\3757zXZ" + std::string(9, '\0'), "unxz"},  {"\x28\xb5\x2f\xfd rest", "unzstd"},
        {"7z\xbc\xaf\x27\x1c rest", "7z x"},          {"Rar!\x1a\x07 rest", "unrar x"},
        {std::string(257, 'n') + "ustar", "tar -xf"}, {test::gzip(std::string(257, 'n') + "ustar"), "tar -xf"}};
    for (const auto& [bytes, next] : archives)
        expect_helpful(failure_of_loading(folder.write("v.map", bytes)), ErrorKind::unsupported, next);
    expect_helpful(failure_of_loading(folder.write("v.bin.gz", test::gzip("abc").substr(0, 12))), ErrorKind::input, "ends early");
    ASSERT_EQ(mkfifo((folder / "pipe.nrrd").c_str(), 0600), 0);
    expect_helpful(failure_of_loading(folder / "pipe.nrrd"), ErrorKind::input, "not a regular file");
    std::filesystem::create_symlink("nowhere", folder / "dangling.nrrd");
    expect_helpful(failure_of_loading(folder / "dangling.nrrd"), ErrorKind::input, "No such file");
    const std::string secret = folder.write("secret.nrrd", kNrrd);
    std::filesystem::permissions(secret, std::filesystem::perms::none);
    if (::access(secret.c_str(), R_OK) != 0) {  // root may read everything
        expect_helpful(failure_of_loading(secret), ErrorKind::input, "permission");
    }
}

TEST(OpenVolume, GeometryAndUnitsAreThoseThatTheUserGives) {
    const test::TestFolder folder;
    const std::string path = folder.write("v.nrrd", kNrrd);
    OpenOptions options;
    options.spacing = Vec3{1.366, 1.366, 2.5};
    options.origin = Vec3{-10, 0, 5};
    options.unit = "um";
    options.value_unit = "HU";
    const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
    const Geometry& geometry = reader->info().geometry;
    EXPECT_EQ(geometry.spacing, *options.spacing);
    EXPECT_EQ(geometry.origin, *options.origin);
    EXPECT_EQ(geometry.unit, "\u00b5m");
    EXPECT_EQ(reader->info().value_unit, "HU");
    const std::vector<std::string>& notes = reader->info().notes;
    EXPECT_EQ(std::ranges::count_if(notes, [](const std::string& note) { return note.find("as given, instead of") != std::string::npos; }),
              4);
    EXPECT_NE(std::ranges::find(notes, "spacing 1.366 x 1.366 x 2.5 as given, instead of 1 x 2 x 3"), notes.end());
    EXPECT_EQ(load_volume(*reader).info.geometry, geometry);
    options = {};
    options.spacing = Vec3{1, 2, 3};  // what the file says anyway
    EXPECT_TRUE(open_volume(path, options)->info().notes == open_volume(path)->info().notes);
    options.spacing = Vec3{1, 0, 3};
    expect_reason(failure_of_loading(path, options), ErrorKind::usage, Reason::zero_spacing, "");
}

TEST(OpenVolume, OptionsMayRepeatAHeaderButNotContradictIt) {
    const test::TestFolder folder;
    const std::string path = folder.write("v.nrrd", kNrrd);
    OpenOptions same;
    same.dims = std::vector<std::int64_t>{2, 2, 2};
    same.type = ValueType::i16;
    same.big_endian = false;
    same.spacing = Vec3{1, 2, 3};
    same.origin = Vec3{0, 0, 0};
    same.skip_bytes = 0;
    same.time_step = 0;
    EXPECT_EQ(open_volume(path, same)->info().format, "NRRD");
    const std::pair<std::string, std::function<void(OpenOptions&)>> changes[] = {
        {"dims", [](OpenOptions& o) { o.dims = std::vector<std::int64_t>{2, 4}; }},
        {"type", [](OpenOptions& o) { o.type = ValueType::u16; }},
        {"big_endian", [](OpenOptions& o) { o.big_endian = true; }},
        {"skip_bytes", [](OpenOptions& o) { o.skip_bytes = 4; }}};
    for (const auto& [member, change] : changes) {
        OpenOptions other = same;
        change(other);
        expect_reason(failure_of_loading(path, other), ErrorKind::usage, Reason::contradicts_header, member);
    }
    same.time_step = 1;
    expect_reason(failure_of_loading(path, same), ErrorKind::usage, Reason::no_time_steps, "0");
}

TEST(DatasetPaths, FilesAndAddresses) {
    const auto split = [](const std::string& path) { return split_dataset(path).file + "|" + split_dataset(path).dataset; };
    EXPECT_EQ(split("scan.h5:/a/b"), "scan.h5|/a/b");
    EXPECT_EQ(split("scan.h5"), "scan.h5|");
    EXPECT_EQ(split(":/a"), ":/a|");
    EXPECT_EQ(split("https://host/scan.nrrd"), "https://host/scan.nrrd|");
    EXPECT_EQ(split("http://host:80/scan.h5:/a"), "http://host:80/scan.h5|/a");
    const test::TestFolder folder;
    std::filesystem::create_directory(folder / "odd.h5:");
    EXPECT_EQ(split(folder.write("odd.h5:/name", "x")), (folder / "odd.h5:/name") + "|");
}

}  // namespace
}  // namespace isoatlas

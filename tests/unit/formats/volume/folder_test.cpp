// Folders of slices: natural order, pages of all files as one volume, files that do not fit.
#include <gtest/gtest.h>

#include <filesystem>

#include "formats/common/natural_order.h"
#include "unit/formats/volume/hostile_files.h"
#include "unit/formats/volume/tiff_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;

class Folder : public testing::Test {
protected:
    void slice(const std::string& name, std::int64_t begin, std::int64_t pages = 1, TiffRecipe r = {}) {
        r.pages = pages;
        write_tiff_file(folder_ / name, r, samples_.substr(static_cast<std::size_t>(begin) * 40));
    }
    [[nodiscard]] std::string path() const { return folder_ / "."; }
    TestFolder folder_;
    std::string samples_ = telling_bytes(40 * 30);
};

TEST_F(Folder, NaturalOrder) {
    const std::vector<std::string> sorted = {
        "", "a", "a0", "a1", "a2", "a10", "a10b", "a010c", "a99999999999999999999998", "a99999999999999999999999", "b"};
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        for (std::size_t j = 0; j < sorted.size(); ++j)
            EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
    }
    EXPECT_NE(natural_less("a1", "a01"), natural_less("a01", "a1"));
}

TEST_F(Folder, SlicesInNaturalOrder) {
    for (const int i : {10, 2, 1, 0, 11, 9}) slice("slice" + std::to_string(i) + ".tif", i);
    folder_.write(".hidden.tif", "ignored");
    folder_.write("readme.txt", "ignored");
    const auto reader = open_volume(path());
    EXPECT_EQ(reader->info().extent, (Extent{.rank = 3, .size = {5, 4, 6}}));
    std::string expected;
    for (const int i : {0, 1, 2, 9, 10, 11}) expected += samples_.substr(static_cast<std::size_t>(i) * 40, 40);
    EXPECT_EQ(read_all(*reader, 6), expected);
    expect_slabs_equal_whole(path());
    ASSERT_EQ(reader->info().notes.size(), 1U);
    EXPECT_NE(reader->info().notes[0].find("1 other"), std::string::npos);
}

TEST_F(Folder, FilesOfSeveralPages) {
    slice("a1.TIF", 0, 3);
    slice("a2.tiff", 3, 1);
    slice("a3.tif", 4, 2);
    EXPECT_EQ(read_all(*open_volume(path()), 6), samples_.substr(0, 240));
    expect_slabs_equal_whole(path());
}

TEST_F(Folder, OneSliceIsAnImage) {
    slice("only.tif", 0);
    EXPECT_EQ(open_volume(path())->info().extent.rank, 2);
}

TEST_F(Folder, VoxelSizeOfTheFirstFile) {
    for (const int i : {0, 1})
        slice("s" + std::to_string(i) + ".tif", i, 1,
              {.description = "ImageJ=1.53f\nunit=um\nspacing=3\n", .x_resolution = 2, .y_resolution = 2, .resolution_unit = RESUNIT_NONE});
    EXPECT_EQ(open_volume(path())->info().geometry, (Geometry{.spacing = {0.5, 0.5, 3}, .unit = "\u00b5m"}));
}

TEST_F(Folder, MisfitsAreNamed) {
    slice("a1.tif", 0);
    slice("a2.tif", 1);
    slice("a3.tif", 2, 1, {.width = 6, .description = {}});
    expect_helpful(failure_of_loading(path()), ErrorKind::input, "a3.tif");
    slice("a3.tif", 2, 1, {.type = ValueType::i16, .description = {}});
    expect_helpful(failure_of_loading(path()), ErrorKind::input, "a3.tif");
    folder_.write("a3.tif", "no TIFF");
    expect_helpful(failure_of_loading(path()), ErrorKind::input, "a3.tif");
}

TEST_F(Folder, FilesThatChangeAfterwards) {
    slice("a1.tif", 0);
    slice("a2.tif", 1);
    const auto reader = open_volume(path());
    slice("a2.tif", 1, 1, {.width = 3, .description = {}});
    expect_helpful(failure_of([&] { static_cast<void>(read_all(*reader, 2)); }), ErrorKind::input, "changed");
}

TEST_F(Folder, OtherContents) {
    expect_helpful(failure_of_loading(path()), ErrorKind::input, "no slices");
    folder_.write("picture.png", "x");
    expect_helpful(failure_of_loading(path()), ErrorKind::input, "picture.png");
    folder_.write("IM0001", std::string(128, '\0') + "DICM");
    expect_helpful(failure_of_loading(path()), ErrorKind::input, "picture.png");  // DICOM without a picture
    std::filesystem::create_directory(folder_ / "image.zarr");
    for (const char* name : {".zarray", ".zgroup", "zarr.json"}) {
        const std::string zarr = folder_.write(std::string("image.zarr/") + name, "{}");
        expect_helpful(failure_of_loading(folder_ / "image.zarr"), ErrorKind::input, "Zarr");
        std::filesystem::remove(zarr);
    }
}

}  // namespace
}  // namespace isoatlas

// Headers name files of their own folder: others are refused unless follow_links says that they are trusted.
#include <gtest/gtest.h>

#include "unit/formats/volume/compressed_files.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

/// A folder with volumes and, beside it, one with a file that they have no business with.
class OwnFolder : public testing::Test {
protected:
    void SetUp() override {
        fs::create_directories(folder_ / "v/below");
        fs::create_directories(folder_ / "secret");
        for (const char* name : {"secret/key", "v/own.raw", "v/below/own.raw"}) folder_.write(name, test::compressed_samples());
        fs::create_symlink("../secret/key", folder_ / "v/link.raw");
        fs::create_symlink("own.raw", folder_ / "v/inner.raw");
        fs::create_symlink("../secret", folder_ / "v/elsewhere");
        fs::create_symlink("v/link.nhdr", folder_ / "outer.nhdr");
    }
    void expect_refused(const std::string& name, const std::string& content) const {
        SCOPED_TRACE(name + ": " + content);
        expect_refused_as_it_is(folder_.write(name, content));
    }
    void expect_refused_as_it_is(const std::string& path, const OpenOptions& given = {}) const {
        OpenOptions options = given;
        test::expect_helpful(test::failure_of_loading(path, options), ErrorKind::input, "outside its folder");
        EXPECT_EQ(test::failure_of_loading(path, options).text.reason, Reason::file_outside_folder);
        options.follow_links = true;
        EXPECT_EQ(test::text_of_bytes(load_volume(path, options)), test::compressed_samples());
    }
    void expect_read(const std::string& name, const std::string& content) const {
        SCOPED_TRACE(name + ": " + content);
        EXPECT_EQ(test::text_of_bytes(load_volume(folder_.write(name, content))), test::compressed_samples());
    }

    test::TestFolder folder_;
    const std::string nrrd_ = "NRRD0004\ntype: ushort\ndimension: 3\nsizes: 4 3 4\nendian: little\nencoding: raw\ndata file: ";
    const std::string meta_ = "NDims = 3\nDimSize = 4 3 4\nElementType = MET_USHORT\nElementByteOrderMSB = False\nElementDataFile = ";
};

TEST_F(OwnFolder, FilesOutsideAreRefused) {
    const std::vector<std::string> outside = {"../secret/key", folder_ / "secret/key", "link.raw", "elsewhere/key",
                                              "below/../../secret/key"};
    for (const std::string& name : outside) {
        expect_refused("v/v.nhdr", nrrd_ + name + "\n");
        expect_refused("v/v.nhdr", nrrd_ + "LIST\n" + name + "\n");
        expect_refused("v/v.mhd", meta_ + name + "\n");
        expect_refused("v/v.mhd", meta_ + "LIST\n" + name + "\n");
    }
}

TEST_F(OwnFolder, PatternsAndPartsAreRefused) {
    folder_.write("secret/p1", test::compressed_samples().substr(0, 48));
    folder_.write("secret/p2", test::compressed_samples().substr(48));
    folder_.write("v/p1", test::compressed_samples().substr(0, 48));
    expect_refused("v/v.nhdr", nrrd_ + "../secret/p%d 1 2 1\n");
    expect_refused("v/v.mhd", meta_ + "../secret/p%d 1 2 1\n");
    expect_refused("v/v.nhdr", nrrd_ + "LIST\np1\n../secret/p2\n");
}

TEST_F(OwnFolder, FilesInsideAreRead) {
    for (const std::string& name : {std::string("own.raw"), std::string("below/own.raw"), std::string("./below/../own.raw"),
                                    std::string("inner.raw"), folder_ / "v/own.raw"}) {
        expect_read("v/v.nhdr", nrrd_ + name + "\n");
        expect_read("v/v.mhd", meta_ + name + "\n");
    }
    expect_read("v/link.nhdr", nrrd_ + "own.raw\n");
    fs::create_symlink("v/own.raw", folder_ / "own.raw");  // beside a link to the header: that folder is its own as well
    EXPECT_EQ(test::text_of_bytes(load_volume(folder_ / "outer.nhdr")), test::compressed_samples());
}

TEST_F(OwnFolder, TheMessageDoesNotTellWhatIsThere) {
    const auto there = test::failure_of_loading(folder_.write("v/v.nhdr", nrrd_ + "../secret/key\n"));
    const auto missing = test::failure_of_loading(folder_.write("v/v.nhdr", nrrd_ + "../secret/kex\n"));
    EXPECT_EQ(there.kind, missing.kind);
    EXPECT_EQ(there.text.next, missing.text.next);
}

TEST_F(OwnFolder, PairsSidecarsAndSlicesThatAreLinksAreRefused) {
    folder_.write("v/pair.hdr", test::nifti_header(true));
    fs::create_symlink("../secret/key", folder_ / "v/pair.img");
    expect_refused_as_it_is(folder_ / "v/pair.hdr");
    folder_.write("secret/side.json", R"({"dims": [4, 3, 4], "type": "uint16", "endian": "little"})");
    folder_.write("v/s.raw", test::compressed_samples());
    fs::create_symlink("../secret/side.json", folder_ / "v/s.raw.json");
    expect_refused_as_it_is(folder_ / "v/s.raw");
    fs::create_directories(folder_ / "slices");
    test::TiffRecipe recipe{.width = 4, .height = 3, .pages = 4};
    test::write_tiff_file(folder_ / "secret/all.tif", recipe, test::compressed_samples());
    fs::create_symlink("../secret/all.tif", folder_ / "slices/1.tif");
    expect_refused_as_it_is(folder_ / "slices");
}

/// Somebody names a link himself: that is his business.
TEST_F(OwnFolder, TheNamedFileMayBeALink) {
    folder_.write("secret/v.nrrd", nrrd_.substr(0, nrrd_.find("data file")) + "\n" + test::compressed_samples());
    fs::create_symlink("../secret/v.nrrd", folder_ / "v/v.nrrd");
    EXPECT_EQ(test::text_of_bytes(load_volume(folder_ / "v/v.nrrd")), test::compressed_samples());
}

}  // namespace
}  // namespace isoatlas

// What a build without GDCM and OpenVDB says. The files that choose them are compiled into this program without the libraries, and so
// replace those of isoatlas::formats.
#include <gtest/gtest.h>

#include "isoatlas/output.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

std::string seed(const std::string& name) {
    std::ifstream file(std::string(ISOATLAS_SOURCE_DIR) + "/tests/fuzz/corpus/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(WithoutOptionalParts, OneMessageNamesThePackage) {
    const test::TestFolder folder;
    const test::Failure vdb = test::failure_of_loading(folder.write("v.vdb", seed("openvdb/leaf")));
    expect_reason(vdb, ErrorKind::unsupported, Reason::built_without_format, "OpenVDB");
    EXPECT_NE(vdb.text.next.find("libopenvdb-dev"), std::string::npos) << vdb.text.next;
    const test::Failure dicom = test::failure_of_loading(folder.write("v.dcm", seed("dicom/jpeg")));
    expect_reason(dicom, ErrorKind::unsupported, Reason::built_without_format, "GDCM");
    EXPECT_NE(dicom.text.next.find("libgdcm-dev"), std::string::npos) << dicom.text.next;
}

TEST(WithoutOptionalParts, NothingIsWritten) {
    const test::TestFolder folder;
    const Volume volume = make_volume({3, {2, 2, 2}}, ValueType::u8, {});
    expect_reason(test::failure_of([&] { write_volume(folder / "o.vdb", volume); }), ErrorKind::unsupported, Reason::built_without_format,
                  "OpenVDB");
    EXPECT_FALSE(std::filesystem::exists(folder / "o.vdb"));
}

TEST(WithoutOptionalParts, OthersAreRead) {
    const test::TestFolder folder;
    EXPECT_EQ(load_volume(folder.write("v.dcm", seed("dicom/rle"))).info.extent.size, (Index3{4, 3, 1}));
}

}  // namespace
}  // namespace isoatlas

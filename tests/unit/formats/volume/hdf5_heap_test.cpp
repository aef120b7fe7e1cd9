// Lists of any length in the global heaps of HDF5 files.
#include "formats/volume/hdf5_heap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "formats/volume/hdf5_driver.h"
#include "oracle/write_file.h"
#include "unit/formats/volume/hdf5_files.h"
#include "unit/formats/volume/volume_files.h"

namespace isoatlas {
namespace {

using namespace test;
using Texts = std::vector<std::string>;

/// Of the attribute "a" of the group "g"; empty: the file does not open, or the attribute is damaged.
Texts read(const std::string& path) {
    const std::scoped_lock lock(hdf5_mutex());
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    Hdf5Access access{.path = path};
    const Hdf5Handle properties = hdf5_access_properties(access), file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, properties), H5Fclose);
    const Hdf5Handle attribute(file < 0 ? -1 : H5Aopen_by_name(file, "g", "a", H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    Texts texts;
    if (attribute < 0) return texts;
    for (const std::vector<std::byte>& bytes : read_hdf5_lists(attribute, 1)) {
        std::string text;
        for (const std::byte byte : bytes) text += static_cast<char>(byte);
        texts.push_back(text);
    }
    return texts;
}

void write(const std::string& path, const Texts& texts, hsize_t user_block = 0) {
    const std::scoped_lock lock(hdf5_mutex());
    const Hdf5Maker maker(path, user_block);
    maker.group("g");
    maker.set_list("g", "a", texts);
}

TEST(Hdf5Heap, TextsOfAnyLength) {
    const TestFolder folder;
    const Texts texts = {"one", "", std::string(5000, 'x'), "\u00b5m", std::string(100000, 'y'), "last"};
    for (const hsize_t user_block : {0, 512, 4096}) {
        write(folder / "v.h5", texts, user_block);
        Texts found = read(folder / "v.h5");
        for (std::string& text : found) text = text.substr(0, text.find('\0'));
        EXPECT_EQ(found, texts) << user_block;
    }
}

/// Of the heap alone: that damage elsewhere does not reach HDF5 is tested with files.
TEST(Hdf5Heap, NoDamagedByteGivesMoreThanTheFileHas) {
    const TestFolder folder;
    const Texts texts = {"first text", "second text", "third"};
    write(folder / "v.h5", texts);
    const std::string content = file_content(folder / "v.h5");
    const std::size_t heap = content.find("GCOL");
    ASSERT_NE(heap, std::string::npos);
    const Texts whole = read(folder / "v.h5");
    int same = 0, other = 0;
    for (std::size_t i = heap; i < heap + 160; ++i) {
        for (const int damage : {1, 0x80, 0xff}) {
            std::string damaged = content;
            damaged[i] = static_cast<char>(damaged[i] ^ damage);
            oracle::write_file(folder / "d.h5", damaged);
            const Texts found = read(folder / "d.h5");
            std::size_t bytes = 0;
            for (const std::string& text : found) bytes += text.size();
            EXPECT_LE(bytes, content.size()) << i;
            ++(found == whole ? same : other);
        }
    }
    EXPECT_GT(same, 0);
    EXPECT_GT(other, 0);
}

TEST(Hdf5Heap, NoPrefixOfAFileGivesAnotherText) {
    const TestFolder folder;
    write(folder / "v.h5", {"first text", "second text"});
    const std::string content = file_content(folder / "v.h5");
    const Texts whole = read(folder / "v.h5");
    for (std::size_t size = 0; size < content.size(); size += 7) {
        oracle::write_file(folder / "d.h5", content.substr(0, size));
        for (const std::string& text : read(folder / "d.h5")) EXPECT_TRUE(text.empty() || std::ranges::find(whole, text) != whole.end());
    }
}

}  // namespace
}  // namespace isoatlas

// AtomicFile: the whole file or no change, whatever fails.
#include "base/atomic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "faults/faulty_files.h"
#include "isoatlas/error.h"

namespace {

namespace fs = std::filesystem;
using isoatlas::AtomicFile;
using isoatlas::Error;
using isoatlas::ErrorKind;
using isoatlas::test::FullDisk;

class AtomicFileTest : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("isoatlas_atomic_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        path_ = (folder_ / "out.bin").string();
    }
    void TearDown() override { fs::remove_all(folder_); }

    static std::string content(const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static ErrorKind kind_of(const std::function<void()>& work, const std::string& part) {
        try {
            work();
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
            EXPECT_FALSE(error.text().next.empty());
            return error.kind();
        }
        ADD_FAILURE() << "no error";
        return ErrorKind::internal;
    }
    [[nodiscard]] std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }

    fs::path folder_;
    std::string path_;
};

TEST_F(AtomicFileTest, NothingBeforeCommitEverythingAfter) {
    std::string expected;
    {
        AtomicFile file(path_);
        for (int i = 0; i < 100000; ++i) {
            file.write("line " + std::to_string(i) + "\n");
            expected += "line " + std::to_string(i) + "\n";
        }
        const std::string large(600000, 'x');  // larger than the buffer
        file.write(large);
        file.write("end");
        expected += large + "end";
        EXPECT_EQ(file.size(), static_cast<std::int64_t>(expected.size()));
        EXPECT_FALSE(fs::exists(path_));
        file.write_at(5, std::as_bytes(std::span("ZZZ", 3)));
        file.write_at(0, std::as_bytes(std::span("L", 1)));
        expected.replace(5, 3, "ZZZ");
        expected[0] = 'L';
        file.commit();
    }
    EXPECT_EQ(content(path_), expected);
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, WithoutCommitTheOldFileStays) {
    std::ofstream(path_) << "old";
    {
        AtomicFile file(path_);
        file.write("new");
    }
    EXPECT_EQ(content(path_), "old");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, FullDiskAtAnyByteLeavesTheOldFileAndNoPartial) {
    std::ofstream(path_) << "old";
    for (const std::int64_t after : {0, 1, 1000, 262144, 300000, 599999}) {
        const FullDisk fault(after, ENOSPC);
        const auto work = [&] {
            AtomicFile file(path_);
            for (int i = 0; i < 600; ++i) file.write(std::string(1000, 'a'));
            file.commit();
        };
        EXPECT_EQ(kind_of(work, "No space left"), ErrorKind::resource) << after;
        EXPECT_EQ(content(path_), "old");
        EXPECT_EQ(files(), 1u);
    }
    AtomicFile file(path_);  // the fault ends with its object
    file.write("new");
    file.commit();
    EXPECT_EQ(content(path_), "new");
}

TEST_F(AtomicFileTest, FullDevice) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    const auto work = [&] {
        AtomicFile file("/dev/full");
        file.write("x");
        file.commit();
    };
    EXPECT_EQ(kind_of(work, "/dev/full"), ErrorKind::resource);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    EXPECT_FALSE(fs::exists("/dev/full.partial"));
}

TEST_F(AtomicFileTest, DevicesAreNotReplaced) {
    AtomicFile file("/dev/null");
    file.write("x");
    file.commit();
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFileTest, FoldersThatAreNotThereAndFoldersAsFiles) {
    EXPECT_EQ(kind_of([&] { AtomicFile file((folder_ / "no" / "out.bin").string()); }, "No such file"), ErrorKind::resource);
    EXPECT_EQ(kind_of([&] { AtomicFile file(folder_.string()); }, "directory"), ErrorKind::resource);
    EXPECT_EQ(files(), 0u);
}

TEST_F(AtomicFileTest, UnwritableFolder) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(kind_of([&] { AtomicFile file(path_); }, "denied"), ErrorKind::resource);
    fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(AtomicFileTest, OneWriterAtATime) {
    AtomicFile first(path_);
    EXPECT_EQ(kind_of([&] { AtomicFile second(path_); }, "another program"), ErrorKind::resource);
    first.write("first");
    first.commit();
    EXPECT_EQ(content(path_), "first");
}

TEST_F(AtomicFileTest, LinksStayAndPermissionsAreKept) {
    const std::string real = (folder_ / "real.bin").string();
    std::ofstream(real) << "old";
    fs::permissions(real, fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("real.bin", path_);
    AtomicFile file(path_);
    file.write("new");
    file.commit();
    EXPECT_TRUE(fs::is_symlink(path_));
    EXPECT_EQ(content(real), "new");
    EXPECT_EQ(fs::status(real).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

}  // namespace

// AtomicFile: the whole file or no change, whatever fails.
#include "base/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>

#include "base/temporary_name.h"
#include "faults/faulty_files.h"
#include "faults/forwarding_files.h"
#include "isoatlas/error.h"
#include "isoatlas/output_file.h"

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

TEST_F(AtomicFileTest, DevicesPipesAndSocketsAreRefusedAtOnce) {
    for (const char* device : {"/dev/full", "/dev/null"}) {
        EXPECT_EQ(kind_of([&] { AtomicFile file(device); }, "device"), ErrorKind::resource);
        EXPECT_TRUE(fs::is_character_file(device));
    }
    ASSERT_EQ(::mkfifo(path_.c_str(), 0666), 0);
    EXPECT_EQ(kind_of([&] { AtomicFile file(path_); }, "pipe"), ErrorKind::resource) << "and nobody waits for a reader";
    const std::string link = (folder_ / "link").string();
    fs::create_symlink("/dev/null", link);
    EXPECT_EQ(kind_of([&] { AtomicFile file(link); }, "is a link to /dev/null"), ErrorKind::resource);
    EXPECT_EQ(files(), 2u);
}

TEST_F(AtomicFileTest, WhatTheProcessHasOpenIsWrittenTo) {
    const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_GE(descriptor, 0);
    {
        AtomicFile file("/dev/fd/" + std::to_string(descriptor));
        file.write("x");
        file.commit();
    }
    ::close(descriptor);
    EXPECT_EQ(content(path_), "x");
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

// Each file is whole; the last one stays.
TEST_F(AtomicFileTest, TwoWritersDoNotMix) {
    AtomicFile first(path_), second(path_);
    first.write("first");
    second.write("second");
    second.commit();
    EXPECT_EQ(content(path_), "second");
    first.commit();
    EXPECT_EQ(content(path_), "first");
    EXPECT_EQ(files(), 1u);
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

TEST_F(AtomicFileTest, LinksThatLeadNowhereOrInCirclesAreRefused) {
    fs::create_symlink("nowhere", path_);
    EXPECT_EQ(kind_of([&] { AtomicFile file(path_); }, "nowhere, which is not there"), ErrorKind::resource);
    fs::remove(path_);
    fs::create_symlink("out.bin", path_);
    EXPECT_EQ(kind_of([&] { AtomicFile file(path_); }, "symbolic links"), ErrorKind::resource);
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, HardLinksKeepTheOldContentUnderTheirOtherName) {
    const std::string other = (folder_ / "other").string();
    std::ofstream(other) << "old";
    fs::create_hard_link(other, path_);
    AtomicFile file(path_);
    file.write("new");
    file.commit();
    EXPECT_EQ(content(path_), "new");
    EXPECT_EQ(content(other), "old");
}

TEST_F(AtomicFileTest, ReadOnlyFilesAreNotReplaced) {
    std::ofstream(path_) << "old";
    fs::permissions(path_, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
    EXPECT_EQ(kind_of([&] { AtomicFile file(path_); }, "0444"), ErrorKind::resource);
    EXPECT_EQ(kind_of([&] { isoatlas::check_output_file(path_); }, "allow writing"), ErrorKind::resource);
    EXPECT_EQ(content(path_), "old");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LinksAndFilesOfOtherUsersAreNotFollowed) {
    if (::geteuid() != 0) GTEST_SKIP() << "only the superuser can make files of others";
    const std::string real = (folder_ / "real.bin").string();
    std::ofstream(real) << "precious";
    fs::create_symlink("real.bin", path_);
    ASSERT_EQ(::lchown(path_.c_str(), 12345, 12345), 0);
    EXPECT_EQ(kind_of([&] { AtomicFile file(path_); }, "another user made"), ErrorKind::resource);
    ASSERT_EQ(::lchown(path_.c_str(), 0, 0), 0);
    ASSERT_EQ(::chown(real.c_str(), 12345, 12345), 0);
    EXPECT_EQ(kind_of([&] { AtomicFile file(path_); }, "belongs to another user"), ErrorKind::resource);
    EXPECT_EQ(content(real), "precious");
}

/// A disk that has no files without names.
class OnlyNamed final : public isoatlas::test::ForwardingFiles {
public:
    isoatlas::OpenedFile create_unnamed(const std::string&, unsigned) override { return {nullptr, -EOPNOTSUPP}; }
};

TEST_F(AtomicFileTest, NothingOfTheUserIsInTheWay) {
    const std::string precious = (folder_ / "precious").string();
    std::ofstream(precious) << "precious";
    std::ofstream(path_ + ".partial") << "mine";
    for (const bool named : {false, true}) {
        OnlyNamed disk;
        const isoatlas::ReplacedFileSystem in_use(named ? static_cast<isoatlas::FileSystem&>(disk) : isoatlas::system_files());
        for (const bool linked : {false, true}) {
            if (linked) {
                fs::remove(path_ + ".partial");
                fs::create_symlink("precious", path_ + ".partial");
            }
            AtomicFile file(path_);
            file.write("new");
            file.commit();
            EXPECT_EQ(content(path_), "new");
            EXPECT_EQ(content(path_ + ".partial"), linked ? "precious" : "mine");
            EXPECT_EQ(files(), 3u);
        }
        fs::remove(path_ + ".partial");
        std::ofstream(path_ + ".partial") << "mine";
    }
    EXPECT_EQ(content(precious), "precious");
}

TEST_F(AtomicFileTest, NamesCannotBeForetoldAndAreKnownAgain) {
    std::set<std::string> names;
    for (int i = 0; i < 1000; ++i) names.insert(isoatlas::temporary_name());
    EXPECT_EQ(names.size(), 1000u);
    for (const std::string& name : names) {
        EXPECT_TRUE(isoatlas::is_temporary_name(name) && isoatlas::is_temporary_name("a/b/" + name)) << name;
        std::string other = name;
        other[12] = other[12] == '0' ? '1' : '0';
        EXPECT_FALSE(isoatlas::is_temporary_name(other)) << other;
    }
    for (const char* name : {"", ".partial", "x.ply.partial", ".isoatlas-0123456789abcdef01234567.partial"})
        EXPECT_FALSE(isoatlas::is_temporary_name(name)) << name;
}

// A crash where the disk has no files without names.
TEST_F(AtomicFileTest, WhatACrashHasLeftIsRemovedAndNothingElse) {
    OnlyNamed disk;
    const isoatlas::ReplacedFileSystem in_use(disk);
    const std::string left = (folder_ / isoatlas::temporary_name()).string(), linked = (folder_ / isoatlas::temporary_name()).string(),
                      link = (folder_ / isoatlas::temporary_name()).string(), named = (folder_ / ".isoatlas-mine.partial").string();
    AtomicFile other((folder_ / "other.bin").string());  // somebody writes at the same time
    other.write("other");
    std::ofstream(left) << "half";
    std::ofstream(named) << "mine";
    fs::create_hard_link(named, linked);
    fs::create_symlink("/etc/passwd", link);
    AtomicFile file(path_);
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(linked) && fs::is_symlink(link));
    EXPECT_EQ(content(named), "mine");
    other.commit();
    EXPECT_EQ(content((folder_ / "other.bin").string()), "other");
}

TEST_F(AtomicFileTest, AnInterruptRemovesWhatHasANameAndIsNotFinished) {
    OnlyNamed disk;
    const isoatlas::ReplacedFileSystem in_use(disk);
    std::ofstream(path_) << "old";
    AtomicFile file(path_), done((folder_ / "done.bin").string());
    file.write("half");
    done.commit();
    EXPECT_EQ(files(), 3u);
    isoatlas::remove_unfinished_files();
    EXPECT_EQ(files(), 2u);
    EXPECT_EQ(content(path_), "old");
}

}  // namespace

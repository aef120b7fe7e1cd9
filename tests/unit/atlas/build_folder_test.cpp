// The folder of a build: what is not of a build is neither changed nor removed, however it got there.
#include "atlas/build_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "atlas/lock_text.h"
#include "base/temporary_name.h"
#include "isoatlas/error.h"
#include "isoatlas/phantom.h"
#include "oracle/stores.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

class BuildFolders : public oracle::Stores {
protected:
    static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
    static std::string content(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void expect_refused(const std::string& part) const {
        try {
            build_atlas(path_, make_phantom("demo", {.size = 32}));
            ADD_FAILURE() << "no error: " << part;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::resource);
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
            EXPECT_FALSE(error.text().next.empty());
        }
        EXPECT_FALSE(fs::exists(path_));
    }

    fs::path folder_ = path_ + ".build", lock_ = folder_ / "lock", precious_ = path_ + ".precious";
};

TEST_F(BuildFolders, OfSomebodyElseAreRefused) {
    fs::create_directory(folder_);
    write(folder_ / "trees", "mine");
    write(folder_ / "notes", "mine, too");
    expect_refused("not made by a build");
    EXPECT_FALSE(fs::exists(lock_));
    for (const char* text : {"mine", "123\n", "folder of an isoatlas build"}) {  // the second one is of an earlier version
        write(lock_, text);
        expect_refused("not made by a build");
        EXPECT_EQ(content(lock_), text);
    }
    write(lock_, "");
    expect_refused("not made by a build");
    EXPECT_EQ(content(folder_ / "trees"), "mine");
    EXPECT_EQ(content(folder_ / "notes"), "mine, too");
    fs::remove_all(folder_);
}

TEST_F(BuildFolders, AreNoLinksAndNoFiles) {
    const fs::path elsewhere = path_ + ".elsewhere";
    fs::create_directory(elsewhere);
    write(elsewhere / "trees", "mine");
    fs::create_directory_symlink(elsewhere, folder_);
    expect_refused("is a link");
    EXPECT_EQ(std::distance(fs::directory_iterator(elsewhere), {}), 1);
    fs::remove_all(elsewhere);
    expect_refused("is a link");  // to nowhere
    fs::remove(folder_);
    write(folder_, "mine");
    expect_refused("is not a folder");
    EXPECT_EQ(content(folder_), "mine");
    fs::remove(folder_);
    if (::geteuid() != 0) return;  // only the superuser can make folders of others
    fs::create_directory(folder_);
    ASSERT_EQ(::chown(folder_.c_str(), 12345, 12345), 0);
    expect_refused("another user");
    fs::remove(folder_);
}

TEST_F(BuildFolders, AreTakenOverWhenTheyAreEmptyOrACrashHasLeftThem) {
    for (const bool with_lock : {false, true}) {
        fs::create_directory(folder_);
        if (with_lock) write(lock_, std::string(3, '\0'));
        build_atlas(path_, make_phantom("demo", {.size = 32}));
        EXPECT_TRUE(fs::exists(path_) && !fs::exists(folder_));
        fs::remove(path_);
    }
}

TEST_F(BuildFolders, HaveALockThatIsAPlainFile) {
    write(precious_, "precious");
    fs::create_directory(folder_);
    fs::create_symlink(precious_, lock_);
    expect_refused("lock");
    fs::remove(lock_);
    write(precious_, std::string(kBuildMark));
    fs::create_hard_link(precious_, lock_);
    expect_refused("lock");
    EXPECT_EQ(content(precious_), kBuildMark);
    fs::remove(lock_);
    ASSERT_EQ(::mkfifo(lock_.c_str(), 0666), 0);
    EXPECT_FALSE(build_state(path_)) << "and nobody waits for a writer";
    expect_refused("lock");
    fs::remove_all(folder_);
    fs::remove(precious_);
}

TEST_F(BuildFolders, KeepWhatNoBuildMakes) {
    for (const bool restart : {false, true}) {
        fs::create_directory(folder_);
        write(lock_, lock_text({}));
        write(folder_ / "trees", "damaged");
        write(folder_ / "notes", "mine");
        const fs::path left = folder_ / temporary_name();
        write(left, "half");
        BuildFolder folder(path_, restart);
        EXPECT_EQ(fs::exists(left), !restart);
        EXPECT_EQ(fs::exists(folder_ / "trees"), !restart);
        EXPECT_FALSE(folder.remove());
        EXPECT_FALSE(fs::exists(left));
        EXPECT_EQ(content(folder_ / "notes"), "mine");
        EXPECT_TRUE(content(lock_).starts_with(kBuildMark)) << "it is still that of a build";
        fs::remove_all(folder_);
    }
}

TEST_F(BuildFolders, LieBesideTheStoreThatALinkLeadsTo) {
    write(path_, "old");
    const std::string link = path_ + ".link";
    fs::create_symlink(path_, link);
    const BuildFolder folder(path_, false);
    EXPECT_TRUE(build_state(link)) << "it is the same store";
    EXPECT_THROW(BuildFolder(link, false), Error);
    fs::remove(link);
    fs::remove(path_);
}

}  // namespace
}  // namespace isoatlas

// A store on a failing disk: every read may fail, come short or be interrupted; the answer is right or the error says which file.
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "io/file_access.h"
#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

/// What happens to a read: its number is counted over all files.
struct Disk {
    int reads = 0;
    int failing = -1;      ///< number of the read that fails
    int error = EIO;       ///< with which error
    std::size_t most = 0;  ///< bytes of a read; 0: all
};

class FailingFile final : public io::FileHandle {
public:
    FailingFile(std::unique_ptr<io::FileHandle> file, Disk& disk) : file_(std::move(file)), disk_(disk) {}
    std::int64_t size() const override { return file_->size(); }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        if (disk_.reads++ == disk_.failing) return -disk_.error;
        return file_->read_at(offset, disk_.most > 0 && out.size() > disk_.most ? out.first(disk_.most) : out);
    }

private:
    std::unique_ptr<io::FileHandle> file_;
    Disk& disk_;
};

class StoreFaults : public testing::Test {
protected:
    StoreFaults() : path_((fs::temp_directory_path() / ("isoatlas_faults_" + std::to_string(::getpid()) + ".atlas")).string()) {
        volume_ = make_phantom("noise", {.size = 24, .quantise = 32});
        build_atlas(path_, volume_);
        io::replace_file_opener(
            [this](const std::string& path) { return std::make_unique<FailingFile>(io::open_system_file(path), disk_); });
    }
    ~StoreFaults() override {
        io::replace_file_opener({});
        fs::remove(path_);
    }
    StoreFaults(const StoreFaults&) = delete;
    StoreFaults& operator=(const StoreFaults&) = delete;

    /// Opens the store and asks everything. Returns whether the answers are right; throws what the store throws.
    bool answers() const {
        Context context;
        context.threads = 1;
        const Atlas atlas(path_);
        const Surface actual = atlas.extract(15, {}, context), expected = extract(volume_, 15, {}, context);
        const Analysis analysis = atlas.analysis();
        return actual.points == expected.points && actual.triangles == expected.triangles && actual.object == expected.object &&
               analysis.event_count() > 0 && atlas.volume(context).bytes == volume_.bytes;
    }

    std::string path_;
    Volume volume_;
    mutable Disk disk_;
};

TEST_F(StoreFaults, ShortReadsAndInterruptionsDoNotMatter) {
    disk_ = {.most = 97};
    EXPECT_TRUE(answers());
    const int reads = disk_.reads;
    for (int at = 0; at < reads; at += 1 + reads / 50) {
        disk_ = {.failing = at, .error = EINTR, .most = 97};
        EXPECT_TRUE(answers()) << at;
    }
}

TEST_F(StoreFaults, EveryReadThatFailsIsTold) {
    disk_ = {};
    EXPECT_TRUE(answers());
    const int reads = disk_.reads;
    ASSERT_GT(reads, 20);
    for (int at = 0; at < reads; ++at) {
        disk_ = {.failing = at};
        try {
            (void)answers();
            ADD_FAILURE() << "read " << at << " failed and nobody said so";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << at;
            EXPECT_EQ(error.text().file, path_) << at;
        }
    }
}

TEST_F(StoreFaults, AfterAFailureTheSameStoreAnswersAgain) {
    disk_ = {};
    const Atlas atlas(path_);
    disk_ = {.failing = 0};
    EXPECT_THROW((void)atlas.extract(15), Error);
    disk_ = {};
    EXPECT_EQ(atlas.extract(15).points, extract(volume_, 15).points);
}

}  // namespace
}  // namespace isoatlas

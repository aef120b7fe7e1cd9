// A store on a failing disk: every operation may fail, come short or be interrupted; the answer is right or the error says which file.
#include <gtest/gtest.h>

#include <cerrno>

#include "faults/faulty_files.h"
#include "faults/memory_files.h"
#include "faults/store_queries.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

using test::Query;

constexpr const char* kNoise = "noise.atlas";
constexpr double kTau = 24.5;

class StoreFaults : public testing::Test {
protected:
    StoreFaults() {
        const ReplacedFileSystem in_use(memory_);
        build_atlas(kNoise, make_phantom("noise", {.size = 34, .quantise = 32}));
        const Atlas atlas(kNoise);
        queries_ = test::queries(kTau, atlas.cut(kTau).objects.at(3).id);
        for (const Query& query : queries_) right_.push_back(query.ask(atlas));
    }

    test::MemoryFiles memory_;
    std::vector<Query> queries_;
    std::vector<std::string> right_;
};

void expect_says_where(const Error& error, std::int64_t at) {
    EXPECT_EQ(error.kind(), ErrorKind::input) << at;
    EXPECT_EQ(error.text().file, kNoise) << at;
    EXPECT_NE(error.text().what.find("Input/output error"), std::string::npos) << at << ": " << error.what();
    EXPECT_FALSE(error.text().next.empty()) << at;
}

TEST_F(StoreFaults, ShortAndInterruptedReadsDoNotMatter) {
    for (const std::size_t max : {std::size_t{7}, std::size_t{97}, std::size_t{4096}}) {
        test::FaultyFiles disk({.max = max}, memory_);
        const ReplacedFileSystem in_use(disk);
        const Atlas atlas(kNoise);
        for (std::size_t q = 0; q < queries_.size(); ++q) EXPECT_TRUE(queries_[q].ask(atlas) == right_[q]) << queries_[q].name;
        EXPECT_GT(disk.operations(), 100);
    }
}

TEST_F(StoreFaults, EveryOperationThatFailsIsTold) {
    for (std::size_t q = 0; q < queries_.size(); ++q) {
        std::int64_t at = 0;
        for (bool failed = true; failed; ++at) {
            test::FaultyFiles disk({.at = at}, memory_);
            const ReplacedFileSystem in_use(disk);
            try {
                const Atlas atlas(kNoise);
                EXPECT_TRUE(queries_[q].ask(atlas) == right_[q]) << queries_[q].name;
                EXPECT_FALSE(disk.has_failed()) << queries_[q].name << ": operation " << at << " failed and nobody said so";
            } catch (const Error& error) {
                expect_says_where(error, at);
            }
            failed = disk.has_failed();
        }
        EXPECT_GT(at, 10) << queries_[q].name;
    }
}

TEST_F(StoreFaults, AfterAFailureTheSameStoreAnswersAgain) {
    for (std::size_t q = 1; q < queries_.size(); ++q) {
        bool failed = true;
        for (std::int64_t at = 0; failed; ++at) {
            test::FaultyFiles disk({}, memory_);
            const ReplacedFileSystem in_use(disk);
            const Atlas atlas(kNoise);
            disk.restart({.at = at});
            try {
                (void)queries_[q].ask(atlas);
                EXPECT_FALSE(disk.has_failed()) << queries_[q].name << " " << at;
            } catch (const Error& error) {
                expect_says_where(error, at);
            }
            failed = disk.has_failed();
            disk.restart({});
            EXPECT_TRUE(queries_[q].ask(atlas) == right_[q]) << queries_[q].name << " after operation " << at << " failed";
        }
    }
}

TEST_F(StoreFaults, AFileThatBecomesShorterIsTold) {
    const ReplacedFileSystem in_use(memory_);
    const Atlas atlas(kNoise);
    memory_.content(kNoise).resize(3000);
    for (std::size_t q = 1; q < queries_.size(); ++q) EXPECT_THROW((void)queries_[q].ask(atlas), Error) << queries_[q].name;
}

// Nothing may be written beside a store that is read, nor to it.
TEST_F(StoreFaults, QueriesWriteNothing) {
    class ReadOnlyDisk final : public FileSystem {  // every other operation is refused
    public:
        explicit ReadOnlyDisk(FileSystem& below) : below_(below) {}
        FileStatus status(const std::string& path) override { return below_.status(path); }
        OpenedFile open(const std::string& path) override { return below_.open(path); }

    private:
        FileSystem& below_;
    } disk(memory_);
    const ReplacedFileSystem in_use(disk);
    const std::string before = memory_.content(kNoise);
    EXPECT_TRUE(is_atlas(kNoise));
    const Atlas atlas(kNoise);
    for (std::size_t q = 0; q < queries_.size(); ++q) EXPECT_TRUE(queries_[q].ask(atlas) == right_[q]) << queries_[q].name;
    EXPECT_TRUE(memory_.content(kNoise) == before);
    EXPECT_EQ(memory_.count(), 1U);
    try {
        build_atlas("new.atlas", atlas.volume());
        ADD_FAILURE() << "built on a disk that is read-only";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::resource);
        EXPECT_NE(error.text().next.find("read-only"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace isoatlas

// Whatever fails while a store, a surface or labels are written: under the name is the old file (or nothing), or the new one, complete; no
// temporary file stays; the error says which file and what to do. The same after a power failure at any moment.
#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <functional>

#include "faults/faulty_files.h"
#include "faults/forwarding_files.h"
#include "faults/memory_files.h"
#include "isoatlas/atlas.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

using test::Fault;
using test::FaultyFiles;
using test::MemoryFiles;

constexpr const char* kOld = "what was there before";

struct Product {
    const char* name;
    const char* path;
    void (*write)(const std::string& path);
};

Volume small_volume() { return make_phantom("noise", {.size = 5, .quantise = 6}); }

void write_store(const std::string& path) {
    Context context;
    context.threads = 1;
    build_atlas(path, small_volume(), {}, context);
}

void write_mesh(const std::string& path) { (void)write_surface(path, extract(small_volume(), 2.5)); }

void write_some_labels(const std::string& path) {
    const Volume volume = small_volume();
    std::vector<std::uint32_t> labels(static_cast<std::size_t>(volume.info.extent.voxels()));
    for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = static_cast<std::uint32_t>(i % 7);
    write_labels(path, volume.info, labels);
}

constexpr Product kProducts[] = {{"store", "small.atlas", write_store},
                                 {"ply", "surface.ply", write_mesh},
                                 {"glb", "surface.glb", write_mesh},
                                 {"nrrd", "labels.nrrd", write_some_labels},
                                 {"tif", "labels.tif", write_some_labels}};

/// Operations that may fail without harm: permissions of the old file, cleaning up (what stays is used or replaced by the next build), a
/// look for finished phases.
bool can_do_without(const std::string& operation, bool is_store) {
    return operation == "set_mode" || (operation == "status" && is_store) || operation == "remove" || operation == "remove_folder";
}

/// What is written, and whether the disk has files without names.
struct Written {
    Product product;
    bool has_unnamed;
};

class WriteFaults : public testing::TestWithParam<Written> {
protected:
    WriteFaults() {
        MemoryFiles memory(has_unnamed_);
        (void)attempt(memory, {});
        right_ = memory.content(path_);
    }

    struct Outcome {
        bool done = false, reached = false;  ///< reached: the operation that was to fail was performed
        std::string failed;                  ///< its name
        std::int64_t operations = 0;
    };

    /// Writes the product on a disk with a fault; checks the error, if there is one.
    Outcome attempt(FileSystem& disk, const Fault& fault) {
        FaultyFiles faulty(fault, disk);
        const ReplacedFileSystem in_use(faulty);
        Outcome outcome;
        try {
            GetParam().product.write(path_);
            outcome.done = true;
        } catch (const Error& error) {
            const std::string& failed = faulty.failed();
            const bool is_read = failed == "read" || failed == "open" || failed == "status";  // of a finished phase
            EXPECT_TRUE(error.kind() == ErrorKind::resource || (is_read && error.kind() == ErrorKind::input)) << error.what();
            EXPECT_EQ(static_cast<int>(ErrorKind::resource), 5) << "docs/cli.md";
            EXPECT_TRUE(error.text().file.starts_with(path_)) << error.what();  // or the file of a phase: PATH.build/PHASE
            EXPECT_NE(error.text().what.find(std::strerror(fault.error)), std::string::npos) << error.what();
            EXPECT_FALSE(error.text().next.empty()) << error.what();
        }
        outcome.reached = faulty.has_failed();
        outcome.failed = faulty.failed();
        outcome.operations = faulty.operations();
        return outcome;
    }

    [[nodiscard]] bool is_old(const MemoryFiles& disk, bool was_there) const {
        return was_there ? disk.has(path_) && disk.content(path_) == kOld : !disk.has(path_);
    }
    [[nodiscard]] bool is_new(const MemoryFiles& disk) const { return disk.has(path_) && disk.content(path_) == right_; }

    std::string path_ = GetParam().product.path;
    bool has_unnamed_ = GetParam().has_unnamed;
    std::string right_;
};

TEST_P(WriteFaults, EveryOperationMayFail) {
    for (const bool was_there : {false, true}) {
        for (const int error : {EIO, ENOSPC}) {
            Outcome outcome{.reached = true, .failed = {}};
            std::int64_t at = 0;
            for (; outcome.reached; ++at) {
                MemoryFiles disk(has_unnamed_);
                if (was_there) disk.put(path_, kOld);
                outcome = attempt(disk, {.at = at, .error = error});
                const std::string when = "operation " + std::to_string(at) + ", " + outcome.failed;
                const bool may_be_ignored = !outcome.reached || can_do_without(outcome.failed, path_.ends_with(".atlas"));
                EXPECT_TRUE(!outcome.done || may_be_ignored) << when << " failed and nobody said so";
                EXPECT_TRUE(is_new(disk) || (!outcome.done && is_old(disk, was_there))) << when;
                EXPECT_FALSE(disk.has_like(".partial")) << when;
                EXPECT_TRUE(attempt(disk, {}).done && is_new(disk)) << "written again after " << when;
            }
            EXPECT_TRUE(outcome.done);
            EXPECT_GT(at, 6);
        }
    }
}

TEST_P(WriteFaults, ShortAndInterruptedWritesDoNotMatter) {
    for (const std::size_t max : {std::size_t{1}, std::size_t{13}, std::size_t{1000}}) {
        MemoryFiles disk(has_unnamed_);
        EXPECT_TRUE(attempt(disk, {.max = max}).done);
        EXPECT_TRUE(is_new(disk));
    }
}

TEST_P(WriteFaults, ADiskThatIsFullAtAnyByte) {
    const auto step = std::max<std::int64_t>(1, static_cast<std::int64_t>(right_.size()) / 200);
    for (std::int64_t after = 0; after < static_cast<std::int64_t>(right_.size()); after += step) {
        MemoryFiles disk(has_unnamed_);
        disk.put(path_, kOld);
        EXPECT_FALSE(attempt(disk, {.error = ENOSPC, .full_at = after}).done) << after;
        EXPECT_TRUE(is_old(disk, true)) << after;
        EXPECT_FALSE(disk.has_like(".partial")) << after;
    }
}

TEST_P(WriteFaults, PowerFailureAtEveryOperation) {
    using Loss = MemoryFiles::Loss;
    for (const bool was_there : {false, true}) {
        for (const Loss loss : {Loss::contents_and_names, Loss::contents, Loss::names, Loss::every_second_write}) {
            Outcome outcome{.reached = true, .failed = {}};
            for (std::int64_t at = 0; outcome.reached; ++at) {
                MemoryFiles disk(has_unnamed_);
                if (was_there) disk.put(path_, kOld);
                outcome = attempt(disk, {.at = at, .for_ever = true});  // nothing happens any more, until
                disk.fail_power(loss);
                const std::string when = "power failed before operation " + std::to_string(at) + ", " + outcome.failed;
                EXPECT_TRUE(is_new(disk) || is_old(disk, was_there)) << when;
                EXPECT_TRUE(!outcome.done || is_new(disk)) << "what was reported as written is lost: " << when;
                EXPECT_TRUE(attempt(disk, {}).done && is_new(disk)) << "written again after " << when;
                EXPECT_EQ(disk.count(), 1U) << "something was left by " << when;
            }
            EXPECT_TRUE(outcome.done);
        }
    }
}

TEST_P(WriteFaults, LinksAreFollowed) {
    class Linked final : public test::ForwardingFiles {  // "link" points to the file
    public:
        Linked(MemoryFiles& below, std::string target) : ForwardingFiles(below), target_(std::move(target)) {}
        FileStatus status_of_name(const std::string& path) override {
            return path == "link/" + target_ ? FileStatus{.kind = FileStatus::Kind::link} : ForwardingFiles::status_of_name(path);
        }
        std::string link(const std::string& path) override { return path == "link/" + target_ ? "../" + target_ : ""; }

    private:
        std::string target_;
    };
    MemoryFiles memory(has_unnamed_);
    Linked disk(memory, path_);
    const ReplacedFileSystem in_use(disk);
    EXPECT_THROW(GetParam().product.write("link/" + path_), Error) << "a link to nowhere";
    EXPECT_EQ(memory.count(), 0U);
    memory.put("link/../" + path_, kOld);
    GetParam().product.write("link/" + path_);
    EXPECT_EQ(memory.content("link/../" + path_), right_);
    EXPECT_EQ(memory.count(), 1U);
}

std::vector<Written> all_written() {
    std::vector<Written> all;
    for (const Product& product : kProducts) all.push_back({product, true});
    for (const Product& product : {kProducts[0], kProducts[1]}) all.push_back({product, false});
    return all;
}

INSTANTIATE_TEST_SUITE_P(Products, WriteFaults, testing::ValuesIn(all_written()), [](const auto& written) {
    return std::string(written.param.product.name) + (written.param.has_unnamed ? "" : "_with_names");
});

TEST(BuiltStore, IsSoundAfterAPowerFailure) {
    MemoryFiles disk;
    const ReplacedFileSystem in_use(disk);
    const Volume volume = make_phantom("noise", {.size = 20, .quantise = 32});
    build_atlas("noise.atlas", volume);
    disk.fail_power(MemoryFiles::Loss::contents_and_names);
    const Atlas atlas("noise.atlas");
    atlas.check();
    EXPECT_TRUE(atlas.volume().bytes == volume.bytes);
}

// A store has one folder for its build, whatever it is called, and one process at a time in it.
TEST(BuiltStore, IsBuiltByOneAtATime) {
    MemoryFiles disk;
    const ReplacedFileSystem in_use(disk);
    ASSERT_EQ(disk.make_folder("small.atlas.build"), 0);
    const OpenedFile other = disk.lock("small.atlas.build/lock");
    try {
        write_store("small.atlas");
        ADD_FAILURE() << "two at once";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::resource);
        EXPECT_NE(error.text().what.find("another process"), std::string::npos) << error.what();
        EXPECT_TRUE(disk.has("small.atlas.build/lock")) << "the lock of the other one was removed";
    }
}

}  // namespace
}  // namespace isoatlas

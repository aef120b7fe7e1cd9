// A damaged store: every beginning of it, every flipped bit of small ones and every changed byte of a larger one are found by check(), and
// refused by whoever reads them; other answers are those of the intact store, byte for byte.
#include <gtest/gtest.h>

#include <algorithm>

#include "faults/forwarding_files.h"
#include "faults/memory_files.h"
#include "faults/store_queries.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

using test::Query;

constexpr const char* kPath = "small.atlas";

/// Remembers which bytes were read.
class WatchedFiles final : public test::ForwardingFiles {
public:
    explicit WatchedFiles(FileSystem& below) : ForwardingFiles(below) {}
    OpenedFile open(const std::string& path) override { return {std::make_unique<Watched>(ForwardingFiles::open(path).file, was_read), 0}; }
    std::vector<bool> was_read;

private:
    class Watched final : public File {
    public:
        Watched(std::unique_ptr<File> file, std::vector<bool>& was_read) : file_(std::move(file)), was_read_(was_read) {
            was_read_.resize(static_cast<std::size_t>(file_->size()));
        }
        std::int64_t size() const override { return file_->size(); }
        std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
            const std::ptrdiff_t count = file_->read_at(offset, out);
            std::fill_n(was_read_.begin() + offset, std::max<std::ptrdiff_t>(count, 0), true);
            return count;
        }

    private:
        std::unique_ptr<File> file_;
        std::vector<bool>& was_read_;
    };
};

/// A store on a disk in memory, what can be asked of it, the answers, and the bytes that each answer was made of.
class Damaged : public testing::Test {
protected:
    Damaged() : in_use_(memory_) {}

    void build(const Volume& volume, double tau, std::int64_t voxel) {
        build_atlas(kPath, volume);
        for (Query& query : test::queries(tau, voxel)) {
            WatchedFiles watched(memory_);
            const ReplacedFileSystem in_use(watched);
            answers_.push_back({query, query.ask(Atlas(kPath)), std::move(watched.was_read)});
        }
    }

    /// Asks what may depend on a byte: what was made without reading it cannot change. Every query must be refused or answered right;
    /// the file is still told to be a store. Returns whether check() has found it.
    bool is_found_after_change_of(std::size_t at) {
        EXPECT_TRUE(is_atlas(kPath)) << "byte " << at;
        const std::string when = "byte " + std::to_string(at);
        try {
            (void)Atlas(kPath);
        } catch (const Error&) {  // then it says so whatever is asked
            return is_refused_or_right(answers_.back(), when);
        }
        bool found = false;  // by the last one, which is check()
        for (const Answered& a : answers_) found = a.was_read[at] && is_refused_or_right(a, when);
        return found;
    }

    /// Asks everything. Returns whether every query was refused.
    bool is_refused(const std::string& when) {
        bool refused = true;
        for (const Answered& a : answers_) refused = is_refused_or_right(a, when) && refused;
        return refused;
    }

    [[nodiscard]] std::size_t size() const { return memory_.content(kPath).size(); }

    void change_every_bit() {
        std::string& content = memory_.content(kPath);
        for (std::size_t bit = 0; bit < 8 * content.size() && !HasFailure(); ++bit) {
            const auto flip = [&] { content[bit / 8] = static_cast<char>(content[bit / 8] ^ 1 << bit % 8); };
            flip();
            EXPECT_TRUE(is_found_after_change_of(bit / 8)) << "bit " << bit << " was changed, and no checksum says so";
            if (bit % 509 == 0) is_refused("bit " + std::to_string(bit));
            flip();
        }
        EXPECT_FALSE(is_refused("mended"));
    }

    void change_every_byte() {
        std::string& content = memory_.content(kPath);
        for (std::size_t at = 0; at < content.size() && !HasFailure(); ++at) {
            const auto change = static_cast<char>(1 + at * 2654435761U % 255);
            content[at] = static_cast<char>(content[at] ^ change);
            EXPECT_TRUE(is_found_after_change_of(at)) << "byte " << at << " was changed, and no checksum says so";
            if (at % 509 == 0) is_refused("byte " + std::to_string(at));
            content[at] = static_cast<char>(content[at] ^ change);
        }
        EXPECT_FALSE(is_refused("mended"));
    }

    void cut_everywhere() {
        const std::string whole = memory_.content(kPath);
        for (std::size_t size = whole.size(); size-- > 0 && !HasFailure();) {
            memory_.content(kPath).resize(size);
            EXPECT_TRUE(is_refused("cut at " + std::to_string(size))) << size;
        }
        memory_.put(kPath, whole + '\0');
        EXPECT_TRUE(is_refused("a byte more"));
        memory_.put(kPath, whole);
        EXPECT_FALSE(is_refused("mended"));
    }

private:
    struct Answered {
        Query query;
        std::string right;
        std::vector<bool> was_read;
    };

    static bool is_refused_or_right(const Answered& a, const std::string& when) {
        try {
            EXPECT_TRUE(a.query.ask(Atlas(kPath)) == a.right) << a.query.name << ": a wrong answer; " << when;
            return false;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << when << ": " << error.what();
            EXPECT_EQ(error.text().file, kPath) << when << ": " << error.what();
            EXPECT_FALSE(error.text().next.empty()) << when << ": " << error.what();
            return true;
        }
    }

    test::MemoryFiles memory_;
    ReplacedFileSystem in_use_;
    std::vector<Answered> answers_;
};

/// The volume of docs/format.md: ones, with a 0 in the middle and a 3 above it.
Volume documented_volume() {
    Volume volume = make_volume({3, {3, 3, 3}}, ValueType::u8, {});
    std::fill(volume.bytes.begin(), volume.bytes.end(), std::byte{1});
    volume.bytes[13] = std::byte{0};
    volume.bytes[22] = std::byte{3};
    return volume;
}

TEST_F(Damaged, ThreeByThreeByThree) {
    build(documented_volume(), 1, 0);
    cut_everywhere();
    change_every_bit();
}

TEST_F(Damaged, Image) {
    Volume volume = make_phantom("noise", {.size = 18, .noise = 0.1});  // float samples
    volume.info.extent = {2, {18, 18, 1}};
    volume.bytes.resize(static_cast<std::size_t>(volume.info.extent.voxels()) * size_of(volume.info.type));
    build(volume, 0.5, cut(volume, 0.5).objects.at(0).id);
    change_every_byte();
}

TEST_F(Damaged, TwentyByTwentyByTwenty) {
    const Volume volume = make_phantom("nested-shells", {.size = 20, .shells = 1, .noise = 0.005, .quantise = 100});
    EXPECT_GT(analyse(volume).element_count(), 1024) << "some arrays are to be compressed";
    build(volume, 50, cut(volume, 50).objects.at(0).id);
    cut_everywhere();
    change_every_byte();
}

}  // namespace
}  // namespace isoatlas

// A disk that lets one wait is told what will be read before it is read, once, and nothing else; what is in memory is just read.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cerrno>
#include <map>
#include <memory>
#include <numeric>
#include <random>

#include "faults/forwarding_files.h"
#include "faults/memory_files.h"
#include "isoatlas/phantom.h"
#include "store/brick_reader.h"
#include "store/brick_writer.h"

namespace isoatlas {
namespace {

constexpr const char* kPath = "slow.atlas";

/// What has happened to the bytes of a file.
struct Disk {
    std::vector<bool> present, prefetched;
    bool is_surprised = false;          ///< was it read where it had to wait and was not told before?
    bool is_asked_again = false;        ///< was it told of a byte twice?
    bool is_asked_for_nothing = false;  ///< which a system takes for all that follows
    std::int64_t expectations = 0;
};

class SlowFiles final : public test::ForwardingFiles {
public:
    SlowFiles(FileSystem& below, Disk& disk) : ForwardingFiles(below), disk_(disk) {}
    OpenedFile open(const std::string& path) override { return {std::make_unique<Slow>(ForwardingFiles::open(path).file, disk_), 0}; }

private:
    class Slow final : public File {
    public:
        Slow(std::unique_ptr<File> file, Disk& disk) : file_(std::move(file)), disk_(disk) {
            disk_.present.assign(static_cast<std::size_t>(size()), false);
            disk_.prefetched = disk_.present;
        }
        std::int64_t size() const override { return file_->size(); }
        std::ptrdiff_t read_nowait(std::int64_t offset, std::span<std::byte> out) override {
            const std::size_t there = count_from(disk_.present, offset, out.size());
            return there == 0 ? -EAGAIN : file_->read_at(offset, out.first(there));
        }
        void prefetch(std::int64_t offset, std::int64_t bytes) override {
            ++disk_.expectations;
            disk_.is_asked_for_nothing |= bytes <= 0;
            for (std::int64_t at = offset; at < offset + bytes; ++at) {
                auto prefetched = disk_.prefetched[static_cast<std::size_t>(at)];
                disk_.is_asked_again |= prefetched;
                prefetched = true;
            }
        }
        std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
            disk_.is_surprised |= count_from(disk_.prefetched, offset, out.size()) < out.size();
            std::fill_n(disk_.present.begin() + offset, out.size(), true);
            return file_->read_at(offset, out);
        }

    private:
        static std::size_t count_from(const std::vector<bool>& bytes, std::int64_t offset, std::size_t max) {
            const auto first = bytes.begin() + offset;
            return static_cast<std::size_t>(std::find(first, first + static_cast<std::ptrdiff_t>(max), false) - first);
        }
        std::unique_ptr<File> file_;
        Disk& disk_;
    };
    Disk& disk_;
};

/// The store of a phantom at kPath, made once.
test::MemoryFiles& store_of(const std::string& phantom) {
    static std::map<std::string, test::MemoryFiles> made;
    const auto [at, is_new] = made.try_emplace(phantom);
    if (is_new) {
        const ReplacedFileSystem in_use(at->second);
        const Volume volume = make_phantom(phantom, {.size = 120, .quantise = 256});
        Contents contents;
        contents.volume = volume.info;
        pack_store(kPath, contents, brick_arrays(volume, {}));
    }
    return at->second;
}

RC_GTEST_PROP(ExpectedReads, AreThoseThatCome, ()) {
    test::MemoryFiles& memory = store_of(*rc::gen::element<std::string>("noise", "nested-shells"));  // without and with bricks of one value
    Disk disk;
    SlowFiles slow(memory, disk);
    const ReplacedFileSystem is_slow(slow);
    const Container store(kPath);
    const BrickReader<std::uint8_t> reader(store);
    std::vector<BrickId> bricks;
    for (const BrickId brick : reader.grid().bricks()) bricks.push_back(brick);
    const int kept = *rc::gen::element(1, 3, 30, 100);     // of a hundred
    std::mt19937 random(*rc::gen::arbitrary<unsigned>());  // one number: thousands would take hours to shrink
    std::erase_if(bricks, [&](BrickId) { return static_cast<int>(random() % 100) >= kept; });
    std::fill(disk.present.begin(), disk.present.end(), false);
    disk = {disk.present, disk.present};

    Context alone;
    alone.threads = 1;
    const auto sum_of = [&](IoCounters& counters) {
        std::int64_t sum = 0;
        counters = reader.read(bricks, alone, [&](BrickId brick, std::span<const std::uint8_t> samples) {
            sum = std::accumulate(samples.begin(), samples.end(), sum + brick.number());
        });
        return sum;
    };
    IoCounters first, second;
    const std::int64_t sum = sum_of(first);
    RC_ASSERT(!disk.is_surprised);
    RC_ASSERT(!disk.is_asked_again);
    RC_ASSERT(!disk.is_asked_for_nothing);
    RC_ASSERT(disk.expectations <= first.extents);
    RC_ASSERT(first.bytes == 0 || disk.expectations > 0);
    const auto asked = std::count(disk.prefetched.begin(), disk.prefetched.end(), true);
    RC_ASSERT(asked <= first.bytes + 16384 * (first.extents - disk.expectations));
    disk.expectations = 0;
    RC_ASSERT(sum_of(second) == sum);
    RC_ASSERT(disk.expectations == 0);
    RC_ASSERT(second.bytes == first.bytes);
}

}  // namespace
}  // namespace isoatlas

// Environments live beside each other: each thread, and those that work for it, has its own budget, scratch file and files.
#include "isoatlas/environment.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <latch>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include "base/big_vector.h"
#include "base/file_system.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/streamed.h"
#include "base/workers.h"
#include "faults/forwarding_files.h"
#include "isoatlas/context.h"

namespace isoatlas {
namespace {

using Numbers = BigVector<std::uint64_t>;
constexpr std::size_t kNumbers = std::size_t{1} << 18;  // two megabytes: more than what stays in memory anyway
constexpr std::int64_t kBytes = kNumbers * sizeof(std::uint64_t);

/// A line of /proc/self/maps, and how much of the mapping is resident.
struct Mapping {
    std::string file;
    std::int64_t resident = 0;
};
Mapping mapping_of(const void* memory) {
    std::ifstream maps("/proc/self/smaps");
    const auto at = reinterpret_cast<std::uintptr_t>(memory);
    Mapping found;
    bool here = false;
    for (std::string line; std::getline(maps, line);) {
        std::istringstream words(line);
        std::uintptr_t begin = 0, end = 0;
        char dash = 0;
        std::string mode, offset, device, inode;
        if (words >> std::hex >> begin >> dash >> end >> mode >> offset >> device >> inode) {
            if (here) return found;
            here = begin <= at && at < end;
            if (here) words >> found.file;
        } else if (here && line.starts_with("Rss:")) {
            found.resident = std::stoll(line.substr(4)) * 1024;
        }
    }
    return found;
}

class Environments : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(folder("one"));
        std::filesystem::create_directories(folder("two"));
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    [[nodiscard]] std::string folder(const std::string& name) const { return (folder_ / name).string(); }

    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / ("isoatlas_environments_" + std::to_string(::getpid()));
};

TEST_F(Environments, ArraysOfTwoThreadsLieInTwoFiles) {
    MemoryBudget one(kMinMemory, folder("one")), two(2 * kMinMemory, folder("two"));
    std::latch both_have_arrays(2), both_have_looked(2);
    const auto work = [&](MemoryBudget& own, const MemoryBudget& other, const std::string& own_folder, std::uint64_t value) {
        const EnvironmentScope scope(Environment{.memory = &own});
        EXPECT_EQ(memory_limit(), own.bytes());
        EXPECT_EQ(memory_at_random(), own.max_at_random());
        const Numbers numbers(kNumbers, value);
        both_have_arrays.arrive_and_wait();
        EXPECT_TRUE(is_scratch(numbers.data()));
        EXPECT_TRUE(own.holds(numbers.data()));
        EXPECT_TRUE(own.holds(&numbers.back()));
        EXPECT_FALSE(other.holds(numbers.data()));
        EXPECT_EQ(own.scratch_bytes(), kBytes);
        EXPECT_EQ(other.scratch_bytes(), kBytes);
        EXPECT_TRUE(mapping_of(numbers.data()).file.starts_with(own_folder)) << mapping_of(numbers.data()).file;
        std::uint64_t read = 0;
        read_scratch(&numbers[kNumbers / 2], std::as_writable_bytes(std::span(&read, 1)));
        EXPECT_EQ(read, value);
        both_have_looked.arrive_and_wait();
    };
    std::thread thread([&] { work(two, one, folder("two"), 2); });
    work(one, two, folder("one"), 1);
    thread.join();
    EXPECT_EQ(one.scratch_bytes(), 0);
    EXPECT_FALSE(memory_is_limited());
    EXPECT_TRUE(process_is_limited());
    const Numbers outside(kNumbers, 3);  // in no budget: this thread is in none
    EXPECT_FALSE(is_scratch(outside.data()));
}

TEST_F(Environments, EachHasItsOwnBytesForWhatIsAccessedAtRandom) {
    MemoryBudget one(kMinMemory, folder("one")), two(kMinMemory, folder("two"));
    const EnvironmentScope scope(Environment{.memory = &one});
    const PinInMemory pin;
    std::optional<Numbers> first(std::in_place, static_cast<std::size_t>(one.max_at_random()) / sizeof(std::uint64_t));
    EXPECT_FALSE(one.holds(first->data()));
    EXPECT_EQ(one.bytes_at_random(), one.max_at_random());
    const Numbers second(kNumbers);
    EXPECT_TRUE(one.holds(second.data())) << "no room is left";
    {
        const EnvironmentScope other(Environment{.memory = &two});
        const Numbers not_pinned(kNumbers);
        EXPECT_TRUE(two.holds(not_pinned.data())) << "what is pinned belongs to the other budget";
        const PinInMemory pin_here;
        const Numbers pinned(kNumbers);
        EXPECT_FALSE(is_scratch(pinned.data()));
        EXPECT_EQ(two.bytes_at_random(), kBytes);
        const Numbers same_size_again(kNumbers);
        EXPECT_EQ(two.bytes_at_random(), 2 * kBytes);
    }
    EXPECT_EQ(two.bytes_at_random(), 0);
    EXPECT_EQ(one.bytes_at_random(), one.max_at_random());
    std::thread([&] { first.reset(); }).join();  // from any thread
    EXPECT_EQ(one.bytes_at_random(), 0);
    const Numbers third(kNumbers);
    EXPECT_FALSE(is_scratch(third.data()));
}

TEST_F(Environments, ArraysOutliveTheirBudget) {
    std::optional<MemoryBudget> one(std::in_place, kMinMemory, folder("one"));
    std::optional<Numbers> numbers, kept;
    {
        const EnvironmentScope scope(Environment{.memory = &*one});
        numbers.emplace(kNumbers);
        const PinInMemory pin;
        kept.emplace(kNumbers);
    }
    std::iota(numbers->begin(), numbers->end(), std::uint64_t{0});
    one.reset();
    EXPECT_FALSE(process_is_limited());
    EXPECT_TRUE(is_scratch(numbers->data()));
    MemoryBudget two(kMinMemory, folder("two"));
    EXPECT_FALSE(two.holds(numbers->data()));
    std::thread([&] {
        const EnvironmentScope scope(Environment{.memory = &two});
        for (std::size_t i = 0; i < kNumbers; ++i) ASSERT_EQ((*numbers)[i], i);
        const void* const was_at = numbers->data();
        numbers.reset();
        kept.reset();
        EXPECT_FALSE(is_scratch(was_at));
    }).join();
    EXPECT_EQ(two.scratch_bytes(), 0);
    EXPECT_EQ(two.bytes_at_random(), 0);
}

TEST_F(Environments, GoWithTheWorkToAllThreads) {
    MemoryBudget one(kMinMemory, folder("one")), two(kMinMemory, folder("two"));
    std::latch together(2);
    std::atomic<std::int64_t> wrong = 0, blocks = 0;
    const auto work = [&](MemoryBudget* own) {
        const EnvironmentScope scope(Environment{.memory = own});
        const auto look = [&] {
            ++blocks;
            wrong += current_environment().memory != own;
        };
        together.arrive_and_wait();
        for_each_block(4, 200, [&](std::int64_t) {
            look();
            for_each_block(4, 8, [&](std::int64_t) { look(); });  // a thread that waits here may do blocks of the other analysis
            look();
        });
        run_both(4, look, look);
        with_threads(4, look);
        Workers workers(2);
        ASSERT_TRUE(workers.post(look));
        workers.wait();
        EXPECT_THROW(for_each_block(4, 20, [](std::int64_t) { throw std::runtime_error("thrown in a block"); }), std::runtime_error);
        look();
    };
    std::thread thread([&] { work(&two); });
    work(&one);
    thread.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(blocks, 2 * (200 * 10 + 2 + 1 + 1 + 1));
    EXPECT_EQ(current_environment().memory, nullptr);
}

TEST_F(Environments, AContextCarriesThem) {
    MemoryBudget one(kMinMemory, folder("one"));
    const Environment environment{.memory = &one, .threads = 3};
    Context context;
    {
        const EnvironmentScope scope(context);
        EXPECT_FALSE(memory_is_limited());
    }
    context.environment = &environment;
    const EnvironmentScope scope(context);
    EXPECT_EQ(memory_limit(), kMinMemory);
    EXPECT_EQ(thread_count(0), 3);
    EXPECT_EQ(thread_count(2), 2);
    const EnvironmentScope same(Context{});
    EXPECT_EQ(memory_limit(), kMinMemory);
}

TEST_F(Environments, ABudgetInForceIsNotCountedTwice) {
    MemoryBudget one(2 * kMinMemory, folder("one"));
    const EnvironmentScope scope(Environment{.memory = &one});
    const MemoryLimit limit(kMinMemory, folder("two"));
    EXPECT_EQ(memory_limit(), 2 * kMinMemory);
    const Numbers numbers(kNumbers);
    EXPECT_TRUE(one.holds(numbers.data()));
}

/// Every path is one of a disk that fails.
class BrokenDisk final : public test::ForwardingFiles {
public:
    OpenedFile open(const std::string&) override { return {nullptr, -EIO}; }
};

TEST_F(Environments, AFailingDiskFailsInItsOwnOnly) {
    const std::string path = folder("one") + "/file";
    std::ofstream(path) << "content";
    BrokenDisk broken;
    std::latch is_in_use(2), both_have_looked(2);
    std::thread thread([&] {
        const ReplacedFileSystem in_use(broken);
        is_in_use.arrive_and_wait();
        std::atomic<int> failed = 0;
        for_each_block(2, 16, [&](std::int64_t) { failed += file_system().open(path).error == -EIO; });
        EXPECT_EQ(failed, 16);
        both_have_looked.arrive_and_wait();
    });
    is_in_use.arrive_and_wait();
    for_each_block(2, 16, [&](std::int64_t) { EXPECT_NE(file_system().open(path).file, nullptr); });
    both_have_looked.arrive_and_wait();
    thread.join();
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take memory of their own
TEST_F(Environments, TheLargerMakesRoomAndTheOneThatFitsStays) {
    MemoryBudget one(kMinMemory, folder("one")), two(kMinMemory, folder("two"));
    const EnvironmentScope scope(Environment{.memory = &one});
    const Numbers fits(kNumbers, 1);
    const EnvironmentScope other(Environment{.memory = &two});
    Numbers large(static_cast<std::size_t>(3 * kMinMemory) / sizeof(std::uint64_t));
    std::int64_t max = 0;
    for (const std::size_t i : streamed(large.size(), in_order(1))) {
        large[i] = i;
        if (i % (8 * kNumbers) == 0) max = std::max(max, mapping_of(large.data()).resident);
    }
    EXPECT_LT(max, 2 * kMinMemory);
    EXPECT_GT(max, kMinMemory) << "what the other budget leaves may be used";
    EXPECT_EQ(mapping_of(fits.data()).resident, kBytes);
}
#endif

}  // namespace
}  // namespace isoatlas

// Two builds with two budgets in one process, at the same time: the same stores, and the process stays within the sum of the budgets.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <latch>
#include <thread>

#include "base/memory_limit.h"
#include "isoatlas/build.h"
#include "isoatlas/environment.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // which take more than small budgets, and build without end then
constexpr std::int64_t kSmaller = std::int64_t{2} << 30, kLarger = std::int64_t{3} << 30;
#else
constexpr std::int64_t kSmaller = kMinMemory, kLarger = 96 << 20;
#endif

class TwoBudgets : public testing::Test {
protected:
    void SetUp() override {
        GTEST_FLAG_SET(death_test_style, "threadsafe");  // starts this program again, whose memory nobody has used
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] bool is_same(const std::string& name, const std::string& other) const {
        std::ifstream one(path(name), std::ios::binary), two(path(other), std::ios::binary);
        using Bytes = std::istreambuf_iterator<char>;
        return one && two && std::equal(Bytes(one), Bytes{}, Bytes(two), Bytes{});
    }
    void build(const std::string& name, std::int64_t memory, const Context& context) const {
        const auto reader = open_volume(path("noise.nrrd"), {});
        BuildOptions options;
        options.memory = memory;
        build_atlas(path(name), *reader, options, context);
    }
    /// Both at the same time: each waits in its phase "basins" for the other.
    void build_both(const Environment* one, const Environment* two) const {
        std::latch both_have_begun(2);
        const auto run = [&](const std::string& name, std::int64_t memory, const Environment* environment) {
            Context context;
            context.threads = 1;
            context.environment = environment;
            context.progress = [&, waits = true](const Progress& progress) mutable {
                if (waits && progress.phase == "basins") waits = false, both_have_begun.arrive_and_wait();
            };
            build(name, memory, context);
        };
        std::thread thread([&] { run("larger", kLarger, two); });
        run("smaller", kSmaller, one);
        thread.join();
    }
    [[noreturn]] void report_and_exit() const {
        const std::int64_t peak = peak_memory(), most = (kSmaller + kLarger) / 10 * 11;
        const bool is_within = peak < most;
        std::fprintf(stderr, "peak %lld of %lld%s%s\n", static_cast<long long>(peak), static_cast<long long>(most),
                     is_within ? ", within" : ", TOO MUCH", process_is_limited() ? ", LIMITED" : ", ended");
        std::exit(0);
    }

    /// Of this run; the second starts of the program find it in the environment.
    static std::string own_folder() {
        constexpr const char* kVariable = "ISOATLAS_TWO_BUDGETS";
        if (const char* known = std::getenv(kVariable)) return known;
        std::string name = testing::TempDir() + "isoatlas_two_budgets_" + std::to_string(::getpid());
        ::setenv(kVariable, name.c_str(), 1);
        return name;
    }

    std::filesystem::path folder_ = own_folder();
};

TEST_F(TwoBudgets, GiveTheSameStoresAndKeepTheirSum) {
    if (!std::filesystem::exists(path("expected"))) {  // else it is the second start
        PhantomOptions options;
        options.size = 128;
        options.quantise = 200;
        write_volume(path("noise.nrrd"), make_phantom("noise", options));
        build("expected", std::int64_t{1} << 40, {});
    }
    const auto builds = [this] {
        build_both(nullptr, nullptr);
        report_and_exit();
    };
    EXPECT_EXIT(builds(), testing::ExitedWithCode(0), "within, ended");
    EXPECT_TRUE(is_same("smaller", "expected"));
    EXPECT_TRUE(is_same("larger", "expected"));

    // The same budgets, of environments that contexts carry: options.memory is of no meaning then.
    const auto in_environments = [this] {
        {
            MemoryBudget smaller(kSmaller, folder_.string()), larger(kLarger, folder_.string());
            const Environment one{.memory = &smaller}, two{.memory = &larger};
            build_both(&one, &two);
        }
        report_and_exit();
    };
    EXPECT_EXIT(in_environments(), testing::ExitedWithCode(0), "within, ended");
    EXPECT_TRUE(is_same("smaller", "expected"));
    EXPECT_TRUE(is_same("larger", "expected"));
}

}  // namespace
}  // namespace isoatlas

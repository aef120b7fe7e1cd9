// The same store, byte for byte, for any memory, number of threads and slab size, and when several are built in one process at once.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <utility>

#include "base/memory_limit.h"
#include "isoatlas/build.h"
#include "isoatlas/output.h"
#include "isoatlas/phantom.h"

namespace isoatlas {
namespace {

class Builds : public testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directories(folder_);
        PhantomOptions options;
        options.size = 64;
        options.quantise = 200;
        write_volume(path("noise.nrrd"), make_phantom("noise", options));
        expected_ = built("expected", std::int64_t{1} << 40, 1, 0);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] std::string built(const std::string& name, std::int64_t memory, int threads, std::int64_t slab_slices) const {
        const auto reader = open_volume(path("noise.nrrd"), {});
        BuildOptions options;
        options.memory = memory;
        Context context;
        context.threads = threads;
        context.slab_slices = slab_slices;
        build_atlas(path(name), *reader, options, context);
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / ("isoatlas_builds_" + std::to_string(::getpid()));
    std::string expected_;
};

TEST_F(Builds, InAnyMemory) {
    constexpr std::pair<int, int> kThreadsAndSlabs[] = {{1, 1}, {1, 40}, {2, 0}, {2, 7}, {3, 1}, {3, 7}};
    for (const auto& [threads, slab] : kThreadsAndSlabs) {
        EXPECT_TRUE(built("one", kMinMemory, threads, slab) == expected_) << threads << " threads, slabs of " << slab;
    }
}

TEST_F(Builds, SeveralAtOnce) {
    std::vector<std::future<std::string>> builds;
    for (const std::int64_t megabytes : {80, 96, 1000, 80}) {
        const std::string name = "at_once_" + std::to_string(builds.size());
        builds.push_back(std::async(std::launch::async, [this, name, megabytes] { return built(name, megabytes << 20, 1, 0); }));
    }
    for (std::future<std::string>& build : builds) EXPECT_TRUE(build.get() == expected_);
    EXPECT_FALSE(memory_is_limited());
}

}  // namespace
}  // namespace isoatlas

// Every search finds the active cells of brute force in real volumes, at 10 isovalues: half of them samples. Of large volumes the middle,
// 32 samples a side; ISOATLAS_ALL_DATA=1 takes all of them whole, at 50 isovalues (142 million cells; 20 minutes in a release build).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "isoatlas/cell_search.h"
#include "isoatlas/volume.h"
#include "unit/methods/searches.h"

namespace oracle {
namespace {

namespace fs = std::filesystem;
using isoatlas::CellId;
using isoatlas::CellSearchCost;

const bool kAllData = std::getenv("ISOATLAS_ALL_DATA") != nullptr;

isoatlas::Volume middle(const fs::path& path, bool has_steps) {
    isoatlas::OpenOptions options;
    if (has_steps) options.time_step = 0;
    if (kAllData) return isoatlas::load_volume(path.string(), options);
    const isoatlas::Extent extent = isoatlas::open_volume(path.string(), options)->info().extent;
    isoatlas::SampleBox& box = options.box.emplace();
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t size = extent.size[axis], kept = std::min<std::int64_t>(size, 32);
        box.begin[axis] = (size - kept) / 2;
        box.end[axis] = box.begin[axis] + kept;
    }
    return isoatlas::load_volume(path.string(), options);
}

/// Removed at the end.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "isoatlas-searches-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    [[nodiscard]] std::string prefix() const { return (path_ / "").string(); }

private:
    fs::path path_;
};

std::vector<double> isovalues(const isoatlas::Volume& volume) {
    std::vector<double> samples;
    for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) samples.push_back(volume.value(i));
    std::sort(samples.begin(), samples.end());
    std::vector<double> taus;
    const std::size_t of_each_kind = kAllData ? 25 : 5;
    for (std::size_t i = 1; i <= of_each_kind; ++i) {
        taus.push_back(samples[(samples.size() - 1) * i / of_each_kind]);
        taus.push_back(samples.front() +
                       (samples.back() - samples.front()) * static_cast<double>(i) / static_cast<double>(of_each_kind + 1));
    }
    return taus;
}

TEST(SharedVolumes, HaveTheActiveCellsOfBruteForce) {
    const fs::path data = fs::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data";
    if (!fs::exists(data / "stats.json")) GTEST_SKIP() << "no shared data beside the checkout";
    const nlohmann::json stats = nlohmann::json::parse(std::ifstream(data / "stats.json"));
    int checked = 0;
    for (const auto& [name, entry] : stats.items()) {
        if (entry["kind"] != "grid" || entry["dims"].size() < 3) continue;
        const isoatlas::Volume volume = middle(data / name, entry["dims"].size() > 3);
        const std::unique_ptr<isoatlas::CellSearch> brute_force = isoatlas::make_cell_search(isoatlas::SearchMethod::brute_force, volume);
        const TemporaryFolder folder;
        const std::vector<double> taus = isovalues(volume);
        CellSearchCost cost;
        std::vector<std::vector<CellId>> expected;
        for (const double tau : taus) expected.push_back(found(*brute_force, tau, cost));
        for (const auto& [method, make] : search_makers(volume, folder.prefix())) {  // one at a time: whole volumes are large
            const std::unique_ptr<isoatlas::CellSearch> search = make();
            for (std::size_t i = 0; i < taus.size(); ++i)
                ASSERT_TRUE(found(*search, taus[i], cost) == expected[i]) << method << " at " << taus[i] << " in " << name;
        }
        std::cout << "  " << name << ": " << volume.info.extent.voxels() << " samples, " << taus.size() << " isovalues\n" << std::flush;
        ++checked;
    }
    RecordProperty("volumes", checked);
    EXPECT_GE(checked, 41);
}

}  // namespace
}  // namespace oracle

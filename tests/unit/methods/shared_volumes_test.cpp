// Every search finds the active cells of brute force in real volumes, at 50 isovalues: half of them samples. Of large volumes the middle,
// 32 samples a side; ISOATLAS_ALL_DATA=1 takes all of them whole (an hour).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "isoatlas/filter.h"
#include "isoatlas/volume.h"
#include "unit/methods/searches.h"

namespace oracle {
namespace {

namespace fs = std::filesystem;
using isoatlas::CellId;
using isoatlas::CellSearchCost;

isoatlas::Volume middle(const fs::path& path, bool has_steps) {
    isoatlas::OpenOptions options;
    if (has_steps) options.time_step = 0;
    isoatlas::Volume volume = isoatlas::load_volume(path.string(), options);
    if (std::getenv("ISOATLAS_ALL_DATA") != nullptr) return volume;
    isoatlas::SampleBox box;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t size = volume.info.extent.size[axis], kept = std::min<std::int64_t>(size, 32);
        box.begin[axis] = (size - kept) / 2;
        box.end[axis] = box.begin[axis] + kept;
    }
    return isoatlas::crop(volume, box);
}

std::vector<double> isovalues(const isoatlas::Volume& volume) {
    std::vector<double> samples;
    for (std::int64_t i = 0; i < volume.info.extent.voxels(); ++i) samples.push_back(volume.value(i));
    std::sort(samples.begin(), samples.end());
    std::vector<double> taus;
    for (std::size_t i = 1; i <= 25; ++i) {
        taus.push_back(samples[(samples.size() - 1) * i / 25]);
        taus.push_back(samples.front() + (samples.back() - samples.front()) * static_cast<double>(i) / 26);
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
        Searches searches(volume);
        for (const double tau : isovalues(volume)) {
            CellSearchCost cost;
            const std::vector<CellId> expected = found(*searches.all().front().search, tau, cost);  // brute force
            for (const auto& [method, search] : searches.all())
                ASSERT_TRUE(found(*search, tau, cost) == expected) << method << " at " << tau << " in " << name;
        }
        ++checked;
    }
    RecordProperty("volumes", checked);
    EXPECT_GE(checked, 41);
}

}  // namespace
}  // namespace oracle

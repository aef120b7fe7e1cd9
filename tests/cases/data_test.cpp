// Real volumes: the number of regional maxima that scikit-image and SciPy counted (stats.json), and one head stored along four axis orders.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "isoatlas/analysis.h"
#include "isoatlas/volume.h"
#include "oracle/compare.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

fs::path shared_data() { return fs::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data"; }

/// Maxima of the analysis, counted in two ways: events without children, and levels into which no contour comes.
struct Maxima {
    std::int64_t events = 0, levels = 0;
};

Maxima count_maxima(const Analysis& analysis) {
    Maxima maxima;
    for (const EventId i : ids<EventId>(analysis.event_count())) maxima.events += analysis.event(i).objects_in == 0 ? 1 : 0;
    for (std::int64_t i = 0; i < analysis.level_count(); ++i) maxima.levels += analysis.level(i).in.empty() ? 1 : 0;
    return maxima;
}

/// Fill values of 1e20 become 1000, which is still above all data: beside 1e20 the value of a face point rounds to that of its lower High,
/// and a maximum there would merge at its own value.
Volume load(const fs::path& path, double highest) {
    MissingPolicy policy;
    if (highest > 1e19) {
        policy.action = MissingPolicy::Action::replace;
        policy.value = 1000;
        policy.no_data = static_cast<double>(1e20f);
    }
    return load_volume(path.string(), {}, policy);
}

TEST(Data, NumberOfMaximaIsThatOfStatsJson) {
    if (!fs::exists(shared_data() / "stats.json")) GTEST_SKIP() << "no shared data beside the checkout";
    // ISOATLAS_MAX_VOXELS=100000000 takes the two large benchmarks along.
    const char* limit = std::getenv("ISOATLAS_MAX_VOXELS");
    const std::int64_t max = limit ? std::atoll(limit) : 10'000'000;
    const nlohmann::json stats = nlohmann::json::parse(std::ifstream(shared_data() / "stats.json"));
    int checked = 0;
    for (const auto& [name, entry] : stats.items()) {
        if (entry["kind"] != "grid" || !entry.contains("nmax") || entry["dims"].size() > 3) continue;
        std::int64_t voxels = 1;
        for (const auto& n : entry["dims"]) voxels *= n.get<std::int64_t>();
        const fs::path path = shared_data() / name;
        if (voxels > max || !fs::exists(path)) continue;
        AnalysisOptions options;
        options.zones = false;
        const Maxima maxima = count_maxima(analyse(load(path, entry["max"].get<double>()), options));
        EXPECT_EQ(maxima.events, entry["nmax"].get<std::int64_t>()) << name;
        EXPECT_EQ(maxima.levels, entry["nmax"].get<std::int64_t>()) << name;
        ++checked;
    }
    EXPECT_GT(checked, 25);
}

TEST(Data, OneHeadAlongFourAxisOrdersHasOneTree) {
    const fs::path folder = shared_data() / "nifti_orientations";
    if (!fs::exists(folder)) GTEST_SKIP() << "no shared data beside the checkout";
    std::string expected;
    for (const char* name : {"RAS.nii.gz", "AIL.nii.gz", "LPI.nii.gz", "SRP.nii.gz"}) {
        const std::string text = oracle::canonical_text(analyse(load_volume((folder / name).string())));
        if (expected.empty()) expected = text;
        EXPECT_TRUE(text == expected) << name << " has another tree than RAS.nii.gz";
    }
    EXPECT_FALSE(expected.empty());
}

}  // namespace
}  // namespace isoatlas

// Surfaces of real data never cross themselves: crops of every volume of the shared data, with exact predicates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "isoatlas/volume.h"
#include "oracle/exact/embedding.h"

namespace oracle {
namespace {

namespace fs = std::filesystem;
using isoatlas::Volume;
using Start = isoatlas::Index3;

constexpr std::uint64_t kDataSeed = 20261123;
constexpr std::int64_t kSide = 20;

fs::path shared_data() { return fs::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data"; }

/// The samples of a box, in the place they have in space.
Volume crop(const Volume& volume, const Start& start, std::int64_t side) {
    isoatlas::Extent extent = volume.info.extent;
    isoatlas::Geometry geometry = volume.info.geometry;
    for (int axis = 0; axis < 3; ++axis) {
        extent.size[axis] = std::min(side, extent.size[axis]);
        auto& coordinates = geometry.coordinates[axis];
        if (!coordinates.empty()) coordinates = {coordinates.begin() + start[axis], coordinates.begin() + start[axis] + extent.size[axis]};
    }
    const isoatlas::Vec3 corner{static_cast<double>(start[0]), static_cast<double>(start[1]), static_cast<double>(start[2])};
    const bool rectilinear = !geometry.coordinates[0].empty();
    if (!rectilinear) geometry.origin = isoatlas::to_physical(volume.info.geometry, corner);
    Volume box = isoatlas::make_volume(extent, volume.info.type, geometry);
    const auto bytes = static_cast<std::int64_t>(isoatlas::size_of(volume.info.type));
    for (std::int64_t row = 0; row < extent.size[1] * extent.size[2]; ++row) {
        const std::int64_t y = row % extent.size[1], z = row / extent.size[1];
        const std::int64_t from = volume.info.extent.index(start[0], start[1] + y, start[2] + z), to = extent.index(0, y, z);
        std::memcpy(box.bytes.data() + to * bytes, volume.bytes.data() + from * bytes, static_cast<std::size_t>(extent.size[0] * bytes));
    }
    return box;
}

std::vector<double> distinct_values(const Volume& volume) {
    std::vector<double> values;
    isoatlas::visit_samples(volume, [&](auto samples) {
        for (const auto sample : samples) values.push_back(static_cast<double>(sample));
    });
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

/// The box with the most distinct values among a few places.
Volume rich_crop(const Volume& volume, std::int64_t side, std::mt19937_64& random) {
    Volume best;
    std::size_t max = 0;
    for (int i = 0; i < 12; ++i) {
        Start start{};
        for (int axis = 0; axis < 3; ++axis) {
            const std::int64_t places = std::max<std::int64_t>(volume.info.extent.size[axis] - side, 0) + 1;
            start[axis] = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(places));
        }
        Volume box = crop(volume, start, side);
        const std::size_t distinct = distinct_values(box).size();
        if (distinct <= max) continue;
        max = distinct;
        best = std::move(box);
    }
    return best;
}

/// A data value and one between two of them.
std::vector<double> isovalues_of(const Volume& volume) {
    const std::vector<double> values = distinct_values(volume);
    if (values.size() < 2) return {};
    const std::size_t middle = values.size() / 2, third = values.size() / 3;
    return {values[middle], values[third] + (values[third + 1] - values[third]) / 2};
}

TEST(EmbeddingOfData, CropsOfEveryVolume) {
    if (!fs::exists(shared_data() / "stats.json")) GTEST_SKIP() << "no shared data beside the checkout";
    const nlohmann::json stats = nlohmann::json::parse(std::ifstream(shared_data() / "stats.json"));
    EmbeddingTally tally;
    int volumes = 0;
    for (const auto& [name, entry] : stats.items()) {
        const fs::path path = shared_data() / name;
        if (entry["kind"] != "grid" || entry["dims"].size() < 3 || !fs::exists(path)) continue;
        isoatlas::OpenOptions options;
        if (entry["dims"].size() == 4) options.time_step = 1;
        const Volume volume = isoatlas::load_volume(path.string(), options);
        std::mt19937_64 random(kDataSeed);
        for (int i = 0; i < repetitions(); ++i) {
            const Volume box = rich_crop(volume, kSide, random);
            const std::vector<Placement> placements{Placement::own, (volumes + i) % 2 == 0 ? Placement::voxel : Placement::oblique};
            ASSERT_EQ(embedding_fault(box, isovalues_of(box), placements, tally), "") << name << ", crop " << i << ", seed " << kDataSeed;
        }
        ++volumes;
    }
    std::cout << volumes << " volumes: " << tally.text() << "\n";
    EXPECT_GT(volumes, 35);
}

}  // namespace
}  // namespace oracle

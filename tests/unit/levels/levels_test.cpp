// Files of levels of detail: what is read from them is what was made; interrupted, continued, damaged.
#include "isoatlas/levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "isoatlas/build.h"
#include "isoatlas/environment.h"
#include "isoatlas/phantom.h"
#include "oracle/stores.h"
#include "oracle/write_file.h"

namespace isoatlas {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

/// Triangles by the positions of their corners, from the least one on: independent of the order of points and triangles.
std::multiset<Corners> triangles_of(const Surface& surface) {
    std::multiset<Corners> triangles;
    for (const auto& triangle : surface.triangles) {
        Corners corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = surface.points[static_cast<std::size_t>(triangle[i])];
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        triangles.insert(corners);
    }
    return triangles;
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class LevelsOfStores : public oracle::Stores {
protected:
    void SetUp() override {
        build_atlas(path_, make_phantom("torus-chain", {.size = 24}));
        atlas_.emplace(path_);
        const ObjectTable table = atlas_->objects();
        for (const ObjectEntry& entry : table.entries) keys_.push_back({entry.id, entry.best_tau, false});
        ASSERT_FALSE(keys_.empty());
        keys_.resize(1);
        keys_.push_back({keys_[0].voxel, (3 * keys_[0].tau + table.entries[0].appears) / 4, false});
    }
    void TearDown() override {
        std::filesystem::remove(levels_path(path_));
        std::filesystem::remove_all(levels_path(path_) + ".build");
    }
    [[nodiscard]] Surface exact(const LevelsKey& key) const { return atlas_->extract(key.tau, {.objects = {key.voxel}, .contours = {}}); }
    [[nodiscard]] ClusterHierarchy hierarchy(const LevelsKey& key) const {
        return make_clusters(exact(key), atlas_->info().geometry, atlas_->info().extent);
    }

    std::optional<Atlas> atlas_;
    std::vector<LevelsKey> keys_;
};

TEST_F(LevelsOfStores, HaveWhatWasMade) {
    const std::string path = levels_path(path_);
    const std::vector<PreparedLevels> made = make_levels(*atlas_, path, keys_);
    const Levels levels(path, *atlas_);
    ASSERT_EQ(levels.surfaces().size(), keys_.size());
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const auto place = static_cast<std::int64_t>(i);
        const PreparedLevels& of = levels.surfaces()[i];
        EXPECT_EQ(of.key, keys_[i]);
        EXPECT_EQ(made[i].triangles, of.triangles);
        EXPECT_EQ(levels.find(keys_[i]), place);
        const Surface whole = exact(keys_[i]);
        EXPECT_EQ(of.triangles, static_cast<std::int64_t>(whole.triangles.size()));
        EXPECT_LT(of.coarsest, of.triangles / 4);
        EXPECT_EQ(triangles_of(levels.within(place, 0).surface), triangles_of(whole));
        const ClusterHierarchy own = hierarchy(keys_[i]);
        EXPECT_TRUE(oracle::same(levels.hierarchy(place).surface, own.surface));
        for (const double distance : {0.0, 0.1, 0.3, 1.0, 100.0}) {
            const SimplifiedSurface found = levels.within(place, distance);
            EXPECT_LE(found.distance, distance);
            EXPECT_TRUE(oracle::same(found.surface, surface_within(own, distance))) << distance;
            EXPECT_EQ(found.surface.reported_tau, whole.reported_tau);
            EXPECT_EQ(found.surface.space, whole.space);
        }
        for (const std::int64_t triangles : {of.triangles, of.triangles / 3, of.coarsest, std::int64_t{1}}) {
            const SimplifiedSurface found = levels.at_most(place, triangles);
            EXPECT_LE(static_cast<std::int64_t>(found.surface.triangles.size()), std::max(triangles, of.coarsest));
            EXPECT_LE(found.distance, of.distance);
        }
    }
    EXPECT_EQ(levels.find({keys_[0].voxel, keys_[0].tau, true}), -1);
    EXPECT_THROW((void)levels.within(static_cast<std::int64_t>(keys_.size()), 1), Error);
}

TEST_F(LevelsOfStores, AreFineWhereTheEyeIsNear) {
    const std::string path = levels_path(path_);
    (void)make_levels(*atlas_, path, keys_);
    const Levels levels(path, *atlas_);
    const ClusterHierarchy own = hierarchy(keys_[0]);
    for (const double x : {-100.0, 2.0, 12.0, 22.0}) {
        const Viewpoint from{.eye = {x, 12, 12}, .pixel = 0.01, .near = 1};
        const std::vector<double> of_groups = pixels_of_groups(own, from);
        for (const std::int64_t triangles : {std::int64_t{1} << 30, levels.surfaces()[0].triangles / 3, std::int64_t{1}}) {
            const SeenSurface seen = levels.seen_from(0, from, 0.5, triangles);
            const auto count = static_cast<std::int64_t>(seen.simplified.surface.triangles.size());
            EXPECT_LE(count, std::max(triangles, levels.surfaces()[0].coarsest));
            const double most = std::max(0.5, seen.pixels);
            const Surface chosen =
                surface_of_choice(own, [&](std::int64_t group) { return of_groups[static_cast<std::size_t>(group)] <= most; });
            EXPECT_TRUE(oracle::same(seen.simplified.surface, chosen)) << x << " " << triangles;
            EXPECT_LE(seen.simplified.distance, levels.surfaces()[0].distance);
            EXPECT_TRUE(triangles < levels.surfaces()[0].triangles || seen.pixels <= 0.5);
        }
    }
    EXPECT_THROW((void)levels.seen_from(0, {.eye = {}, .pixel = 0, .near = 1}, 1, 9), Error);
    EXPECT_THROW((void)levels.seen_from(0, {.eye = {}, .pixel = 1, .near = 1, .cone = ViewCone{{}, 1}}, 1, 9), Error);  // no direction
    EXPECT_THROW((void)levels.seen_from(0, {.eye = {}, .pixel = 1, .near = 1, .cone = ViewCone{{1, 0, 0}, 1.6}}, 1, 9), Error);
    EXPECT_THROW((void)levels.seen_from(0, {.eye = {}, .pixel = 1, .near = 1}, 0, 9), Error);
}

TEST_F(LevelsOfStores, HaveTheSameBytesHoweverTheyAreMade) {
    const std::string path = levels_path(path_);
    Context one;
    one.threads = 1;
    (void)make_levels(*atlas_, path, keys_, {}, one);
    const std::string bytes = bytes_of(path);
    std::filesystem::remove(path);

    bool stops = false;
    Context interrupted;
    interrupted.threads = 2;
    interrupted.progress = [&](const Progress& progress) { stops = stops || progress.fraction > 0.6; };  // in the second surface
    interrupted.cancelled = [&] { return stops; };
    EXPECT_THROW((void)make_levels(*atlas_, path, keys_, {}, interrupted), Error);
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_TRUE(std::filesystem::is_directory(path + ".build"));
    (void)make_levels(*atlas_, path, keys_);
    EXPECT_EQ(bytes_of(path), bytes);
    EXPECT_FALSE(std::filesystem::exists(path + ".build"));
    std::filesystem::remove(path);

    (void)make_levels(*atlas_, path, keys_, {.memory = isoatlas::kMinMemory});
    EXPECT_EQ(bytes_of(path), bytes);
    std::filesystem::remove(path);

    (void)make_levels(*atlas_, path, std::span(keys_).first(1));
    EXPECT_EQ(make_levels(*atlas_, path, std::span(keys_).subspan(1)).size(), 2U);
    EXPECT_EQ(bytes_of(path), bytes);
    (void)make_levels(*atlas_, path, keys_);  // nothing is missing
    EXPECT_EQ(bytes_of(path), bytes);
}

TEST_F(LevelsOfStores, DamageIsReported) {
    const std::string path = levels_path(path_);
    (void)make_levels(*atlas_, path, std::span(keys_).first(1));
    const std::string bytes = bytes_of(path);
    const auto look = [&] {
        const Levels levels(path, *atlas_);
        (void)levels.hierarchy(0);
        (void)levels.at_most(0, 100);
    };
    ASSERT_NO_THROW(look());
    std::size_t reported = 0, tried = 0;
    for (std::size_t i = 7; i < bytes.size(); i += bytes.size() / 300 + 1, ++tried) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        oracle::write_file(path, damaged);
        try {
            look();
        } catch (const Error& error) {
            EXPECT_TRUE(error.kind() == ErrorKind::input || error.kind() == ErrorKind::unsupported);
            ++reported;
        }
    }
    EXPECT_GT(reported, tried * 9 / 10);  // the rest: HDF5's own structures, which are not read
    for (std::size_t i = 0; i < bytes.size(); i += bytes.size() / 40 + 1) {
        oracle::write_file(path, bytes.substr(0, i));
        EXPECT_THROW(look(), Error) << i;
    }
}

TEST_F(LevelsOfStores, OfAnotherStoreAreRefused) {
    const std::string path = levels_path(path_), other = path_ + ".other.atlas";
    (void)make_levels(*atlas_, path, std::span(keys_).first(1));
    build_atlas(other, make_phantom("torus-chain", {.size = 25}));
    const Atlas there(other);
    EXPECT_THROW(Levels(path, there), Error);
    EXPECT_THROW((void)make_levels(there, path, keys_), Error);
    EXPECT_THROW(Levels(other, there), Error);  // a store is no file of levels
    EXPECT_THROW(Atlas{path}, Error);           // nor the other way
    std::filesystem::remove(other);
    std::filesystem::remove_all(path + ".build");
}

}  // namespace
}  // namespace isoatlas

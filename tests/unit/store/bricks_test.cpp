// A volume comes back from its bricks bit by bit; damage is noticed; neighbours are read together.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <mutex>

#include "isoatlas/error.h"
#include "isoatlas/phantom.h"
#include "oracle/compare.h"
#include "oracle/mesh_checks.h"
#include "oracle/volumes.h"
#include "store/brick_reader.h"
#include "store/brick_writer.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;

class Bricks : public testing::Test {
protected:
    Bricks() : path_((fs::temp_directory_path() / ("isoatlas_bricks_" + std::to_string(::getpid()) + ".atlas")).string()) {}
    ~Bricks() override { fs::remove(path_); }
    Bricks(const Bricks&) = delete;
    Bricks& operator=(const Bricks&) = delete;

public:
    void write(const Volume& volume, int threads = 0) const {
        Context context;
        context.threads = threads;
        pack(volume, brick_arrays(volume, context));
    }
    void pack(const Volume& volume, const std::vector<PackedArray>& arrays) const {
        Contents contents;
        contents.volume = volume.info;
        pack_store(path_, contents, arrays);
    }
    /// All samples from the bricks.
    Volume read_back(const Volume& volume) const {
        Volume back = make_volume(volume.info.extent, volume.info.type);
        const Container store(path_);
        visit_samples(volume, [&]<class T>(std::span<const T>) {
            const BrickReader<T> reader(store);
            std::vector<BrickId> all;
            for (const BrickId b : reader.grid().bricks()) all.push_back(b);
            reader.read(all, {}, [&](BrickId brick, std::span<const T> samples) {
                const Box box = reader.grid().box(brick);
                std::size_t i = 0;
                for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
                    for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y) {
                        for (std::int64_t x = box.begin[0]; x < box.end[0]; ++x)
                            back.samples<T>()[static_cast<std::size_t>(volume.info.extent.index(x, y, z))] = samples[i++];
                    }
                }
            });
        });
        return back;
    }
    std::string path_;
};

oracle::Grid arbitrary_grid() {
    std::array<std::int64_t, 3> size{};
    for (std::int64_t& n : size) n = *rc::gen::inRange<std::int64_t>(1, 40);
    const auto raw = *rc::gen::container<std::vector<int>>(997, rc::gen::resize(100, rc::gen::inRange(0, 10000)));
    oracle::Grid grid{3, size, {}};
    const auto texture = static_cast<oracle::Texture>(*rc::gen::inRange(0, oracle::kTextures));
    for (oracle::Index v = 0; v < grid.voxels(); ++v) {
        const std::vector<int> one(static_cast<std::size_t>(v + 1), raw[static_cast<std::size_t>(v % 997)]);
        grid.value.push_back(oracle::texture_value(texture, grid, v, one));
    }
    return grid;
}

RC_GTEST_FIXTURE_PROP(Bricks, GiveTheSameBits, ()) {
    const oracle::Grid grid = arbitrary_grid();
    const Volume volume = oracle::to_volume(grid, oracle::arbitrary_type(grid));
    write(volume, *rc::gen::inRange(1, 4));
    RC_ASSERT(read_back(volume).bytes == volume.bytes);
}

// The voxels that name components: in the total order, so the last one of the highest and the first one of the lowest.
RC_GTEST_FIXTURE_PROP(Bricks, KnowTheirHighestAndLowestVoxels, ()) {
    const oracle::Grid grid = arbitrary_grid();
    const Volume volume = oracle::to_volume(grid, oracle::arbitrary_type(grid));
    write(volume);
    const Container store(path_);
    visit_samples(volume, [&]<class T>(std::span<const T>) {
        const BrickReader<T> reader(store);
        std::vector<std::pair<double, std::int64_t>> min(static_cast<std::size_t>(reader.grid().count()), {1e300, 0}), max = min;
        for (auto& high : max) high.first = -1e300;
        for (std::int64_t v = 0; v < volume.info.extent.voxels(); ++v) {
            const auto at = volume.info.extent.voxel(v);
            const std::size_t b = reader.grid().brick(BrickGrid::place_of(at)).index();
            min[b] = std::min(min[b], std::pair(volume.value(v), v));
            max[b] = std::max(max[b], std::pair(volume.value(v), v));
        }
        for (const BrickId b : reader.grid().bricks()) {
            RC_ASSERT(reader.highest_voxel(b).number() == max[b.index()].second);
            RC_ASSERT(reader.lowest_voxel(b).number() == min[b.index()].second);
        }
        reader.check({.threads = 1});
    });
}

// Places that are not those of the extremes are refused, whatever the checksums say.
TEST_F(Bricks, WrongPlacesOfExtremesAreRefused) {
    const Volume volume = make_phantom("noise", {.size = 20, .quantise = 8});
    for (const char* name : {"volume/highest", "volume/lowest"}) {
        for (const std::uint16_t wrong : {std::uint16_t{0}, std::uint16_t{63}, std::uint16_t{64}, std::uint16_t{1024}}) {
            std::vector<PackedArray> arrays = brick_arrays(volume, {});
            const std::vector<std::uint16_t> places(static_cast<std::size_t>(BrickGrid(volume.info.extent).count()), wrong);
            for (PackedArray& array : arrays) {
                if (array.name == name) array.feed = [&](const ByteSink& put) { put(std::as_bytes(std::span(places))); };
            }
            pack(volume, arrays);
            EXPECT_THROW(BrickReader<std::uint8_t>(Container(path_)).check({.threads = 1}), Error) << name << ' ' << wrong;
        }
    }
}

TEST_F(Bricks, NegativeZerosStay) {
    const std::vector<float> samples{-0.0F, 0.0F, 0.0F, -0.0F};
    const Volume volume = make_volume<float>({3, {2, 2, 1}}, samples);
    write(volume);
    EXPECT_EQ(read_back(volume).bytes, volume.bytes);
}

TEST_F(Bricks, NeighboursAreReadTogether) {
    const Volume volume = make_phantom("random-field", {.size = 128, .quantise = 256});
    write(volume);
    const Container store(path_);
    const BrickReader<std::uint8_t> reader(store);
    std::vector<BrickId> corner;
    for (const BrickId b : reader.grid().bricks()) {
        const auto place = reader.grid().place(b);
        if (place[0] < 4 && place[1] < 4 && place[2] < 4) corner.push_back(b);
    }
    const IoCounters counters = reader.read(corner, {}, [](BrickId, std::span<const std::uint8_t>) {});
    EXPECT_EQ(counters.bricks, 64);
    EXPECT_EQ(counters.extents, 1);
    EXPECT_LT(counters.bytes, 64 * kBrickSamples);
}

TEST_F(Bricks, ADamagedBrickIsNeverReturned) {
    const Volume volume = make_phantom("noise", {.size = 20});
    write(volume);
    std::int64_t begin = 0, bytes = 0;
    {
        const Container store(path_);
        const StoredArray& data = store.contents().array("volume/data", "uint8");
        begin = data.offset, bytes = data.bytes();
    }
    for (std::int64_t at = begin; at < begin + bytes; at += 101) {
        std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
        file.seekg(at);
        const int old = file.get();
        file.seekp(at);
        file.put(static_cast<char>(old ^ 4));
        file.flush();
        EXPECT_THROW((void)read_back(volume), Error) << at;
        file.seekp(at);
        file.put(static_cast<char>(old));
    }
    EXPECT_EQ(read_back(volume).bytes, volume.bytes);
}

}  // namespace
}  // namespace isoatlas

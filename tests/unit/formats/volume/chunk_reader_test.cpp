// Boxes of samples: chunks, slices and boxes of boxes give what the whole volume holds there.
#include <gtest/gtest.h>

#include <random>

#include "formats/volume/choose.h"
#include "formats/volume/chunk_reader.h"
#include "isoatlas/filter.h"

namespace isoatlas {
namespace {

std::uint16_t sample_at(const Index3& voxel) { return static_cast<std::uint16_t>(voxel[0] + 50 * voxel[1] + 2500 * voxel[2]); }

Volume whole_of(const Extent& extent) {
    Volume volume = make_volume(extent, ValueType::u16);
    for (std::int64_t i = 0; i < extent.voxels(); ++i)
        volume.samples<std::uint16_t>()[static_cast<std::size_t>(i)] = sample_at(extent.voxel(i));
    return volume;
}

std::unique_ptr<VolumeReader> chunked(const Extent& extent, const Index3& chunk, std::int64_t cache, int& reads) {
    VolumeInfo info;
    info.type = ValueType::u16, info.extent = extent, info.chunk = chunk;
    return make_chunk_reader(
        info,
        [chunk, &reads](const Index3& at, std::span<std::byte> out) {
            ++reads;
            const std::span<std::uint16_t> samples(reinterpret_cast<std::uint16_t*>(out.data()), out.size() / 2);
            const Extent one{3, chunk};
            for (std::int64_t i = 0; i < one.voxels(); ++i) {
                const Index3 in = one.voxel(i);
                samples[static_cast<std::size_t>(i)] =
                    sample_at({at[0] * chunk[0] + in[0], at[1] * chunk[1] + in[1], at[2] * chunk[2] + in[2]});
            }
        },
        cache);
}

std::vector<std::byte> read(VolumeReader& reader, const SampleBox& box) {
    std::vector<std::byte> out(static_cast<std::size_t>(box.size().product()) * 2);
    reader.read_box(box, out);
    return out;
}

TEST(Boxes, AnyBoxOfChunksSlicesAndBoxesIsThatOfTheVolume) {
    const Extent extent{3, {13, 9, 11}};
    const Volume whole = whole_of(extent);
    const std::int64_t slice = extent.slice() * 2;
    std::mt19937_64 random(4);
    const auto below = [&](std::int64_t n) { return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n)); };
    for (const Index3 chunk :
         {Index3{1, 1, 1}, Index3{4, 3, 5}, Index3{13, 9, 1}, Index3{13, 3, 1}, Index3{13, 9, 4}, Index3{16, 16, 16}}) {
        int reads = 0;
        const auto reader = chunked(extent, chunk, 600, reads);
        const auto slices = slab_reader(whole.info, [&](std::int64_t z, std::int64_t end, std::span<std::byte> out) {
            std::copy(whole.bytes.begin() + z * slice, whole.bytes.begin() + end * slice, out.begin());
        });
        for (int i = 0; i < 50; ++i) {
            SampleBox box;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                box.begin[axis] = below(extent.size[axis]);
                box.end[axis] = box.begin[axis] + 1 + below(extent.size[axis] - box.begin[axis]);
                if (below(3) == 0) box.begin[axis] = 0, box.end[axis] = extent.size[axis];  // chunks that need no copy
            }
            const Volume part = crop(whole, box);
            const std::vector<std::byte> expected(part.bytes.begin(), part.bytes.end());
            EXPECT_EQ(read(*reader, box), expected);
            EXPECT_EQ(read(*slices, box), expected);
            const auto inner = box_reader(chunked(extent, chunk, 600, reads), box);
            EXPECT_EQ(read(*inner, {{0, 0, 0}, box.size()}), expected);
            EXPECT_EQ(inner->info().geometry, part.info.geometry);
        }
    }
}

TEST(Boxes, ReadingThroughAVolumeDecodesEachChunkOnce) {
    const Extent extent{3, {20, 20, 20}};
    int reads = 0;
    const auto reader = chunked(extent, {8, 8, 8}, 9 * 8 * 8 * 8 * 2, reads);
    std::vector<std::byte> slab(20 * 20 * 2);
    for (std::int64_t z = 0; z < 20; ++z) reader->read(z, z + 1, slab);
    EXPECT_EQ(reads, 27);
}

TEST(Boxes, ThoseOutsideAreRefused) {
    int reads = 0;
    for (const SampleBox& box : {SampleBox{{0, 0, 0}, {14, 1, 1}}, SampleBox{{-1, 0, 0}, {1, 1, 1}}, SampleBox{{2, 0, 0}, {2, 1, 1}}})
        EXPECT_THROW((void)box_reader(chunked({3, {13, 9, 11}}, {4, 4, 4}, 100, reads), box), Error);
}

TEST(Choices, ByNameByCaseByNumber) {
    const std::vector<std::string> names{"DAPI", "gfp", "GFP", "1"};
    const auto chosen = [&](const char* word) {
        OpenOptions options;
        options.channel = word;
        return choose_channel("file", options, names);
    };
    EXPECT_EQ(chosen("DAPI"), 0);
    EXPECT_EQ(chosen("dapi"), 0);
    EXPECT_EQ(chosen("gfp"), 1);
    EXPECT_EQ(chosen("GFP"), 2);
    EXPECT_EQ(chosen("1"), 3);  // a name before a number
    EXPECT_EQ(chosen("2"), 2);
    for (const char* bad : {"Gfp", "4", "-1", "", "rfp"}) EXPECT_THROW((void)chosen(bad), Error) << bad;
    try {
        (void)choose_channel("file", {}, names);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.reason(), Reason::channel_needed);
        EXPECT_EQ(error.text().choices.size(), 4U);
    }
}

}  // namespace
}  // namespace isoatlas

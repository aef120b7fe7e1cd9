// 2,400 flipped bits in compressed files of the shared data, drawn with a printed seed: each is refused or gives the same samples.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "unit/formats/volume/compressed_files.h"
#include "unit/formats/volume/damage.h"

namespace isoatlas {
namespace {

const std::string kData = std::string(ISOATLAS_SOURCE_DIR) + "/../shared/data/";

struct DataFile {
    const char* volume;
    const char* damaged;  ///< beside it; empty: itself
    std::int64_t time_step;
    int flips;
};

/// All formats of the shared data that are compressed; of the large one few, as each flip is a whole reading.
constexpr DataFile kFiles[] = {{"fuel/fuel.nrrd", "", -1, 240},
                               {"vase/vase.nrrd", "", -1, 240},
                               {"neghip/neghip.nrrd", "", -1, 240},
                               {"headsq/headsq.nrrd", "", -1, 160},
                               {"m4_density/m4_density.nrrd", "", -1, 200},
                               {"brain_slices2d/r16.nrrd", "", -1, 200},
                               {"functional4d/functional4d.nrrd", "", 7, 160},
                               {"hydrogen/hydrogen.mha", "", -1, 160},
                               {"lung_ct/original/3DCT_lung_baseline_small.mha", "", -1, 200},
                               {"frog_labels/original/frogtissue.mhd", "frogtissue.zraw", -1, 10},
                               {"fuel/original/fuel.nii.gz", "", -1, 240},
                               {"nifti_orientations/RAS.nii.gz", "", -1, 150},
                               {"nuclei/original/img3d.tif", "", -1, 200}};

TEST(DamagedData, NoFlippedBitGivesOtherSamples) {
    if (!std::filesystem::exists(kData + "stats.json")) GTEST_SKIP() << "no shared data: 2,400 flips in 13 files were not tried";
    constexpr std::uint64_t kSeed = 15;
    std::mt19937_64 draw(kSeed);
    std::array<int, 4> all{};
    for (const DataFile& file : kFiles) {
        const std::string path = kData + file.volume;
        const std::string damaged = *file.damaged == '\0' ? path : (std::filesystem::path(path).parent_path() / file.damaged).string();
        const test::Damage damage(path, damaged, test::read_file(damaged), file.time_step);
        const std::size_t bits = 8 * std::filesystem::file_size(damaged);
        for (int i = 0; i < file.flips; ++i) {
            const std::size_t bit = draw() % bits;
            EXPECT_NE(static_cast<int>(damage.flip(bit)), static_cast<int>(test::Damage::Outcome::other_samples))
                << file.volume << ": byte " << bit / 8 << " bit " << bit % 8;
        }
        std::printf("%s: %s\n", file.volume, damage.counts().c_str());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] += damage.numbers()[i];
    }
    std::printf("seed %d: %d refused, %d the same samples, %d declared otherwise, %d other samples\n", static_cast<int>(kSeed), all[0],
                all[1], all[2], all[3]);
    EXPECT_EQ(all[0] + all[1] + all[2] + all[3], 2400);
    EXPECT_EQ(all[3], 0);
}

/// The headers in front of the streams have no checksum: each of their bits. Types may be declared otherwise (printed), samples not.
TEST(DamagedData, NoFlippedBitOfAHeaderGivesOtherSamples) {
    if (!std::filesystem::exists(kData + "stats.json")) GTEST_SKIP() << "no shared data: the headers of 3 files were not tried";
    const DataFile files[] = {
        {"fuel/fuel.nrrd", "", -1, 0}, {"m4_density/m4_density.nrrd", "", -1, 0}, {"hydrogen/hydrogen.mha", "", -1, 0}};
    for (const DataFile& file : files) {
        const std::string path = kData + file.volume, content = test::read_file(path);
        const test::Damage damage(path, path, content, file.time_step);
        const std::size_t end = path.ends_with(".mha") ? content.find("LOCAL\n") + 6 : content.find("\n\n") + 2;
        for (std::size_t bit = 0; bit < 8 * end; ++bit) {
            EXPECT_NE(static_cast<int>(damage.flip(bit)), static_cast<int>(test::Damage::Outcome::other_samples))
                << file.volume << ": byte " << bit / 8 << " bit " << bit % 8;
        }
        std::printf("%s, header: %s\n", file.volume, damage.counts().c_str());
    }
}

}  // namespace
}  // namespace isoatlas

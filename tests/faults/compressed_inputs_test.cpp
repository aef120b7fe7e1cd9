// Damaged compressed volumes of every format: one flipped bit, a cut, bytes behind the end. Each is refused with a documented error, or
// reads as the same samples. Exhaustive over small files; drawn over the real ones (damaged_data_test.cpp).
#include <gtest/gtest.h>

#include "unit/formats/volume/compressed_files.h"
#include "unit/formats/volume/damage.h"

namespace isoatlas {
namespace {

using test::Damage;

TEST(CompressedInputs, SeedsReadAsTheirSamples) {
    const test::TestFolder folder;
    for (const test::CompressedSeed& seed : test::compressed_seeds(folder)) {
        SCOPED_TRACE(seed.name);
        const test::Answer answer = test::answer_of(folder / seed.name, seed.time_step);
        ASSERT_TRUE(answer.read) << answer.message;
        EXPECT_EQ(answer.samples, seed.time_step < 0 ? test::compressed_samples() : test::compressed_samples().substr(0, 48));
    }
}

/// Without a checksum in the format a bit of a sample can be another; with one, nothing but the declared type may be.
TEST(CompressedInputs, EveryBitFlipped) {
    const test::TestFolder folder;
    for (const test::CompressedSeed& seed : test::compressed_seeds(folder)) {
        if (!seed.has_checksum) continue;
        const Damage damage(folder / seed.name, folder / seed.damaged, seed.content, seed.time_step);
        for (std::size_t bit = 0; bit < 8 * seed.content.size(); ++bit) {
            const Damage::Outcome outcome = damage.flip(bit);
            EXPECT_NE(static_cast<int>(outcome), static_cast<int>(Damage::Outcome::other_samples))
                << seed.name << " (" << seed.damaged << "): byte " << bit / 8 << " bit " << bit % 8;
        }
        std::printf("%s (%s): %s\n", seed.name.c_str(), seed.damaged.c_str(), damage.counts().c_str());
    }
}

TEST(CompressedInputs, EveryPrefixIsRefusedOrWhole) {
    const test::TestFolder folder;
    for (const test::CompressedSeed& seed : test::compressed_seeds(folder)) {
        const Damage damage(folder / seed.name, folder / seed.damaged, seed.content, seed.time_step);
        for (std::size_t size = 0; size < seed.content.size(); ++size) {
            SCOPED_TRACE(seed.name + " cut to " + std::to_string(size));
            const Damage::Outcome outcome = damage.with(seed.content.substr(0, size));
            EXPECT_NE(static_cast<int>(outcome), static_cast<int>(Damage::Outcome::other_samples));
            // What is cut off a TIFF or VTI file need not be samples; elsewhere the last bytes are the checksum.
            const bool ends_with_samples = seed.name.ends_with(".nrrd") || seed.name.ends_with(".nii.gz") || seed.name.ends_with(".mha") ||
                                           seed.damaged.ends_with(".gz") || seed.damaged.ends_with(".bz2") ||
                                           seed.damaged.ends_with(".zraw");
            EXPECT_TRUE(!ends_with_samples || outcome == Damage::Outcome::refused);
        }
    }
}

/// More in the stream, another stream, or garbage behind it: refused, and read with skip_rest; but not when it is damaged.
TEST(CompressedInputs, ExtraBytesAreRefusedUnlessSkipped) {
    const test::TestFolder folder;
    const std::string samples = test::compressed_samples(), header = "NRRD0004\ntype: ushort\ndimension: 3\nsizes: 4 3 4\nendian: little\n";
    std::string broken = test::gzip(samples + "more");
    broken[broken.size() - 6] = static_cast<char>(broken[broken.size() - 6] ^ 4);  // of the checksum
    const std::vector<std::pair<std::string, std::string>> longer = {{"raw", samples + "m"},
                                                                     {"gzip", test::gzip(samples + "m")},
                                                                     {"gzip", test::gzip(samples + std::string(200000, 'm'))},
                                                                     {"gzip", test::gzip(samples) + test::gzip("more")},
                                                                     {"gzip", test::gzip(samples) + "garbage"},
                                                                     {"gzip", test::zlib(samples) + "garbage"},
                                                                     {"bzip2", test::bzip2(samples + "m")},
                                                                     {"bzip2", test::bzip2(samples) + test::bzip2("more")},
                                                                     {"bzip2", test::bzip2(samples) + "BZ"}};
    OpenOptions skip;
    skip.skip_rest = true;
    for (const auto& [encoding, payload] : longer) {
        SCOPED_TRACE(encoding + " " + std::to_string(payload.size()));
        const std::string path = folder.write("v.nrrd", header + "encoding: " + encoding + "\n\n" + payload);
        test::expect_reason(test::failure_of_loading(path), ErrorKind::input, Reason::bytes_after_samples);
        const Volume volume = load_volume(path, skip);
        EXPECT_EQ(test::text_of_bytes(volume), samples);
        ASSERT_EQ(volume.info.notes.size(), 1U);
        EXPECT_NE(volume.info.notes[0].find("ignored"), std::string::npos);
    }
    const std::string damaged = folder.write("v.nrrd", header + "encoding: gzip\n\n" + broken);
    test::expect_helpful(test::failure_of_loading(damaged), ErrorKind::input, "corrupt");
    test::expect_helpful(test::failure_of_loading(damaged, skip), ErrorKind::input, "corrupt");
}

/// Members of 16 MiB of zeros, one after the other: a file of 1 MiB that stands for more than 1 GiB.
TEST(CompressedInputs, ABombBehindTheSamplesIsNotFollowedToItsEnd) {
    const test::TestFolder folder;
    const std::string member = test::gzip(std::string(std::size_t{16} << 20, '\0'));
    std::string bomb =
        "NRRD0004\ntype: ushort\ndimension: 3\nsizes: 4 3 4\nendian: little\nencoding: gzip\n\n" + test::gzip(test::compressed_samples());
    for (int i = 0; i < 80; ++i) bomb += member;
    const std::string path = folder.write("bomb.nrrd", bomb);
    OpenOptions skip;
    skip.skip_rest = true;
    test::expect_helpful(test::failure_of_loading(path, skip), ErrorKind::input, "1073741824 decompressed bytes follow");
}

/// Every data file of a list is read to its end, not only the last.
TEST(CompressedInputs, EachPartMustEndWithItsSamples) {
    const test::TestFolder folder;
    const std::string samples = test::compressed_samples(), header = "NRRD0004\ntype: ushort\ndimension: 3\nsizes: 4 3 4\nendian: little\n";
    for (const std::string encoding : {"raw", "gzip"}) {
        for (const bool first : {true, false}) {
            SCOPED_TRACE(encoding + (first ? " first" : " second"));
            std::string parts[2] = {samples.substr(0, 48), samples.substr(48)};
            parts[first ? 0 : 1] += "x";
            for (int i = 0; i < 2; ++i) folder.write("p" + std::to_string(i), encoding == "raw" ? parts[i] : test::gzip(parts[i]));
            const std::string path = folder.write("v.nhdr", header + "encoding: " + encoding + "\ndata file: LIST\np0\np1\n");
            test::expect_reason(test::failure_of_loading(path), ErrorKind::input, Reason::bytes_after_samples);
            OpenOptions skip;
            skip.skip_rest = true;
            EXPECT_EQ(test::text_of_bytes(load_volume(path, skip)), samples);
        }
    }
}

/// Strips that decode to a row too many or too few: the file of a page of other height, with the height changed.
TEST(CompressedInputs, TiffPiecesDecodeToTheirPixels) {
    const test::TestFolder folder;
    for (const int compression : {COMPRESSION_ADOBE_DEFLATE, COMPRESSION_LZW, COMPRESSION_PACKBITS}) {
        for (const char* mode : {"wl", "wb"}) {
            SCOPED_TRACE(std::to_string(compression) + mode);
            test::TiffRecipe recipe{.width = 40, .height = 30, .pages = 1, .compression = compression, .mode = mode, .rows_per_strip = 30};
            const std::string samples = test::telling_bytes(2400);
            test::write_tiff_file(folder / "v.tif", recipe, samples);
            EXPECT_EQ(test::text_of_bytes(load_volume(folder / "v.tif")), samples);
            const std::string whole = test::read_file(folder / "v.tif");
            std::string lower = whole;  // ImageLength 30 -> 29
            const std::string entry = std::string(mode) == "wl" ? std::string("\x01\x01\x03\0\x01\0\0\0\x1e\0", 10)
                                                                : std::string("\x01\x01\0\x03\0\0\0\x01\0\x1e", 10);
            const std::size_t at = lower.find(entry);
            ASSERT_NE(at, std::string::npos);
            lower[at + (std::string(mode) == "wl" ? 8 : 9)] = 29;
            folder.write("v.tif", lower);
            test::expect_helpful(test::failure_of_loading(folder / "v.tif"), ErrorKind::input,
                                 "it decodes to 2400 bytes (expected 2320 bytes)");
            OpenOptions skip;
            skip.skip_rest = true;
            EXPECT_EQ(test::text_of_bytes(load_volume(folder / "v.tif", skip)), samples.substr(0, 2320));
        }
    }
}

TEST(CompressedInputs, TextThatMayBeCutInItsLastNumberIsRefused) {
    const test::TestFolder folder;
    const std::string nrrd = "NRRD0001\ntype: int\ndimension: 2\nsizes: 2 2\nencoding: ascii\n\n";
    const std::string meta = "NDims = 2\nDimSize = 2 2\nElementType = MET_INT\nBinaryData = False\nElementDataFile = LOCAL\n";
    for (const auto& [name, header] : {std::pair{"v.nrrd", nrrd}, {"v.mha", meta}}) {
        SCOPED_TRACE(name);
        for (const char* end : {"\n", " ", "\r\n", ",\n"})
            EXPECT_EQ(load_volume(folder.write(name, header + "1 2\n3 41" + end)).value(3), 41);
        test::expect_helpful(test::failure_of_loading(folder.write(name, header + "1 2\n3 4")), ErrorKind::input, "longer number");
        test::expect_reason(test::failure_of_loading(folder.write(name, header + "1 2\n3 41\n5\n")), ErrorKind::input,
                            Reason::bytes_after_samples);
    }
}

}  // namespace
}  // namespace isoatlas

// Hostile NRRD, MetaImage, NumPy and RAW files: cut at every byte, every bit flipped, absurd claims. Each either reads as a whole volume
// or is refused with a documented kind of error; nothing allocates more than a small multiple of the file.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "unit/formats/volume/volume_files.h"

namespace {
std::atomic<std::size_t> g_largest{0};
}

[[gnu::noinline]] void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    std::size_t seen = g_largest.load();
    while (bytes > seen && !g_largest.compare_exchange_weak(seen, bytes)) {
    }
    return std::malloc(bytes == 0 ? 1 : bytes);
}
[[gnu::noinline]] void* operator new(std::size_t bytes) {
    void* memory = operator new(bytes, std::nothrow);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace isoatlas {
namespace {

constexpr std::size_t kMaxMemory = 1 << 20;  // files of this test have less than 1 KiB; deflate can make 1032 times as much of it

struct Seed {
    std::string name;
    std::string content;
    std::size_t header_bytes = 0;  ///< of content
    std::string samples;
    bool payload_last = true;  ///< cutting the file cuts samples
};

std::string npy(const std::string& type, const std::string& shape, const std::string& samples) {
    std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + "}\n";
    return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(text.size()) + '\0' + text + samples;
}

Seed seed(const std::string& name, const std::string& header, const std::string& payload, const std::string& samples,
          bool payload_last = true) {
    return {name, header + payload, header.size(), samples, payload_last};
}

std::vector<Seed> seeds(const test::TestFolder& folder) {
    const std::string samples = test::telling_bytes(48);
    folder.write("data.raw", samples);
    for (int i = 1; i <= 4; ++i) folder.write("s" + std::to_string(i) + ".raw", samples.substr(static_cast<std::size_t>(i - 1) * 12, 12));
    const std::string nrrd =
        "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 3 4\nspace: left-posterior-superior\n"
        "space directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (1,2,3)\nkinds: domain domain domain\nendian: little\n";
    const std::string meta =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nOffset = 1 2 3\n"
        "TransformMatrix = 1 0 0 0 1 0 0 0 1\nElementSpacing = 1 1 2\nDimSize = 2 3 4\nElementType = MET_SHORT\n";
    const std::string packed = test::zlib(samples);
    const std::string numpy = npy("<i2", "(4, 3, 2)", "");
    std::vector<Seed> all = {
        seed("raw.nrrd", nrrd + "encoding: raw\n\n", samples, samples),
        seed("gzip.nrrd", nrrd + "encoding: gzip\n\n", test::gzip(samples), samples),
        seed("text.nrrd", "NRRD0001\ntype: uchar\ndimension: 2\nsizes: 2 2\nspacings: 1 2\naxis mins: 0 0\nencoding: ascii\n\n",
             "10 20 30 4 ", std::string("\x0a\x14\x1e\x04", 4), false),
        seed("series.nhdr", nrrd + "encoding: raw\ndata file: s%d.raw 1 4 1\n", "", samples, false),
        seed("list.nhdr", nrrd + "encoding: raw\ndata file: LIST\ns1.raw\ns2.raw\ns3.raw\ns4.raw\n", "", samples, false),
        seed("raw.mha", meta + "ElementDataFile = LOCAL\n", samples, samples),
        seed("zlib.mha",
             meta + "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()) + "\nElementDataFile = LOCAL\n", packed,
             samples),
        seed("detached.mhd", meta + "ElementDataFile = data.raw\n", "", samples, false),
        seed("v.npy", numpy, samples, samples)};
    for (const Seed& seed : all) folder.write(seed.name, seed.content);
    return all;
}

/// Loads a file with this content and holds the rules; whether it read.
bool load_by_the_rules(const std::string& path, const std::string& content, std::string& bytes) {
    const test::Replaced replaced(path, content);
    g_largest = 0;
    bool read = false;
    try {
        const Volume volume = load_volume(path);
        const auto expected = static_cast<std::size_t>(volume.info.extent.voxels()) * size_of(volume.info.type);
        EXPECT_EQ(volume.bytes.size(), expected);
        bytes = test::text_of_bytes(volume);
        read = true;
    } catch (const Error& error) {
        const bool documented =
            error.kind() == ErrorKind::input || error.kind() == ErrorKind::unsupported || error.kind() == ErrorKind::usage;
        EXPECT_TRUE(documented) << error.what();
        EXPECT_FALSE(error.text().file.empty()) << error.what();
        EXPECT_FALSE(error.text().next.empty()) << error.what();
        for (const char c : std::string(error.what())) EXPECT_FALSE(c >= 0 && c < ' ') << "control bytes in: " << error.what();
    }
    EXPECT_LE(g_largest.load(), kMaxMemory);
    return read;
}

TEST(VolumeHeaders, SeedsRead) {
    const test::TestFolder folder;
    for (const Seed& seed : seeds(folder)) {
        SCOPED_TRACE(seed.name);
        EXPECT_EQ(test::text_of_bytes(load_volume(folder / seed.name)), seed.samples);
    }
}

TEST(VolumeHeaders, CutAtEveryByte) {
    const test::TestFolder folder;
    for (const Seed& seed : seeds(folder)) {
        for (std::size_t size = 0; size < seed.content.size(); ++size) {
            SCOPED_TRACE(seed.name + " cut to " + std::to_string(size));
            std::string bytes;
            const bool read = load_by_the_rules(folder / seed.name, seed.content.substr(0, size), bytes);
            EXPECT_FALSE(read && seed.payload_last);
            EXPECT_TRUE(!read || bytes == seed.samples);
        }
    }
}

TEST(VolumeHeaders, EveryBitFlipped) {
    const test::TestFolder folder;
    for (const Seed& seed : seeds(folder)) {
        for (std::size_t i = 0; i < seed.content.size(); ++i) {
            for (int bit = 0; bit < 8; ++bit) {
                SCOPED_TRACE(seed.name + " byte " + std::to_string(i) + " bit " + std::to_string(bit));
                std::string flipped = seed.content;
                flipped[i] = static_cast<char>(flipped[i] ^ 1 << bit);
                std::string bytes;
                load_by_the_rules(folder / seed.name, flipped, bytes);
                if (testing::Test::HasFailure()) return;
            }
        }
    }
}

/// Every run of digits in the header replaced by every absurd number.
TEST(VolumeHeaders, AbsurdNumbers) {
    const test::TestFolder folder;
    const std::vector<std::string> absurd = {"0",
                                             "-1",
                                             "1e9",
                                             "nan",
                                             "",
                                             "1099511627776",
                                             "9223372036854775807",
                                             "9223372036854775808",
                                             "-9223372036854775808",
                                             "4294967296",
                                             "2147483648",
                                             "99999999999999999999999999",
                                             "0x10",
                                             "1.5"};
    for (const Seed& seed : seeds(folder)) {
        const std::string header = seed.content.substr(0, seed.header_bytes), rest = seed.content.substr(seed.header_bytes);
        for (std::size_t begin = header.find_first_of("0123456789"); begin != std::string::npos;) {
            const std::size_t end = std::min(header.find_first_not_of("0123456789", begin), header.size());
            for (const std::string& number : absurd) {
                SCOPED_TRACE(seed.name + " offset " + std::to_string(begin) + ": " + number);
                std::string bytes;
                load_by_the_rules(folder / seed.name, header.substr(0, begin) + number + header.substr(end) + rest, bytes);
                if (testing::Test::HasFailure()) return;
            }
            begin = header.find_first_of("0123456789", end);
        }
    }
}

/// Lines dropped, doubled and swapped: contradictions and gaps.
TEST(VolumeHeaders, LinesMissingOrTwice) {
    const test::TestFolder folder;
    for (const Seed& seed : seeds(folder)) {
        const std::string header = seed.content.substr(0, seed.header_bytes), rest = seed.content.substr(seed.header_bytes);
        for (std::size_t begin = 0; begin < header.size();) {
            const std::size_t end = std::min(header.find('\n', begin), header.size() - 1) + 1;
            for (const int copies : {0, 2, 40}) {
                SCOPED_TRACE(seed.name + " line at " + std::to_string(begin) + " x" + std::to_string(copies));
                std::string text = header.substr(0, begin);
                for (int i = 0; i < copies; ++i) text += header.substr(begin, end - begin);
                std::string bytes;
                load_by_the_rules(folder / seed.name, text + header.substr(end) + rest, bytes);
                if (testing::Test::HasFailure()) return;
            }
            begin = end;
        }
    }
}

TEST(VolumeHeaders, RawSidecarCutAndFlipped) {
    const test::TestFolder folder;
    const std::string path = folder.write("v.raw", test::telling_bytes(48));
    const std::string json = R"({"dims": [2, 3, 4], "type": "int16", "endian": "big", "skip": 0, "spacing": [1, 2, 0.5], "unit": "mm"})";
    const std::string sidecar = folder.write("v.json", json);
    const auto load_with = [&](const std::string& text) {
        const test::Replaced replaced(sidecar, text);
        const test::Failure failure = test::failure_of_loading(path);
        EXPECT_TRUE(failure.message.empty() || !failure.text.next.empty()) << failure.message;
        return failure;
    };
    EXPECT_TRUE(load_with(json).message.empty());
    for (std::size_t i = 0; i < json.size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_EQ(static_cast<int>(load_with(json.substr(0, i)).kind), static_cast<int>(ErrorKind::input));
        for (int bit = 0; bit < 8; ++bit) {
            std::string flipped = json;
            flipped[i] = static_cast<char>(flipped[i] ^ 1 << bit);
            load_with(flipped);
        }
    }
}

/// A header that names itself as its data, a list that never ends, a very long line.
TEST(VolumeHeaders, OddReferences) {
    const test::TestFolder folder;
    const std::string start = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n";
    std::string bytes;
    EXPECT_FALSE(load_by_the_rules(folder.write("self.nhdr", "x"), start + "data file: self.nhdr\n", bytes));
    EXPECT_TRUE(load_by_the_rules(folder.write("self.nhdr", "x"), start + "byte skip: -1\ndata file: self.nhdr\n", bytes));
    EXPECT_EQ(bytes, std::string("lf.nhdr\n"));
    EXPECT_FALSE(load_by_the_rules(folder.write("folder.nhdr", "x"), start + "data file: .\n", bytes));
    EXPECT_FALSE(load_by_the_rules(folder.write("huge.nhdr", "x"), start + "data file: s%d.raw 1 1000000000000 1\n", bytes));
    EXPECT_FALSE(load_by_the_rules(folder.write("long.nhdr", "x"), start + "data file: " + std::string(5000, 'x') + "\n", bytes));
    EXPECT_FALSE(load_by_the_rules(folder.write("zero.nhdr", "x"), start + "data file: a" + std::string(1, '\0') + "b\n", bytes));
    EXPECT_FALSE(load_by_the_rules(folder.write("wide.nhdr", "x"), start + "data file: s%99999999999999d.raw 1 8 1\n", bytes));
    EXPECT_FALSE(load_by_the_rules(folder.write("string.nhdr", "x"), start + "data file: s%s%n.raw 1 8 1\n", bytes));
}

}  // namespace
}  // namespace isoatlas

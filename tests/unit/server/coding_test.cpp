#include "server/coding.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

namespace isoatlas {
namespace {

TEST(Coding, IsTheBestThatIsAllowed) {
    EXPECT_EQ(coding_for("gzip, deflate, br, zstd"), "zstd");
    EXPECT_EQ(coding_for("gzip;q=0.5, zstd;q=0"), "gzip");
    EXPECT_EQ(coding_for("gzip ; q=0.5"), "gzip");
    EXPECT_EQ(coding_for("xgzip, zstdx"), "");
    EXPECT_EQ(coding_for("identity"), "");
    EXPECT_EQ(coding_for(""), "");
    EXPECT_EQ(coding_for(",,;,"), "");
}

std::string unzipped(const std::string& bytes, std::size_t size) {
    std::string result(size + 1, '\0');
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    result.resize(stream.total_out);
    inflateEnd(&stream);
    return result;
}

TEST(Coding, CanBeUndone) {
    std::mt19937 random(1);
    for (const std::size_t size : {0, 1, 1000, 100000}) {
        std::string text(size, '\0');
        for (char& letter : text) letter = static_cast<char>(random() % 7);
        EXPECT_EQ(unzipped(coded(text, "gzip"), size), text);
        EXPECT_EQ(coded(text, ""), text);
        EXPECT_LE(coded(text, "zstd").size(), 100 + size / 2);
    }
}

}  // namespace
}  // namespace isoatlas

// The Range field of a request.
#include <gtest/gtest.h>

#include "server/byte_ranges.h"

namespace isoatlas {
namespace {

using Ranges = std::vector<FileRange>;

TEST(ByteRanges, FormsOfTheStandard) {
    EXPECT_EQ(byte_ranges("bytes=0-0", 10), (Ranges{{0, 1}}));
    EXPECT_EQ(byte_ranges("bytes=2-", 10), (Ranges{{2, 10}}));
    EXPECT_EQ(byte_ranges("bytes=-3", 10), (Ranges{{7, 10}}));
    EXPECT_EQ(byte_ranges("bytes=-30", 10), (Ranges{{0, 10}}));
    EXPECT_EQ(byte_ranges("bytes=0-1, 5-99", 10), (Ranges{{0, 2}, {5, 10}}));
    EXPECT_EQ(byte_ranges("bytes=10-20", 10), Ranges{});
    EXPECT_EQ(byte_ranges("bytes=0-0", 0), Ranges{});
}

TEST(ByteRanges, AnythingElseIsIgnored) {
    for (const char* field :
         {"", "bytes", "bytes=", "bytes=a-b", "bytes=5-2", "bytes=1-2,", "items=0-1", "bytes=99999999999999999999-", "bytes=1--2"})
        EXPECT_EQ(byte_ranges(field, 10), std::nullopt) << field;
    std::string many = "bytes=0-0";
    for (std::size_t i = 0; i < kMostByteRanges; ++i) many += ",1-1";
    EXPECT_EQ(byte_ranges(many, 10), std::nullopt);
}

}  // namespace
}  // namespace isoatlas

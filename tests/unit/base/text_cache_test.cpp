// Texts stay until there are too many.
#include "base/text_cache.h"

#include <gtest/gtest.h>

namespace isoatlas {
namespace {

TEST(TextCache, ForgetsTheOldest) {
    TextCache texts(2);
    texts.keep("a", "1");
    texts.keep("b", "2");
    texts.keep("a", "other");
    EXPECT_EQ(texts.find("a"), "1");
    texts.keep("c", "3");
    EXPECT_EQ(texts.find("a"), std::nullopt);
    EXPECT_EQ(texts.find("b"), "2");
    EXPECT_EQ(texts.find("c"), "3");
}

}  // namespace
}  // namespace isoatlas

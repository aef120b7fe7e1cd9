// Files name the version that CMake builds.
#include "formats/common/generator.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

TEST(generator, is_the_version_of_the_project) {
    std::ifstream in(ISOATLAS_SOURCE_DIR "/CMakeLists.txt");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_NE(text.find(std::string("project(isoatlas VERSION ") + isoatlas::kVersion + " "), std::string::npos);
    EXPECT_EQ(isoatlas::kGenerator, std::string("isoatlas ") + isoatlas::kVersion);
}

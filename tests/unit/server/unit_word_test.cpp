// unit=um: the unit of a volume whose file says none.
#include "server/unit_word.h"

#include <gtest/gtest.h>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

std::string unit_of(const std::string& of_file, const std::string& word) {
    const std::multimap<std::string, std::string> words{{"unit", word}};
    QueryParameters query(words);
    return unit_of_lengths(query, {.unit = of_file});
}

TEST(UnitWord, IsTakenWhereTheFileSaysNone) {
    EXPECT_EQ(unit_of("", "um"), "\u00b5m");
    EXPECT_EQ(unit_of("", "MM"), "mm");
    EXPECT_EQ(unit_of("mm", "millimetres"), "mm");  // the same
    const std::multimap<std::string, std::string> none;
    QueryParameters query(none);
    EXPECT_EQ(unit_of_lengths(query, {.unit = "mm"}), "mm");
    EXPECT_EQ(unit_of_lengths(query, {}), "");
}

TEST(UnitWord, IsRefusedWhereTheFileSaysAnotherOrItIsNoName) {
    EXPECT_THROW((void)unit_of("mm", "um"), Error);  // numbers would not be converted
    for (const std::string& word : {std::string("voxels"), std::string("a\nb"), std::string(40, 'm'), std::string()})
        EXPECT_THROW((void)unit_of("", word), Error) << word;
}

}  // namespace
}  // namespace isoatlas

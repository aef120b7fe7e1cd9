// Reasons have names that lead back to them.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

TEST(Reason, NamesAreUniqueAndLeadBack) {
    std::set<std::string> names;
    for (std::uint16_t number = 0; number <= static_cast<std::uint16_t>(Reason::bug); ++number) {
        const auto reason = static_cast<Reason>(number);
        EXPECT_TRUE(names.insert(name_of(reason)).second) << number << " has the name of another one, " << name_of(reason);
        EXPECT_EQ(reason_of(name_of(reason)), reason) << number;
    }
    EXPECT_EQ(reason_of("port_in_use"), Reason::port_in_use);
    EXPECT_EQ(reason_of("none"), Reason::none);
    EXPECT_EQ(reason_of(""), std::nullopt);
    EXPECT_EQ(reason_of("Port_in_use"), std::nullopt);
}

TEST(Reason, IsNoPartOfTheMessage) {
    const Error error(ErrorKind::usage, {.what = "a", .next = "b", .reason = Reason::zero_spacing, .value = "c"});
    EXPECT_STREQ(error.what(), "a. Next: b");
    EXPECT_EQ(error.reason(), Reason::zero_spacing);
    EXPECT_EQ(Error(ErrorKind::usage, {.what = "a"}).reason(), Reason::none);
}

}  // namespace
}  // namespace isoatlas

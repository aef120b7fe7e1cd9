#include "server/query_parameters.h"

#include <gtest/gtest.h>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

using Request = std::multimap<std::string, std::string>;

TEST(QueryParameters, AreReadWhole) {
    const Request request{{"tau", "-1.5e3"}, {"max", "20"}, {"object", "3,1,4"}, {"side", "cavity"}};
    QueryParameters words(request);
    EXPECT_EQ(words.number("tau"), -1500.0);
    EXPECT_EQ(words.whole("max", 1, 20), 20);
    EXPECT_EQ(words.list("object", 0, 4, 3), (std::vector<std::int64_t>{3, 1, 4}));
    EXPECT_EQ(words.choice("side", {"object", "cavity"}), "cavity");
    EXPECT_EQ(words.number("missing"), std::nullopt);
    EXPECT_NO_THROW(words.reject_unknown());
}

void expect_refused(const Request& request, const std::string& what) {
    QueryParameters words(request);
    try {
        (void)words.number("tau");
        (void)words.whole("max", 1, 20);
        (void)words.list("object", 0, 4, 3);
        (void)words.choice("side", {"object", "cavity"});
        words.reject_unknown();
        ADD_FAILURE() << what << " was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage) << what;
        EXPECT_FALSE(error.text().expected.empty()) << what;
        EXPECT_LT(error.text().what.size(), 200U) << what;
    }
}

TEST(QueryParameters, AreRefusedWithWhatWasExpected) {
    for (const char* bad : {"", " 1", "1 ", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "one"}) expect_refused({{"tau", bad}}, bad);
    for (const char* bad : {"", "0", "21", "-1", "1.0", "9223372036854775808", "1e1"}) expect_refused({{"max", bad}}, bad);
    for (const char* bad : {"", ",", "1,", ",1", "5", "-1", "1,2,3,4", "1;2"}) expect_refused({{"object", bad}}, bad);
    expect_refused({{"side", "Dark"}}, "another choice");
    expect_refused({{"tau", "1"}, {"tau", "1"}}, "a word said twice");
    expect_refused({{"tauu", "1"}}, "an unknown word");
    expect_refused({{std::string(100000, 'x'), "1"}}, "a very long word");
    expect_refused({{"tau", std::string(100000, '1') + "x"}}, "a very long number");
}

}  // namespace
}  // namespace isoatlas

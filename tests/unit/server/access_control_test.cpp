// Who may ask, by what is carried: the token of programs, or cookie and key of a browser that opened an address for one use.
#include "server/access_control.h"

#include <gtest/gtest.h>

#include <set>

namespace isoatlas {
namespace {

using namespace std::chrono_literals;

class DoorTest : public testing::Test {
protected:
    RequestHead head(const std::string& target) const {
        RequestHead head;
        head.method = "GET";
        head.target = target;
        head.host = "127.0.0.1:80";
        return head;
    }
    int status(const RequestHead& head) {
        const std::optional<std::string> answer = access_.answer(head);
        return answer ? std::stoi(answer->substr(9, 3)) : 200;
    }
    std::string target_for_one_use() { return access_.address_for_one_use().substr(access_.address().size()); }
    static std::string between(const std::string& text, const std::string& before, const std::string& after) {
        const std::size_t begin = text.find(before) + before.size();
        return text.substr(begin, text.find(after, begin) - begin);
    }

    AccessControl::Clock::time_point now_{};
    AccessControl access_{80, {"0123456789abcdef"}, [this] { return now_; }};
};

TEST_F(DoorTest, AProgramCarriesTheToken) {
    RequestHead asked = head("/api/atlas");
    EXPECT_EQ(status(asked), 403);
    for (const char* wrong :
         {"", "Bearer ", "Bearer 0123456789abcde", "Bearer 0123456789abcdeF", "Bearer 0123456789abcdef ", "0123456789abcdef"}) {
        asked.authorization = wrong;
        EXPECT_EQ(status(asked), 403) << wrong;
    }
    asked.authorization = "Bearer 0123456789abcdef";
    EXPECT_EQ(status(asked), 200);
    asked.origin = "http://127.0.0.1:80";
    EXPECT_EQ(status(asked), 200);
    asked.origin = "http://127.0.0.1:81";
    EXPECT_EQ(status(asked), 403);
}

TEST_F(DoorTest, OtherNamesMethodsAndBodiesAreRefusedBeforeTheToken) {
    RequestHead asked = head("/api/atlas");
    for (const char* name : {"", "127.0.0.1", "127.0.0.1:8", "127.0.0.1:800", "evil.example:80", "localhost.:80"}) {
        asked.host = name;
        EXPECT_EQ(status(asked), 421) << name;
    }
    asked.host = "localhost:80";
    asked.method = "POST";
    EXPECT_EQ(status(asked), 405);
    asked.method = "GET";
    asked.has_body = true;
    EXPECT_EQ(status(asked), 413);
}

TEST_F(DoorTest, AnAddressOpensOnceAndNotForLong) {
    const std::string late = target_for_one_use();
    now_ += AccessControl::kCodeTime - 1s;
    const std::string target = target_for_one_use();
    EXPECT_EQ(status(head(target)), 200);
    EXPECT_EQ(status(head(target)), 403);
    now_ += 1s;
    EXPECT_EQ(status(head(late)), 403);
    EXPECT_EQ(status(head("/open?once=")), 403);
    std::set<std::string> targets;
    while (targets.size() < AccessControl::kMaxCodes + 1) targets.insert(target_for_one_use());
    int good = 0;
    for (const std::string& one : targets) good += status(head(one)) == 200 ? 1 : 0;
    EXPECT_EQ(good, static_cast<int>(AccessControl::kMaxCodes));
}

TEST_F(DoorTest, APageNeedsItsCookieAndItsRequestsTheKeyToo) {
    const std::string opened = access_.answer(head(target_for_one_use())).value();
    EXPECT_EQ(opened.find("0123456789abcdef"), std::string::npos) << "a browser never learns the token";
    RequestHead page = head("/?x=1"), asked = head("/api/atlas");
    page.cookie = asked.cookie = "other=1; " + between(opened, "Set-Cookie: ", ";");
    EXPECT_EQ(status(page), 200);
    EXPECT_EQ(status(asked), 403) << "every port of this machine is sent the cookie";
    asked.authorization = "Bearer " + between(opened, "\"isoatlas\",\"", "\"");
    EXPECT_EQ(status(asked), 200);
    for (const char* site : {"same-site", "cross-site"}) {
        asked.fetch_site = page.fetch_site = site;
        EXPECT_EQ(status(asked), 403) << site;
        EXPECT_EQ(status(page), 200) << site;
    }
    asked.fetch_site = {};
    asked.cookie = {};
    EXPECT_EQ(status(asked), 403);
}

}  // namespace
}  // namespace isoatlas

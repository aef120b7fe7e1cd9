// Who may ask, by what is carried: the token of programs, cookie and key of a browser that opened an address for one use, or the key of a
// frame.
#include "server/access_control.h"

#include <gtest/gtest.h>

#include <set>

#include "server/shared_scene.h"
#include "server/target.h"

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
    std::string target_for_one_frame() { return access_.address_for_one_frame().substr(access_.address().size()); }
    /// A request of a new page in a frame, which reaches the server through a proxy.
    RequestHead of_frame(const std::string& target) {
        RequestHead asked = head(target);
        asked.frame_key = access_.open_frame(target_for_one_frame()).value();
        asked.host = "hub.example";
        asked.origin = "https://hub.example";
        return asked;
    }
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

TEST_F(DoorTest, VolumesHaveTheSameDoor) {
    RequestHead asked = head("/volume/12/api/atlas");
    EXPECT_EQ(status(asked), 403);
    asked.authorization = "Bearer 0123456789abcdef";
    EXPECT_EQ(status(asked), 200);
    asked.has_body = true;
    EXPECT_EQ(status(asked), 413);
    RequestHead linked = head("/volume/12/");
    linked.fetch_site = "cross-site";
    const std::optional<std::string> redirected = access_.answer(linked);
    ASSERT_TRUE(redirected);
    EXPECT_NE(redirected->find("Location: /volume/12/enter\r\n"), std::string::npos) << *redirected;
    EXPECT_EQ(status(head("/volume/12/enter")), 200);
    EXPECT_EQ(status(head("/volume/12/../api/atlas")), 403);
    for (const char* other : {"/volume/12", "/volume//", "/volume/-1/", "/volume/x/", "/volume/1234567890/"})
        EXPECT_FALSE(volume_target_of(other).volume) << other;
    EXPECT_EQ(volume_target_of("/volume/12/api/at?voxel=1").rest, "/api/at?voxel=1");
    EXPECT_EQ(volume_target_of("/volume/12/api/at?voxel=1").volume, 12);
}

TEST_F(DoorTest, OnlyAScenesBodyIsRead) {
    RequestHead asked = head("/api/scene?after=1");
    asked.method = "PUT";
    asked.has_body = true;
    EXPECT_EQ(status(asked), 413) << "in chunks: of any length";
    asked.length = kLongestScene + 1;
    EXPECT_EQ(status(asked), 413);
    asked.length = kLongestScene;
    EXPECT_EQ(status(asked), 403);
    asked.authorization = "Bearer 0123456789abcdef";
    EXPECT_EQ(status(asked), 200);
    asked.target = "/api/name?object=1&name=x";
    EXPECT_EQ(status(asked), 413);
    asked.target = "/api/scenery";
    EXPECT_EQ(status(asked), 405);
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

TEST_F(DoorTest, AFrameIsOpenedOnceAndNotForLong) {
    const std::string late = target_for_one_frame();
    now_ += AccessControl::kCodeTime - 1s;
    const std::string target = target_for_one_frame();
    EXPECT_EQ(status(head(target)), 200);
    EXPECT_EQ(status(head(target)), 200) << "asking does not use the code";
    EXPECT_TRUE(access_.open_frame(target));
    EXPECT_FALSE(access_.open_frame(target));
    EXPECT_EQ(status(head(target)), 403);
    now_ += 1s;
    EXPECT_EQ(status(head(late)), 403);
    EXPECT_FALSE(access_.open_frame(late));
    for (const char* wrong : {"/frame?once=", "/frame", "/frame?once=0"}) {
        EXPECT_EQ(status(head(wrong)), 403) << wrong;
        EXPECT_FALSE(access_.open_frame(wrong)) << wrong;
    }
    std::set<std::string> targets;
    while (targets.size() < AccessControl::kMaxCodes + 1) targets.insert(target_for_one_frame());
    int good = 0;
    for (const std::string& one : targets) good += access_.open_frame(one) ? 1 : 0;
    EXPECT_EQ(good, static_cast<int>(AccessControl::kMaxCodes));
}

TEST_F(DoorTest, TheCodeOfAFrameOpensNoTabAndThatOfATabNoFrame) {
    const std::string frame = target_for_one_frame(), tab = target_for_one_use();
    const auto code = [](const std::string& target) { return target.substr(target.find('=') + 1); };
    EXPECT_EQ(status(head("/open?once=" + code(frame))), 403);
    EXPECT_EQ(status(head("/frame?once=" + code(tab))), 403);
    EXPECT_FALSE(access_.open_frame("/frame?once=" + code(tab)));
    EXPECT_EQ(status(head(tab)), 200);
    EXPECT_TRUE(access_.open_frame(frame));
}

TEST_F(DoorTest, AFrameMayStandBelowAnyName) {
    RequestHead opens = head(target_for_one_frame());
    opens.host = "hub.example";
    opens.fetch_site = "cross-site";
    EXPECT_EQ(status(opens), 200);
    opens.method = "HEAD";
    EXPECT_EQ(status(opens), 421) << "only GET opens a frame";
    for (const char* target : {"/api/atlas", "/api/events", "/api/surface?tau=1"}) EXPECT_EQ(status(of_frame(target)), 200) << target;
    RequestHead changes = of_frame("/api/scene");
    changes.method = "PUT";
    EXPECT_EQ(status(changes), 200);
}

TEST_F(DoorTest, AFrameMayNoMoreThanAsk) {
    for (const char* target : {"/", "/enter", "/open?once=1", "/api/address", "/api/address?for=tab", "/api/%61ddress", "/api"})
        EXPECT_EQ(status(of_frame(target)), 403) << target;
    RequestHead asked = of_frame("/api/atlas");
    asked.method = "POST";
    EXPECT_EQ(status(asked), 405);
    asked.method = "GET";
    asked.has_body = true;
    EXPECT_EQ(status(asked), 413);
}

TEST_F(DoorTest, AFrameKeyOpensNothingThatACookieWould) {
    const std::string opened = access_.answer(head(target_for_one_use())).value();
    RequestHead asked = of_frame("/api/atlas");
    const std::string key = asked.frame_key;
    asked.cookie = between(opened, "Set-Cookie: ", ";");
    asked.authorization = "Bearer " + between(opened, "\"isoatlas\",\"", "\"");
    for (const std::string& wrong : {std::string(), key.substr(1), key + "0", std::string(key.size(), '0')}) {
        asked.frame_key = wrong;
        EXPECT_EQ(status(asked), 421) << "the name is not ours, and browsers send cookies by themselves";
    }
    asked.frame_key = key;
    asked.target = "/";
    EXPECT_EQ(status(asked), 403) << "the page of tabs is behind the cookie, which counts under our name only";
    RequestHead other = head("/api/atlas");
    other.authorization = "Bearer " + key;
    EXPECT_EQ(status(other), 403) << "the key is no token";
}

TEST_F(DoorTest, FrameKeysAreNotWithoutBound) {
    RequestHead used = of_frame("/api/atlas"), unused = of_frame("/api/atlas");
    for (std::size_t i = 0; i + 1 < AccessControl::kMaxFrames; ++i) {
        EXPECT_EQ(status(used), 200);
        EXPECT_EQ(status(of_frame("/api/atlas")), 200);
    }
    EXPECT_EQ(status(used), 200) << "the one that was used longest ago expires first";
    EXPECT_EQ(status(unused), 421);
}

TEST_F(DoorTest, OnlyFramesMayBeFramed) {
    const std::string forbids = "frame-ancestors 'none'";
    for (const char* target : {"/", "/enter", "/open?once=1", "/api/atlas", "/nothing"})
        EXPECT_NE(access_.answer(head(target)).value().find(forbids), std::string::npos) << target;
    EXPECT_NE(access_.answer(head(target_for_one_use())).value().find(forbids), std::string::npos);
    const std::string refused = access_.answer(head("/frame?once=1")).value();
    EXPECT_EQ(refused.find(forbids), std::string::npos) << "the reader of a notebook sees why";
    EXPECT_NE(refused.find("default-src 'none'"), std::string::npos);
}

}  // namespace
}  // namespace isoatlas

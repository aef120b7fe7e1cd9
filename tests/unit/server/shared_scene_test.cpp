// The scene that pages in frames and the program around them share: who sets last wins, nobody overwrites what he has not seen.
#include <nlohmann/json.hpp>

#include "unit/server/service_fixture.h"

namespace isoatlas {
namespace {

using Json = nlohmann::json;

class SharedSceneTest : public ServiceTest {
protected:
    static Json scene(double tau) {
        const Json shown = {{"entry", -1},     {"id", nullptr},     {"tau", tau},    {"opacity", 1},
                            {"visible", true}, {"colour", nullptr}, {"walls", "all"}};
        return {{"schema", "isoatlas/scene/1"},
                {"volume", {{"name", "x"}, {"size", {54, 24, 12}}}},
                {"shown", Json::array({shown})},
                {"selected", 0},
                {"view", nullptr},
                {"parts", Json::object()}};
    }
    Response put(const std::string& body, const std::string& client = "page/set scene", const std::string& after = "") {
        std::multimap<std::string, std::string> words;
        if (!after.empty()) words.emplace("after", after);
        return service_->answer({"/api/scene", words, "secret", client, {}, true, body});
    }
    Json told() { return Json::parse(ask("/api/scene").bytes); }
};

TEST_F(SharedSceneTest, IsNoneUntilItIsSet) {
    EXPECT_TRUE(told()["scene"].is_null());
    EXPECT_EQ(told()["version"], 0);
    EXPECT_EQ(service_->scene(), "");
}

TEST_F(SharedSceneTest, IsWhatWasSetLast) {
    EXPECT_EQ(Json::parse(put(scene(0.5).dump()).bytes)["version"], 1);
    EXPECT_EQ(told()["scene"], scene(0.5));
    EXPECT_EQ(told()["client"], "page");
    service_->set_scene(scene(0.25).dump());
    EXPECT_EQ(told()["scene"], scene(0.25));
    EXPECT_EQ(told()["version"], 2);
    EXPECT_EQ(told()["client"], "") << "of the program";
    EXPECT_EQ(Json::parse(service_->scene()), scene(0.25));
}

TEST_F(SharedSceneTest, NobodyOverwritesWhatHeHasNotSeen) {
    EXPECT_EQ(put(scene(0.5).dump(), "a", "0").status, 200);
    EXPECT_EQ(put(scene(0.6).dump(), "b", "0").status, 409);
    EXPECT_EQ(told()["scene"], scene(0.5));
    EXPECT_EQ(put(scene(0.6).dump(), "b", "1").status, 200);
    EXPECT_EQ(told()["scene"], scene(0.6));
}

TEST_F(SharedSceneTest, WhatIsNoSceneIsRefusedAndChangesNothing) {
    ASSERT_EQ(put(scene(0.5).dump()).status, 200);
    Json other = scene(0.5), lacks = scene(0.5);
    other["volume"]["size"] = {54, 24, 13};
    lacks["shown"][0].erase("tau");
    for (const std::string& text :
         {std::string(), std::string("x"), std::string("[]"), std::string(1000, '['), other.dump(), lacks.dump()}) {
        EXPECT_EQ(put(text).status, 400) << text;
        EXPECT_THROW(service_->set_scene(text), Error) << text;
    }
    EXPECT_THROW(service_->set_scene(std::string(kLongestScene + 1, ' ')), Error);
    EXPECT_EQ(put(scene(0.6).dump(), "a", "x").status, 400);
    EXPECT_EQ(told()["version"], 1);
    EXPECT_EQ(told()["scene"], scene(0.5));
}

TEST_F(SharedSceneTest, ListenersHearOfEachVersion) {
    const Response listening = ask("/api/events");
    const auto version = [&] {
        std::string text;
        while (!text.starts_with("event")) text = listening.events->next();
        return Json::parse(text.substr(text.find('{')))["scene"];
    };
    EXPECT_EQ(version(), 0);
    service_->set_scene(scene(0.5).dump());
    EXPECT_EQ(version(), 1);
    ASSERT_EQ(put(scene(0.25).dump()).status, 200);
    EXPECT_EQ(version(), 2);
}

}  // namespace
}  // namespace isoatlas

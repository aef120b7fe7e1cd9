// Any question gets an answer: what was asked for, or a refusal that says why.
#include "server/service.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <random>

#include "isoatlas/build.h"
#include "isoatlas/phantom.h"
#include "oracle/stores.h"

namespace isoatlas::server {
namespace {

class ServiceTest : public oracle::Stores {
protected:
    void SetUp() override {
        build_atlas(path_, make_phantom("torus-chain", {.size = 24}));
        atlas_.emplace(path_);
        service_.emplace(*atlas_, "secret", Context{});
    }

    Answer ask(const std::string& path, std::multimap<std::string, std::string> words = {}, const std::string& token = "secret") {
        return service_->answer({path, std::move(words), token, "test"});
    }

    std::optional<Atlas> atlas_;
    std::optional<Service> service_;
};

TEST_F(ServiceTest, NothingWithoutTheToken) {
    for (const char* token : {"", "Secret", "secre", "secret "}) {
        for (const char* path : {"/api/atlas", "/api/surface", "/nothing"}) EXPECT_EQ(ask(path, {}, token).status, 403) << token;
    }
    EXPECT_EQ(ask("/api/atlas").status, 200);
}

TEST_F(ServiceTest, AnswersAreThoseOfTheStore) {
    const auto json = nlohmann::json::parse(ask("/api/atlas").bytes);
    const ObjectTable table = atlas_->objects();
    ASSERT_GE(json["entries"].size(), table.entries.size());
    EXPECT_EQ(json["entries"][0]["id"], table.entries[0].id);
    EXPECT_TRUE(json["entries"][0]["picture"].is_null());
    const double tau = table.entries[0].best_tau;
    const auto preview = nlohmann::json::parse(ask("/api/preview", {{"tau", std::to_string(tau)}}).bytes);
    EXPECT_EQ(preview["objects"], atlas_->preview(tau).objects);
    const auto objects = nlohmann::json::parse(ask("/api/objects", {{"tau", std::to_string(tau)}, {"top", "1"}}).bytes);
    EXPECT_EQ(objects["count"], atlas_->active(tau).objects.size());
    EXPECT_EQ(objects["objects"].size(), 1U);
    const Answer surface = ask("/api/surface", {{"tau", std::to_string(tau)}});
    ASSERT_EQ(surface.status, 200);
    EXPECT_EQ(surface.headers.at("X-Triangles"), std::to_string(atlas_->extract(tau).triangles.size()));
}

TEST_F(ServiceTest, RefusalsSayWhy) {
    struct Case {
        std::string path;
        std::multimap<std::string, std::string> words;
        int status;
    };
    const std::vector<Case> cases{{"/api/surface", {}, 400},
                                  {"/api/surface", {{"tau", "nan"}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", std::to_string(atlas_->info().extent.voxels())}}, 400},
                                  {"/api/surface", {{"tau", "0.5"}, {"object", "0"}}, 404},
                                  {"/api/surface", {{"tau", "0.5"}, {"most", "0"}}, 400},
                                  {"/api/preview", {{"tau", "0.5"}, {"x", "1"}}, 400},
                                  {"/api/objects", {{"tau", "0.5"}, {"top", "1e9"}}, 400},
                                  {"/api", {}, 404},
                                  {"", {}, 404}};
    for (const Case& c : cases) {
        const Answer answer = ask(c.path, c.words);
        EXPECT_EQ(answer.status, c.status) << c.path << " " << answer.bytes;
        const auto json = nlohmann::json::parse(answer.bytes);
        EXPECT_FALSE(json["error"]["message"].get<std::string>().empty());
    }
}

TEST_F(ServiceTest, RandomQuestionsAreAnswered) {
    std::mt19937 random(7);
    const std::vector<std::string> paths{"/", "/api/atlas", "/api/preview", "/api/objects", "/api/surface", "/api/../api/atlas", "//"};
    const std::vector<std::string> names{"tau", "object", "most", "top", "", "TAU"};
    const std::vector<std::string> values{"0.5",   "-1e308",  "1e308", "nan", "", "0", "1", "99999999999999999999",
                                          "1,2,3", "\xff\0x", "0.5;"};
    for (int i = 0; i < 2000; ++i) {
        std::multimap<std::string, std::string> words;
        for (unsigned k = random() % 4; k > 0; --k) words.emplace(names[random() % names.size()], values[random() % values.size()]);
        const Answer answer = ask(paths[random() % paths.size()], words);
        EXPECT_TRUE(answer.status == 200 || answer.status == 400 || answer.status == 404 || answer.status == 500) << answer.status;
        EXPECT_EQ(answer.bytes.find("a bug"), std::string::npos) << answer.bytes;
    }
}

TEST_F(ServiceTest, AfterTheEndNothingIsMade) {
    service_->end();
    EXPECT_EQ(ask("/api/surface", {{"tau", "0.5"}}).status, 409);
}

}  // namespace
}  // namespace isoatlas::server

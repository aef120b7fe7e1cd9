// What every page asks for first is made once, for all, and before they ask.
#include <array>
#include <nlohmann/json.hpp>

#include "unit/server/service_fixture.h"

namespace isoatlas {
namespace {

TEST_F(ServiceTest, WhatAllAskForIsFoundOnce) {
    std::array<std::string, 4> answers;
    oracle::ask_at_once([&](int asker, const Context&) {
        answers[static_cast<std::size_t>(asker)] = service_->answer({"/api/atlas", {}, "secret", ""}).bytes;
    });
    for (const std::string& answer : answers) EXPECT_TRUE(answer == answers[0]);
    service_->prepare({});
    const std::int64_t extents = atlas_->reads().extents;
    EXPECT_TRUE(ask("/api/atlas").bytes == answers[0]);
    EXPECT_EQ(ask("/api/transfer").status, 200);
    EXPECT_EQ(atlas_->reads().extents, extents);
}

TEST_F(ServiceTest, WhatIsPreparedIsThere) {
    service_->prepare({});
    is_disconnected_ = [] { return true; };
    EXPECT_EQ(ask("/api/atlas").status, 200);  // nothing to wait for
    Service other("secret", {});
    EXPECT_THROW(other.prepare({}), Error);
    other.store_state().open(*atlas_);
    Context stopped;
    stopped.cancelled = [] { return true; };
    EXPECT_THROW(other.prepare(stopped), Error);
    EXPECT_NO_THROW(other.prepare({}));
}

TEST_F(ServiceTest, TheFirstSurfaceIsPrepared) {
    const auto first = nlohmann::json::parse(ask("/api/atlas").bytes)["entries"][0];
    const auto surface = [&](Service& service, const char* max) {
        return service
            .answer({"/api/surface", {{"object", "v" + first["id"].dump()}, {"tau", first["tau"].dump()}, {"max", max}}, "secret", ""})
            .bytes;
    };
    Service prepared("secret", {});
    prepared.store_state().open(*atlas_);
    prepared.prepare({});
    atlas_->clear_cache();
    const std::int64_t bricks = atlas_->reads().bricks;
    const std::string there = surface(prepared, "20000");
    EXPECT_EQ(atlas_->reads().bricks, bricks);
    const std::string other = surface(prepared, "200");
    EXPECT_GT(atlas_->reads().bricks, bricks);
    EXPECT_TRUE(there == surface(*service_, "20000"));
    EXPECT_TRUE(other == surface(*service_, "200"));
    EXPECT_FALSE(there == other);
}

}  // namespace
}  // namespace isoatlas

// Who listens hears every state, the last one at least; who stops listening has no requests any more.
#include "server/event_stream.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "server/shared_scene.h"

namespace isoatlas {
namespace {

class EventStreamTest : public testing::Test {
protected:
    /// The next message that is no comment; nothing when the stream ends.
    static nlohmann::json next(EventStream& stream) {
        for (;;) {
            const std::string text = stream.next();
            if (text.empty()) return {};
            if (text.starts_with(':')) continue;
            EXPECT_TRUE(text.starts_with("event: state\ndata: ") && text.ends_with("\n\n")) << text;
            EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;
            return nlohmann::json::parse(text.substr(text.find('{')));
        }
    }

    VersionCounter changes_;
    StoreState store_state_{changes_};
    JobQueues queues_{changes_};
    SharedScene scene_{{}, changes_};
    EventStreams streams_{store_state_, queues_, scene_, changes_};
};

TEST_F(EventStreamTest, TellsOfTheBuild) {
    const auto stream = streams_.listen("", {});
    EXPECT_EQ(next(*stream)["state"], "building");
    store_state_.report_progress({.phase = "trees", .phase_index = 3, .phase_count = 8, .fraction = 0.25, .seconds_left = 12});
    const nlohmann::json build = next(*stream)["build"];
    EXPECT_EQ(build["phase"], "trees");
    EXPECT_EQ(build["fraction"], 0.25);
    EXPECT_EQ(build["seconds_left"], 12);
    EXPECT_TRUE(build["voxels_per_second"].is_null());
    store_state_.fail(Error(ErrorKind::resource, {.what = "the disk is full", .next = "make room"}));
    const nlohmann::json failed = next(*stream);
    EXPECT_EQ(failed["state"], "failed");
    EXPECT_EQ(failed["error"]["next"], "make room");
}

TEST_F(EventStreamTest, TellsAClientOfItsOwnRequests) {
    const auto stream = streams_.listen("me", {});
    EXPECT_TRUE(next(*stream)["requests"].empty());
    JobQueue& cards = queues_.of(QueueClass::cards);
    const auto other = cards.acquire("you/card");
    const auto slice = queues_.of(QueueClass::samples).acquire("me/slice");
    std::thread asker([&] { EXPECT_THROW((void)cards.acquire("me/card"), Error); });
    while (cards.waiting() < 1) std::this_thread::yield();
    nlohmann::json requests;
    while (requests.size() < 2) requests = next(*stream)["requests"];
    EXPECT_EQ(requests[0]["client"], "me/slice");
    EXPECT_EQ(requests[0]["queue"], "samples");
    EXPECT_EQ(requests[0]["place"], 0);
    EXPECT_EQ(requests[1]["client"], "me/card");
    EXPECT_EQ(requests[1]["queue"], "cards");
    EXPECT_EQ(requests[1]["place"], 1);
    queues_.leave("me");
    EXPECT_TRUE(slice->is_cancelled());
    asker.join();
}

TEST_F(EventStreamTest, TheLastStreamOfAClientTakesItsRequestsAlong) {
    auto first = streams_.listen("me", {}), second = streams_.listen("me", {});
    const auto job = queues_.of(QueueClass::trees).acquire("me/objects");
    first.reset();
    EXPECT_FALSE(job->is_cancelled());
    second.reset();
    EXPECT_TRUE(job->is_cancelled());
}

TEST_F(EventStreamTest, EndsWithTheServerOrTheClient) {
    bool gone = false;
    const auto stream = streams_.listen("me", [&gone] { return gone; });
    EXPECT_FALSE(stream->next().empty());
    gone = true;
    EXPECT_TRUE(stream->next().empty());
    const auto other = streams_.listen("you", {});
    streams_.end();
    EXPECT_TRUE(other->next().empty());
}

TEST_F(EventStreamTest, AreNotWithoutBound) {
    std::vector<std::shared_ptr<EventStream>> all;
    EXPECT_THROW(for (int i = 0; i < 1000; ++i) all.push_back(streams_.listen("me", {})), Error);
    EXPECT_LT(all.size(), 1000U);
    all.pop_back();
    EXPECT_NO_THROW((void)streams_.listen("you", {}));
}

}  // namespace
}  // namespace isoatlas

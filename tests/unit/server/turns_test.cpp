#include "server/turns.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

ErrorKind kind_of_refusal(Turns& turns, const std::string& client, const Left& left = {}) {
    try {
        (void)turns.take(client, left);
    } catch (const Error& error) {
        return error.kind();
    }
    return ErrorKind::internal;
}

TEST(Turns, ANewerQuestionEndsAnOlderOne) {
    Turns turns(2, 10);
    const auto first = turns.take("a");
    EXPECT_FALSE(first->is_over());
    const auto second = turns.take("a");
    EXPECT_TRUE(first->is_over());
    EXPECT_FALSE(second->is_over());
}

TEST(Turns, OthersAreNotEnded) {
    Turns turns(3, 10);
    const auto a = turns.take("a"), b = turns.take("b"), nobody = turns.take("");
    EXPECT_FALSE(a->is_over());
    EXPECT_FALSE(b->is_over());
    EXPECT_FALSE(nobody->is_over());
}

TEST(Turns, OneThatWaitsIsEnded) {
    Turns turns(1, 10);
    auto holder = turns.take("a");
    std::atomic<int> cancelled = 0, served = 0;
    std::vector<std::thread> askers;
    for (int i = 0; i < 4; ++i) {
        askers.emplace_back([&] {
            try {
                const auto turn = turns.take("b");
                ++served;
            } catch (const Error& error) {
                cancelled += error.kind() == ErrorKind::cancelled;
            }
        });
    }
    while (cancelled < 3) std::this_thread::yield();  // only the newest waits on
    holder.reset();
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(served, 1);
    EXPECT_EQ(cancelled, 3);
}

TEST(Turns, NeverMoreAtOnceThanAllowed) {
    Turns turns(2, 100);
    std::atomic<int> running = 0, most = 0, served = 0;
    std::vector<std::thread> askers;
    for (int i = 0; i < 24; ++i) {
        askers.emplace_back([&] {
            const auto turn = turns.take("");
            const int now = ++running;
            for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
            }
            std::this_thread::yield();
            --running;
            ++served;
        });
    }
    for (std::thread& asker : askers) asker.join();
    EXPECT_LE(most, 2);
    EXPECT_EQ(served, 24);
}

TEST(Turns, ComeInTheOrderOfTheQuestions) {
    Turns turns(1, 100);
    auto holder = turns.take("first");
    std::vector<int> served;
    std::vector<std::thread> askers;
    for (int i = 0; i < 8; ++i) {
        askers.emplace_back([&turns, &served, i] {
            const auto turn = turns.take("client " + std::to_string(i));
            served.push_back(i);  // one at a time
        });
        while (turns.waiting() <= i) std::this_thread::yield();
    }
    holder.reset();
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(served, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Turns, WhoHasLeftIsEnded) {
    Turns turns(1, 10);
    auto holder = turns.take("a");
    std::atomic<bool> gone = false;
    std::atomic<int> cancelled = 0;
    std::thread asker([&] { cancelled += kind_of_refusal(turns, "b", [&gone] { return gone.load(); }) == ErrorKind::cancelled; });
    while (turns.waiting() < 1) std::this_thread::yield();
    gone = true;
    asker.join();  // though nobody gives a turn back
    EXPECT_EQ(cancelled, 1);
    EXPECT_EQ(turns.waiting(), 0);
    const auto with_left = [&gone] { return gone.load(); };
    holder.reset();
    gone = false;
    const auto turn = turns.take("c", with_left);
    EXPECT_FALSE(turn->is_over());
    gone = true;
    EXPECT_TRUE(turn->is_over());
}

TEST(Turns, ALeavingClientEndsItsLanesAlone) {
    Turns turns(4, 10);
    const auto a = turns.take("a/surface 1"), b = turns.take("a/file"), plain = turns.take("a"), other = turns.take("ab/surface 1");
    turns.leave("a");
    EXPECT_TRUE(a->is_over());
    EXPECT_TRUE(b->is_over());
    EXPECT_TRUE(plain->is_over());
    EXPECT_FALSE(other->is_over());
}

TEST(Turns, ANewerQuestionKeepsThePlace) {
    Turns turns(1, 10);
    auto holder = turns.take("holder");
    std::vector<std::string> served;
    std::atomic<int> ended = 0;
    std::vector<std::thread> askers;
    const auto ask = [&](const std::string& client, int waiting) {
        askers.emplace_back([&turns, &served, &ended, client] {
            try {
                const auto turn = turns.take(client);
                served.push_back(client);  // one at a time
            } catch (const Error&) {
                ++ended;
            }
        });
        while (turns.waiting() < waiting) std::this_thread::yield();
    };
    ask("a", 1);
    ask("b", 2);
    ask("a", 2);
    while (ended < 1) std::this_thread::yield();  // the first
    EXPECT_EQ(turns.pending("a")[0].place, 1);
    EXPECT_EQ(turns.pending("b")[0].place, 2);
    holder.reset();
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(served, (std::vector<std::string>{"a", "b"}));
}

TEST(Turns, TellWhatIsPending) {
    Changes changes;
    Turns turns(1, 10, &changes);
    const auto turn = turns.take("a/one");
    const std::uint64_t before = changes.count();
    turn->tell(0.5);
    EXPECT_GT(changes.count(), before);
    ASSERT_EQ(turns.pending("a").size(), 1U);
    EXPECT_EQ(turns.pending("a")[0].client, "a/one");
    EXPECT_EQ(turns.pending("a")[0].place, 0);
    EXPECT_EQ(turns.pending("a")[0].fraction, 0.5);
    EXPECT_TRUE(turns.pending("b").empty());
}

TEST(Turns, TooManyAreRefused) {
    Turns turns(1, 0);
    EXPECT_EQ(kind_of_refusal(turns, "a"), ErrorKind::resource);
}

TEST(Turns, TheEndIsTheEndOfAll) {
    Turns turns(2, 10);
    const auto turn = turns.take("a");
    turns.end();
    EXPECT_TRUE(turn->is_over());
    EXPECT_EQ(kind_of_refusal(turns, "b"), ErrorKind::cancelled);
}

}  // namespace
}  // namespace isoatlas

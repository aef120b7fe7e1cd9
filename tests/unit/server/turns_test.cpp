#include "server/turns.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas::server {
namespace {

ErrorKind kind_of_refusal(Turns& turns, const std::string& client) {
    try {
        (void)turns.take(client);
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
}  // namespace isoatlas::server

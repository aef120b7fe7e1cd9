#include "server/job_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

ErrorKind kind_of_refusal(JobQueue& queue, const std::string& client, const IsDisconnected& is_disconnected = {}) {
    try {
        (void)queue.acquire(client, is_disconnected);
    } catch (const Error& error) {
        return error.kind();
    }
    return ErrorKind::internal;
}

TEST(JobQueue, ANewerRequestEndsAnOlderOne) {
    JobQueue queue(2, 10);
    const auto first = queue.acquire("a");
    EXPECT_FALSE(first->is_cancelled());
    const auto second = queue.acquire("a");
    EXPECT_TRUE(first->is_cancelled());
    EXPECT_FALSE(second->is_cancelled());
}

TEST(JobQueue, OthersAreNotEnded) {
    JobQueue queue(3, 10);
    const auto a = queue.acquire("a"), b = queue.acquire("b"), nobody = queue.acquire("");
    EXPECT_FALSE(a->is_cancelled());
    EXPECT_FALSE(b->is_cancelled());
    EXPECT_FALSE(nobody->is_cancelled());
}

TEST(JobQueue, OneThatWaitsIsEnded) {
    JobQueue queue(1, 10);
    auto holder = queue.acquire("a");
    std::atomic<int> cancelled = 0, served = 0;
    std::vector<std::thread> askers;
    for (int i = 0; i < 4; ++i) {
        askers.emplace_back([&] {
            try {
                const auto job = queue.acquire("b");
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

TEST(JobQueue, NeverMoreAtOnceThanAllowed) {
    JobQueue queue(2, 100);
    std::atomic<int> running = 0, max = 0, served = 0;
    std::vector<std::thread> askers;
    for (int i = 0; i < 24; ++i) {
        askers.emplace_back([&] {
            const auto job = queue.acquire("");
            const int now = ++running;
            for (int seen = max; now > seen && !max.compare_exchange_weak(seen, now);) {
            }
            std::this_thread::yield();
            --running;
            ++served;
        });
    }
    for (std::thread& asker : askers) asker.join();
    EXPECT_LE(max, 2);
    EXPECT_EQ(served, 24);
}

TEST(JobQueue, ComeInTheOrderOfTheRequests) {
    JobQueue queue(1, 100);
    auto holder = queue.acquire("first");
    std::vector<int> served;
    std::vector<std::thread> askers;
    for (int i = 0; i < 8; ++i) {
        askers.emplace_back([&queue, &served, i] {
            const auto job = queue.acquire("client " + std::to_string(i));
            served.push_back(i);  // one at a time
        });
        while (queue.waiting() <= i) std::this_thread::yield();
    }
    holder.reset();
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(served, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(JobQueue, WhoHasLeftIsEnded) {
    JobQueue queue(1, 10);
    auto holder = queue.acquire("a");
    std::atomic<bool> gone = false;
    std::atomic<int> cancelled = 0;
    std::thread asker([&] { cancelled += kind_of_refusal(queue, "b", [&gone] { return gone.load(); }) == ErrorKind::cancelled; });
    while (queue.waiting() < 1) std::this_thread::yield();
    gone = true;
    asker.join();  // though nobody gives a turn back
    EXPECT_EQ(cancelled, 1);
    EXPECT_EQ(queue.waiting(), 0);
    const auto with_left = [&gone] { return gone.load(); };
    holder.reset();
    gone = false;
    const auto job = queue.acquire("c", with_left);
    EXPECT_FALSE(job->is_cancelled());
    gone = true;
    EXPECT_TRUE(job->is_cancelled());
}

TEST(JobQueue, ALeavingClientEndsItsLanesAlone) {
    JobQueue queue(4, 10);
    const auto a = queue.acquire("a/surface 1"), b = queue.acquire("a/file"), plain = queue.acquire("a"),
               other = queue.acquire("ab/surface 1");
    queue.leave("a");
    EXPECT_TRUE(a->is_cancelled());
    EXPECT_TRUE(b->is_cancelled());
    EXPECT_TRUE(plain->is_cancelled());
    EXPECT_FALSE(other->is_cancelled());
}

TEST(JobQueue, ANewerRequestKeepsThePlace) {
    JobQueue queue(1, 10);
    auto holder = queue.acquire("holder");
    std::vector<std::string> served;
    std::atomic<int> ended = 0;
    std::vector<std::thread> askers;
    const auto ask = [&](const std::string& client, int waiting) {
        askers.emplace_back([&queue, &served, &ended, client] {
            try {
                const auto job = queue.acquire(client);
                served.push_back(client);  // one at a time
            } catch (const Error&) {
                ++ended;
            }
        });
        while (queue.waiting() < waiting) std::this_thread::yield();
    };
    ask("a", 1);
    ask("b", 2);
    ask("a", 2);
    while (ended < 1) std::this_thread::yield();  // the first
    EXPECT_EQ(queue.pending("a")[0].place, 1);
    EXPECT_EQ(queue.pending("b")[0].place, 2);
    holder.reset();
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(served, (std::vector<std::string>{"a", "b"}));
}

TEST(JobQueue, TellWhatIsPending) {
    VersionCounter changes;
    JobQueue queue(1, 10, &changes);
    const auto job = queue.acquire("a/one");
    const std::uint64_t before = changes.count();
    job->report_progress(0.5);
    EXPECT_GT(changes.count(), before);
    ASSERT_EQ(queue.pending("a").size(), 1U);
    EXPECT_EQ(queue.pending("a")[0].client, "a/one");
    EXPECT_EQ(queue.pending("a")[0].place, 0);
    EXPECT_EQ(queue.pending("a")[0].fraction, 0.5);
    EXPECT_TRUE(queue.pending("b").empty());
}

TEST(JobQueue, TooManyAreRefused) {
    JobQueue queue(1, 0);
    EXPECT_EQ(kind_of_refusal(queue, "a"), ErrorKind::resource);
}

TEST(JobQueue, TheEndIsTheEndOfAll) {
    JobQueue queue(2, 10);
    const auto job = queue.acquire("a");
    queue.end();
    EXPECT_TRUE(job->is_cancelled());
    EXPECT_EQ(kind_of_refusal(queue, "b"), ErrorKind::cancelled);
}

}  // namespace
}  // namespace isoatlas

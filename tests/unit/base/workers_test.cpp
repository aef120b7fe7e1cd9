// Jobs that wait for each other run at the same time, up to the number of threads; all are done before their workers end.
#include "base/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>

namespace isoatlas {
namespace {

TEST(Workers, AsManyJobsAtATimeAsThereMayBeThreads) {
    constexpr int most = 8;
    std::latch together(most);
    std::atomic<int> done = 0;
    Workers workers(most);
    for (int i = 0; i < most; ++i) {
        ASSERT_TRUE(workers.post([&] {
            together.arrive_and_wait();  // forever, if one of them had to wait for another
            ++done;
        }));
    }
    workers.wait();
    EXPECT_EQ(done, most);
}

TEST(Workers, AllJobsAreDoneInTheEnd) {
    std::atomic<int> done = 0, running = 0, most = 0;
    {
        Workers workers(3);
        for (int i = 0; i < 1000; ++i) {
            ASSERT_TRUE(workers.post([&] {
                const int now = ++running;
                for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
                }
                --running;
                ++done;
            }));
        }
    }
    EXPECT_EQ(done, 1000);
    EXPECT_LE(most, 3);
}

}  // namespace
}  // namespace isoatlas

// Jobs that wait for each other run at the same time, up to the number of threads; all are done before their workers end.
#include "base/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <latch>

namespace isoatlas {
namespace {

TEST(Workers, AsManyJobsAtATimeAsThereMayBeThreads) {
    constexpr int max = 8;
    std::latch together(max);
    std::atomic<int> done = 0;
    Workers workers(max);
    for (int i = 0; i < max; ++i) {
        ASSERT_TRUE(workers.post([&] {
            together.arrive_and_wait();  // forever, if one of them had to wait for another
            ++done;
        }));
    }
    workers.wait();
    EXPECT_EQ(done, max);
}

TEST(Workers, AllJobsAreDoneInTheEnd) {
    std::atomic<int> done = 0, running = 0, max = 0;
    {
        Workers workers(3);
        for (int i = 0; i < 1000; ++i) {
            ASSERT_TRUE(workers.post([&] {
                const int now = ++running;
                for (int seen = max; seen < now && !max.compare_exchange_weak(seen, now);) {
                }
                --running;
                ++done;
            }));
        }
    }
    EXPECT_EQ(done, 1000);
    EXPECT_LE(max, 3);
}

}  // namespace
}  // namespace isoatlas

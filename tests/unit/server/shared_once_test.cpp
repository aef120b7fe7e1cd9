// A value for all is made once, on behalf of whoever still wants it.
#include "server/shared_once.h"

#include <gtest/gtest.h>

#include <thread>

namespace isoatlas {
namespace {

Context wanted_while(const std::atomic<bool>& is_disconnected) {
    Context context;
    context.cancelled = [&is_disconnected] { return is_disconnected.load(); };
    return context;
}

/// Works until nobody wants the answer.
int work(const Context& context) {
    for (;;) {
        stop_if_cancelled(context);
        std::this_thread::yield();
    }
}

TEST(SharedTest, IsMadeOnceForAllWhoAsk) {
    SharedOnce<int> shared;
    EXPECT_EQ(shared.there(), nullptr);
    std::atomic<int> made = 0;
    std::vector<std::thread> askers;
    for (int i = 0; i < 8; ++i) {
        askers.emplace_back([&] {
            EXPECT_EQ(shared.get({},
                                 [&](const Context&) {
                                     std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                     return ++made;
                                 }),
                      1);
        });
    }
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(*shared.there(), 1);
}

TEST(SharedTest, EndsWhenNobodyWantsItAnyMore) {
    SharedOnce<int> shared;
    std::array<std::atomic<bool>, 2> is_disconnected{};
    std::atomic<int> ended = 0;
    std::vector<std::thread> askers;
    for (std::size_t i = 0; i < is_disconnected.size(); ++i) {
        askers.emplace_back([&, i] {
            EXPECT_THROW((void)shared.get(wanted_while(is_disconnected[i]), work), Error);
            ++ended;
        });
    }
    is_disconnected[0] = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    EXPECT_LE(ended, 1);  // who has left need not wait, but the work goes on for the other
    is_disconnected[1] = true;
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(shared.get({}, [](const Context&) { return 7; }), 7);
}

TEST(SharedTest, WhoStillWantsItMakesItWhenSomebodyElseFails) {
    SharedOnce<int> shared;
    std::atomic<bool> begun = false, fails = false;
    std::thread first([&] {
        EXPECT_THROW((void)shared.get({},
                                      [&](const Context&) -> int {
                                          begun = true;
                                          while (!fails) std::this_thread::yield();
                                          throw Error(ErrorKind::input, {.what = "damaged"});
                                      }),
                     Error);
    });
    while (!begun) std::this_thread::yield();
    std::thread second([&] { EXPECT_EQ(shared.get({}, [](const Context&) { return 3; }), 3); });
    fails = true;
    first.join();
    second.join();
}

}  // namespace
}  // namespace isoatlas

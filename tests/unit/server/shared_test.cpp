// A value for all is made once, on behalf of whoever still wants it.
#include "server/shared.h"

#include <gtest/gtest.h>

#include <thread>

namespace isoatlas {
namespace {

Context wanted_while(const std::atomic<bool>& left) {
    Context context;
    context.cancelled = [&left] { return left.load(); };
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
    Shared<int> shared;
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
    Shared<int> shared;
    std::array<std::atomic<bool>, 2> left{};
    std::atomic<int> ended = 0;
    std::vector<std::thread> askers;
    for (std::size_t i = 0; i < left.size(); ++i) {
        askers.emplace_back([&, i] {
            EXPECT_THROW((void)shared.get(wanted_while(left[i]), work), Error);
            ++ended;
        });
    }
    left[0] = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    EXPECT_LE(ended, 1);  // who has left need not wait, but the work goes on for the other
    left[1] = true;
    for (std::thread& asker : askers) asker.join();
    EXPECT_EQ(shared.get({}, [](const Context&) { return 7; }), 7);
}

TEST(SharedTest, WhoStillWantsItMakesItWhenSomebodyElseFails) {
    Shared<int> shared;
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

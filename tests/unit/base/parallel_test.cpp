// Where the system refuses threads, every caller is told and none waits without end; later calls get them.
#include "base/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <latch>
#include <thread>
#include <vector>

#include <unistd.h>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take memory of their own

constexpr int kCallers = 8;
constexpr std::int64_t kBlocks = 100;

rlim_t address_space() {
    std::ifstream statm("/proc/self/statm");
    rlim_t pages = 0;
    statm >> pages;
    return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

bool is_refused(std::atomic<std::int64_t>& done) try {
    for_each_block(2, kBlocks, [&](std::int64_t) { ++done; });
    return false;
} catch (const Error& error) {
    return error.kind() == ErrorKind::resource && error.reason() == Reason::threads_refused;
}

/// All callers at once without memory for a thread, then again with it. 0: as it should be.
int code_of_callers() {
    std::atomic<int> refused = 0, refused_again = 0;
    std::atomic<std::int64_t> done = 0;
    std::latch ready(kCallers + 1), limited(1), told(kCallers), unlimited(1);
    std::vector<std::thread> callers;
    for (int i = 0; i < kCallers; ++i) {
        callers.emplace_back([&] {
            ready.count_down();
            limited.wait();
            if (is_refused(done)) ++refused;
            told.count_down();
            unlimited.wait();
            if (is_refused(done)) ++refused_again;
        });
    }
    ready.arrive_and_wait();
    rlimit before{};
    if (::getrlimit(RLIMIT_AS, &before) != 0) return 1;
    const rlimit none{.rlim_cur = address_space() + (1 << 20), .rlim_max = before.rlim_max};
    if (::setrlimit(RLIMIT_AS, &none) != 0) return 2;
    limited.count_down();
    told.wait();
    if (::setrlimit(RLIMIT_AS, &before) != 0) return 3;
    unlimited.count_down();
    for (std::thread& caller : callers) caller.join();
    if (refused != kCallers) return 4;
    if (refused_again != 0) return 5;
    return done == kCallers * kBlocks ? 0 : 6;
}

TEST(Parallel, CallersWithoutThreadsAreToldAndTryAgain) {
    if (thread_count(0) == 1) GTEST_SKIP() << "one processor: no threads are started";
    GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own: no thread of oneTBB has started
    EXPECT_EXIT(std::_Exit(code_of_callers()), testing::ExitedWithCode(0), "");
}

#endif

}  // namespace
}  // namespace isoatlas

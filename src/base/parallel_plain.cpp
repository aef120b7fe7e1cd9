// The interface of parallel.h with the standard library alone, for builds with the thread sanitizer: oneTBB is not instrumented, so the
// sanitizer would not see how TBB orders what the caller wrote, what a block does and what the caller reads afterwards, and would report
// false races.
#ifdef __SANITIZE_THREAD__

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "isoatlas/environment.h"

namespace isoatlas {

int thread_count(int requested) {
    if (requested <= 0) requested = current_environment().threads;
    return requested > 0 ? requested : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void for_each_block(int threads, std::int64_t blocks, const std::function<void(std::int64_t)>& work) {
    std::atomic<std::int64_t> next{0};
    std::exception_ptr first_error;
    std::mutex error_lock;
    const Environment& environment = current_environment();
    const auto take_blocks = [&] {
        const EnvironmentScope scope(environment);
        for (std::int64_t block; (block = next++) < blocks;) try {
                work(block);
            } catch (...) {
                const std::lock_guard hold(error_lock);
                if (!first_error) first_error = std::current_exception();
                next = blocks;
            }
    };
    std::vector<std::thread> helpers;
    try {
        for (std::int64_t i = 1; i < std::min<std::int64_t>(thread_count(threads), blocks); ++i) helpers.emplace_back(take_blocks);
    } catch (const std::system_error&) {  // fewer threads suffice
    }
    take_blocks();
    for (std::thread& helper : helpers) helper.join();
    if (first_error) std::rethrow_exception(first_error);
}

void run_both(int threads, const std::function<void()>& first, const std::function<void()>& second) {
    for_each_block(threads, 2, [&](std::int64_t block) { block == 0 ? first() : second(); });
}

void with_threads(int /*threads*/, const std::function<void()>& job) { job(); }

}  // namespace isoatlas

#endif

#ifndef __SANITIZE_THREAD__  // base/parallel_plain.cpp then

#include "base/parallel.h"

#include <pthread.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <latch>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "base/budget_poll.h"
#include "base/refusals.h"
#include "isoatlas/environment.h"

namespace isoatlas {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kRefusal = "pthread_";          ///< oneTBB reports a refused thread by a runtime_error with the name of the call
constexpr std::chrono::milliseconds kStartTime{100};  ///< others may keep the threads of an arena busy

/// Of a thread that starts: for what oneTBB allocates there, whose failure would end the process.
constexpr std::size_t kRoom = 1 << 16;

struct Trial {
    std::latch all_started{1};
    std::atomic<int> without_room = 0;
};

void* start_with_room(void* trial_of_all) {
    auto& trial = *static_cast<Trial*>(trial_of_all);
    const std::unique_ptr<volatile std::byte[]> room(new (std::nothrow) volatile std::byte[kRoom]);
    if (room)
        room[0] = std::byte{1};  // or the compiler may leave it out
    else
        ++trial.without_room;
    trial.all_started.wait();
    return nullptr;
}

/// Starts and ends as many threads as oneTBB will. The C library keeps their stacks and what they allocate, which the next threads get.
/// Throws Error{resource} where the system refuses a thread or its memory.
void check_can_start(int count) {
    std::vector<pthread_t> threads;
    threads.reserve(count);
    pthread_attr_t attributes;
    (void)pthread_attr_init(&attributes);
    (void)pthread_attr_setstacksize(&attributes, tbb::global_control::active_value(tbb::global_control::thread_stack_size));
    Trial trial;
    int refusal = 0;
    for (pthread_t thread{}; refusal == 0 && std::ssize(threads) < count;) {
        refusal = pthread_create(&thread, &attributes, start_with_room, &trial);
        if (refusal == 0) threads.push_back(thread);
    }
    trial.all_started.count_down();
    for (const pthread_t thread : threads) (void)pthread_join(thread, nullptr);
    (void)pthread_attr_destroy(&attributes);
    if (refusal == 0 && trial.without_room > 0) refusal = ENOMEM;
    if (refusal != 0) throw threads_refused(std::generic_category().message(refusal));
}

/// Returns when all threads of an arena have started, or after kStartTime.
void start_threads(tbb::task_arena& arena, int threads) {
    std::atomic<int> started = 0;
    const Clock::time_point until = Clock::now() + kStartTime;
    arena.execute([&] {
        const auto wait = [&](int) {
            ++started;
            while (started < threads && Clock::now() < until) std::this_thread::yield();
        };
        tbb::parallel_for(0, threads, 1, wait, tbb::simple_partitioner());
    });
}

/// Arenas live as long as the process: making one costs more than a small analysis. More threads than processors are not started.
///
/// Threads are started with an arena, not by its first work: where the system refuses one later, other threads in an arena wait without
/// end.
class Arenas {
public:
    /// Null: the calling thread works alone, because the system has refused a thread to oneTBB, which can start none after that.
    tbb::task_arena* of(int threads) {
        threads = std::min(threads, tbb::info::default_concurrency());
        const std::lock_guard hold(lock_);
        if (is_refused_) return nullptr;
        std::unique_ptr<tbb::task_arena>& arena = arenas_[threads];
        if (!arena) {
            check_can_start(threads - 1);
            auto made = std::make_unique<tbb::task_arena>(threads);
            made->initialize();  // where memory is missing it throws, and every later call of that arena would wait without end
            start_threads(*made, threads);
            arena = std::move(made);
        }
        return arena.get();
    }

    void refuse() {
        const std::lock_guard hold(lock_);
        is_refused_ = true;
    }

private:
    std::map<int, std::unique_ptr<tbb::task_arena>> arenas_;
    std::mutex lock_;
    bool is_refused_ = false;
};

Arenas& arenas() {
    static auto* const all = new Arenas;
    return *all;
}

/// Runs work in an arena, or alone() on the calling thread.
template <class Work, class Alone>
void execute(int threads, const Work& work, const Alone& alone) try {
    if (tbb::task_arena* const arena = arenas().of(threads))
        arena->execute(work);
    else
        alone();
} catch (const Error&) {
    throw;
} catch (const std::runtime_error& error) {
    if (!std::string_view(error.what()).starts_with(kRefusal)) throw;
    arenas().refuse();
    throw threads_refused(error.what());
}

}  // namespace

int thread_count(int requested) {
    if (requested <= 0) requested = current_environment().threads;
    return requested > 0 ? requested : tbb::info::default_concurrency();
}

void for_each_block(int threads, std::int64_t blocks, const std::function<void(std::int64_t)>& block_work) {
    const Environment& environment = current_environment();
    const auto work = [&](std::int64_t block) {
        const EnvironmentScope scope(environment);  // of each block: a thread that waits for others does blocks of other calls meanwhile
        block_work(block);
        check_memory();
    };
    const auto alone = [&] {
        for (std::int64_t block = 0; block < blocks; ++block) work(block);
    };
    if (thread_count(threads) == 1 || blocks <= 1) return alone();
    const auto together = [&] { tbb::parallel_for(std::int64_t{0}, blocks, std::int64_t{1}, work, tbb::simple_partitioner()); };
    execute(thread_count(threads), together, alone);
}

void run_both(int threads, const std::function<void()>& first, const std::function<void()>& second) {
    const auto alone = [&] {
        first();
        second();
    };
    if (thread_count(threads) == 1) return alone();
    const Environment& environment = current_environment();
    const auto in_environment = [&environment](const std::function<void()>& job) {
        return [&] {
            const EnvironmentScope scope(environment);
            job();
        };
    };
    execute(thread_count(threads), [&] { tbb::parallel_invoke(in_environment(first), in_environment(second)); }, alone);
}

void with_threads(int threads, const std::function<void()>& job) {
    const Environment& environment = current_environment();
    const auto in_arena = [&] {  // perhaps on another thread, where the arena has none left
        const EnvironmentScope scope(environment);
        job();
    };
    execute(thread_count(threads), in_arena, job);
}

}  // namespace isoatlas

#endif

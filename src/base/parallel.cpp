#ifndef __SANITIZE_THREAD__  // base/parallel_plain.cpp then

#include "base/parallel.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string_view>

#include "base/budget_poll.h"
#include "base/refusals.h"
#include "isoatlas/environment.h"

namespace isoatlas {
namespace {

/// Arenas live as long as the process: making one costs more than a small analysis. More threads than processors are not started.
tbb::task_arena& arena_of(int threads) {
    static auto* const arenas = new std::map<int, std::unique_ptr<tbb::task_arena>>;
    static std::mutex lock;
    const std::lock_guard hold(lock);
    std::unique_ptr<tbb::task_arena>& arena = (*arenas)[std::min(threads, tbb::info::default_concurrency())];
    if (!arena) {
        auto made = std::make_unique<tbb::task_arena>(std::min(threads, tbb::info::default_concurrency()));
        made->initialize();  // where memory is missing it throws, and every later call of that arena would wait without end
        arena = std::move(made);
    }
    return *arena;
}

/// Runs work in an arena. oneTBB reports a refused thread by a runtime_error with the name of the call.
template <class Work>
void execute(int threads, const Work& work) try {
    arena_of(threads).execute(work);
} catch (const Error&) {
    throw;
} catch (const std::runtime_error& error) {
    if (std::string_view(error.what()).starts_with("pthread_")) throw threads_refused(error.what());
    throw;
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
    if (thread_count(threads) == 1 || blocks <= 1) {
        for (std::int64_t block = 0; block < blocks; ++block) work(block);
        return;
    }
    execute(thread_count(threads), [&] { tbb::parallel_for(std::int64_t{0}, blocks, std::int64_t{1}, work, tbb::simple_partitioner()); });
}

void run_both(int threads, const std::function<void()>& first, const std::function<void()>& second) {
    if (thread_count(threads) == 1) {
        first();
        second();
        return;
    }
    const Environment& environment = current_environment();
    const auto in_environment = [&environment](const std::function<void()>& job) {
        return [&] {
            const EnvironmentScope scope(environment);
            job();
        };
    };
    execute(thread_count(threads), [&] { tbb::parallel_invoke(in_environment(first), in_environment(second)); });
}

void with_threads(int threads, const std::function<void()>& job) {
    const Environment& environment = current_environment();
    execute(thread_count(threads), [&] {  // perhaps on another thread, where the arena has none left
        const EnvironmentScope scope(environment);
        job();
    });
}

}  // namespace isoatlas

#endif

#ifndef __SANITIZE_THREAD__  // base/parallel_plain.cpp then

#include "base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

namespace isoatlas {

int thread_count(int requested) { return requested > 0 ? requested : tbb::this_task_arena::max_concurrency(); }

void for_each_block(int threads, std::int64_t blocks, const std::function<void(std::int64_t)>& work) {
    if (thread_count(threads) == 1 || blocks <= 1) {
        for (std::int64_t block = 0; block < blocks; ++block) work(block);
        return;
    }
    tbb::task_arena arena(thread_count(threads));
    arena.execute([&] { tbb::parallel_for(std::int64_t{0}, blocks, std::int64_t{1}, work, tbb::simple_partitioner()); });
}

void run_both(int threads, const std::function<void()>& first, const std::function<void()>& second) {
    if (thread_count(threads) == 1) {
        first();
        second();
        return;
    }
    tbb::task_arena arena(thread_count(threads));
    arena.execute([&] { tbb::parallel_invoke(first, second); });
}

}  // namespace isoatlas

#endif

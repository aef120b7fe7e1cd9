// Sorting in place on several threads. The order must be strict and total: then the result does not depend on the threads.
#pragma once

#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <span>

#include "base/parallel.h"

namespace isoatlas {

template <class T, class Before>
void parallel_sort(int threads, std::span<T> items, const Before& before) {
    if (thread_count(threads) == 1 || items.size() < 10'000) {
        std::sort(items.begin(), items.end(), before);
        return;
    }
    tbb::task_arena arena(thread_count(threads));
    arena.execute([&] { tbb::parallel_sort(items.begin(), items.end(), before); });
}

}  // namespace isoatlas

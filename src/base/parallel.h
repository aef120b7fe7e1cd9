// The only interface to threads. Work is cut into numbered blocks; what a block computes must not depend on which thread runs it.
// All blocks work in the environment of the caller (isoatlas/environment.h). Where the system refuses a thread, Error{resource}.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>

#include "base/budget_poll.h"

namespace isoatlas {

/// Number of threads that `requested` (0: those of the environment, else all processors) means here.
[[nodiscard]] int thread_count(int requested);

/// Runs work(block) for block in [0, blocks) on at most `threads` threads (0: all); exceptions are carried out (the first one).
void for_each_block(int threads, std::int64_t blocks, const std::function<void(std::int64_t)>& work);

/// Runs work(i) for every i in [0, n), in blocks; for work too small to be a block of its own.
template <class Work>
void for_each_index(int threads, std::size_t n, const Work& work) {
    constexpr std::size_t kBlock = std::size_t{1} << 16;
    for_each_block(threads, static_cast<std::int64_t>((n + kBlock - 1) / kBlock), [&](std::int64_t block) {
        constexpr std::size_t kTogether = 64;
        const std::size_t first = block * kBlock, last = n - first < kBlock ? n : first + kBlock;
        BudgetPoll memory;
        for (std::size_t begin = first; begin < last; begin += kTogether) {
            const std::size_t end = std::min(begin + kTogether, last);
            for (std::size_t i = begin; i < end; ++i) work(i);
            memory.step((end - begin) * (BudgetPoll::kTouch / 8));  // many steps access memory at random
        }
    });
}

/// Runs two independent jobs, at the same time when threads allow.
void run_both(int threads, const std::function<void()>& first, const std::function<void()>& second);

/// Runs a job that starts threads by itself (a library that works with oneTBB), which then has at most `threads` (0: all). Those threads
/// have no environment: they make no arrays of ours and open no files.
void with_threads(int threads, const std::function<void()>& job);

}  // namespace isoatlas

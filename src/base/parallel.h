// The only door to threads. Work is cut into numbered blocks; what a block computes must not depend on which thread runs it.
#pragma once

#include <cstdint>
#include <functional>

namespace isoatlas {

/// Number of threads that `requested` (0: all processors) means here.
[[nodiscard]] int thread_count(int requested);

/// Runs work(block) for block in [0, blocks) on at most `threads` threads (0: all); exceptions are carried out (the first one).
void for_each_block(int threads, std::int64_t blocks, const std::function<void(std::int64_t)>& work);

/// Runs two independent jobs, at the same time when threads allow.
void run_both(int threads, const std::function<void()>& first, const std::function<void()>& second);

}  // namespace isoatlas

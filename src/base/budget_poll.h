// Keeping the memory budget of the current environment (isoatlas/environment.h) in long loops.
#pragma once

#include <cstddef>

namespace isoatlas {

/// Enforces the budgets at once, as the watcher may be late on a loaded machine: after every block of work (parallel.h), and regularly in
/// long loops that read many arrays at a time. Returns how many bytes this thread may bring into memory before the next check, one of as
/// many threads as there are processors. Cost: about a microsecond, nothing where no budget is in force.
std::size_t check_memory();

/// Calls check_memory() in a loop as soon as the steps may have used up what the last call allowed, so that the limit does not depend on
/// the watcher. What they did use up is known from the page faults of the thread, which cost less to query.
class BudgetPoll {
public:
    /// bytes: that the step may bring into memory, on average where it runs in order; kTouch for every array that it goes anywhere in.
    void step(std::size_t bytes = 64) {
        if (bytes < allowed_) {
            allowed_ -= bytes;
        } else {
            allowed_ = look();
        }
    }
    static constexpr std::size_t kTouch = std::size_t{1} << 16;  ///< the system maps 16 pages at a touch

private:
    [[nodiscard]] static std::size_t look();
    std::size_t allowed_ = std::size_t{1} << 16;
};

}  // namespace isoatlas

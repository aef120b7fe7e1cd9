// MemoryBudgets: all memory budgets of the process, and the thread that watches what is resident.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/scratch_file.h"
#include "isoatlas/environment.h"

namespace isoatlas {

/// The arrays of one budget. They may outlive it.
struct MemoryBudget::Arrays {
    Arrays(std::int64_t bytes, std::string folder) : limit(bytes), file(std::move(folder)) {}

    /// Of the limit: what the process may have resident before room is made.
    [[nodiscard]] std::int64_t usable() const noexcept;
    /// Bytes for arrays that are accessed at random.
    [[nodiscard]] std::int64_t at_random() const noexcept;
    /// Do all arrays together fit into the share?
    [[nodiscard]] bool fit() const noexcept;

    const std::int64_t limit;
    bool is_alive = true;  ///< the budget
    ScratchFile file;
    /// Arrays that were kept in memory, to be accessed at random.
    struct Kept {
        const void* memory;  ///< null: it is being made
        std::size_t bytes;
    };
    std::vector<Kept> kept{};
    std::int64_t kept_bytes = 0;
};

/// Thread safe.
class MemoryBudgets {
public:
    using Arrays = MemoryBudget::Arrays;

    [[nodiscard]] Arrays& begin(std::int64_t limit, const std::string& folder);
    void end(Arrays& arrays) noexcept;
    [[nodiscard]] bool any() const noexcept { return total_ > 0; }

    /// at_random: it stays in memory as long as there is room for it.
    [[nodiscard]] void* take(Arrays& arrays, std::size_t bytes, bool at_random, void* (*in_memory)(std::size_t));
    [[nodiscard]] bool give(void* memory, std::size_t bytes) noexcept;

    /// The scratch file that an address lies in, which lives as long as the array there.
    struct Found {
        const Arrays* arrays;
        ScratchFile::Place place;
    };
    [[nodiscard]] std::optional<Found> find(const void* memory) const;
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> scratch_and_kept(const Arrays& arrays) const;

    /// Unmaps arrays when what is resident comes close to the sum of the budgets. Returns how much is left until then: never so little that
    /// threads only poll.
    std::int64_t check();

private:
    void start();
    [[nodiscard]] bool keep(Arrays& arrays, std::size_t bytes);
    [[nodiscard]] void* take_kept(Arrays& arrays, std::size_t bytes, void* (*in_memory)(std::size_t));
    void forget_kept(const void* memory) noexcept;
    void make_room(std::int64_t bytes);
    [[nodiscard]] bool unmap_in_turn(std::int64_t bytes, bool fitting);
    [[nodiscard]] bool is_enough(std::int64_t bytes) const;
    void forget_unused() noexcept;
    void watch();

    std::mutex begin_or_end_;
    mutable std::mutex mutex_;  // of all that follows
    std::condition_variable wake_;
    std::thread watcher_;
    bool stop_ = false;
    int alive_ = 0;
    std::atomic<std::int64_t> total_ = 0, usable_ = 0;  // sums of the budgets alive
    std::int64_t program_ = 0;                          // resident bytes of files that are no arrays
    std::int64_t program_at_most_ = 0;                  // these when the first budget began
    std::atomic<int> statm_ = -1;                       // opened once: a check may still read it when a budget ends
    std::vector<std::unique_ptr<Arrays>> all_;          // also those that outlive their budgets
    std::size_t first_ = 0;                             // of them to be unmapped next
};

[[nodiscard]] MemoryBudgets& memory_budgets();

}  // namespace isoatlas

// The memory budget of the current environment (isoatlas/environment.h), as the engine asks for it: how much, what may stay in memory, what
// lies in the scratch file. Loops that only keep it: budget_poll.h, streamed.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/budget_poll.h"
#include "isoatlas/environment.h"

namespace isoatlas {

/// The current environment with a budget of its own, for a scope. A budget that is in force already stays, so that nothing counts twice.
class MemoryLimit {
public:
    /// bytes: 0: no budget. Throws as MemoryBudget.
    MemoryLimit(std::int64_t bytes, const std::string& folder);

private:
    std::optional<MemoryBudget> budget_;
    std::optional<EnvironmentScope> scope_;
};

/// The budget in force, in bytes; 0 for none.
[[nodiscard]] std::int64_t memory_limit() noexcept;
/// Is a budget in force?
[[nodiscard]] bool memory_is_limited() noexcept;
/// Has any environment of the process a budget? Then nothing is kept for reuse.
[[nodiscard]] bool process_is_limited() noexcept;

/// Bytes of the budget in force for arrays that stay in memory because they are accessed at random. No budget in force: no bound.
[[nodiscard]] std::int64_t memory_at_random() noexcept;

/// Memory that this process may use: of the machine, or less when a control group says so.
[[nodiscard]] std::int64_t available_memory();

/// Peak of the resident memory, in bytes.
[[nodiscard]] std::int64_t peak_memory();

/// While one lives, arrays that this thread makes under the budget in force stay in memory as long as they take no more than
/// memory_at_random() together: those that are accessed at random, where every touch of the scratch file would cost a page.
class PinInMemory {
public:
    PinInMemory();
    ~PinInMemory();
    PinInMemory(const PinInMemory&) = delete;
    PinInMemory& operator=(const PinInMemory&) = delete;

private:
    const bool pinned_before_;
    const MemoryBudget* const budget_before_;
};

/// Arrays of fewer bytes stay in memory.
inline constexpr std::size_t kMinScratch = std::size_t{1} << 20;

/// For the allocator of BigVector. take_array: in the scratch file of the budget in force, or from in_memory(bytes) where none is or memory
/// will do; throws Error{resource} when the disk is full, and what in_memory throws. give_array: from any thread; false: it did not lie in
/// a scratch file, so its memory is to be freed.
[[nodiscard]] void* take_array(std::size_t bytes, void* (*in_memory)(std::size_t));
[[nodiscard]] bool give_array(void* memory, std::size_t bytes) noexcept;

/// Does a part of an array lie in the scratch file of any budget? Then read_scratch and write_scratch copy from and to it without making it
/// resident.
[[nodiscard]] bool is_scratch(const void* memory);
void read_scratch(const void* from, std::span<std::byte> to);
/// Throws Error{resource} when the disk fails.
void write_scratch(void* to, std::span<const std::byte> from);

}  // namespace isoatlas

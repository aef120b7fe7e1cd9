// Arrays larger than memory: while a limit holds, large arrays lie in a scratch file, and what is resident of them stays within the limit.
//
// The file is mapped, so that code for arrays in memory works on it unchanged; its name is removed at once, so that nothing stays behind
// when the program dies. A watcher unmaps pages from the process whenever the resident memory comes close to the limit: they stay in the
// system's cache as long as there is room, and are on the disk otherwise. What is fast then is what runs through memory in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace isoatlas {

class MemoryLimit {
public:
    /// bytes: of the whole process; 0: no limit. folder: of the scratch file; it takes as much disk as the arrays need.
    /// Arrays that exist already stay where they are. Of several limits at a time the lowest holds until all are gone, and the scratch file
    /// is that of the first.
    MemoryLimit(std::int64_t bytes, const std::string& folder);
    ~MemoryLimit();
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
    bool holds_;
};

/// The smallest limit that leaves room for the program itself and some pages of every array.
inline constexpr std::int64_t kMinMemory = std::int64_t{80} << 20;

/// Arrays of fewer bytes stay in memory.
inline constexpr std::size_t kMinScratch = std::size_t{1} << 20;

/// Bytes of the limit in force for arrays that stay in memory because they are accessed at random. No limit in force: no bound.
[[nodiscard]] std::int64_t memory_at_random() noexcept;

/// Memory that this process may use: of the machine, or less when a control group says so.
[[nodiscard]] std::int64_t available_memory();

/// Peak of the resident memory, in bytes.
[[nodiscard]] std::int64_t peak_memory();

/// While one lives, arrays that this thread makes stay in memory as long as they take no more than memory_at_random() together: those
/// that are accessed at random, where every touch of the scratch file would cost a page.
class PinInMemory {
public:
    PinInMemory();
    ~PinInMemory();
    PinInMemory(const PinInMemory&) = delete;
    PinInMemory& operator=(const PinInMemory&) = delete;

private:
    bool before_;
};

/// For the allocator of BigVector. take_scratch: null when no limit holds or memory will do; throws Error{resource} when the disk is full.
/// give_scratch: false: not from here.
[[nodiscard]] void* take_scratch(std::size_t bytes);
[[nodiscard]] bool give_scratch(void* memory, std::size_t bytes) noexcept;
/// Enforces the limit at once, as the watcher may be late on a loaded machine: after every block of work (parallel.h), and regularly in
/// long loops that read many arrays at a time. Returns how many bytes this thread may bring into memory before the next check, one of as
/// many threads as there are processors. Cost: about a microsecond, nothing where no limit is in force.
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

/// Does a part of an array lie in the scratch file? Then read_scratch and write_scratch copy from and to it without making it resident.
[[nodiscard]] bool is_scratch(const void* memory);
void read_scratch(const void* from, std::span<std::byte> to);
/// Throws Error{resource} when the disk fails.
void write_scratch(void* to, std::span<const std::byte> from);

/// The limit in force, 0 for none.
[[nodiscard]] std::int64_t memory_limit() noexcept;
/// Is a limit in force? Then nothing is kept for reuse.
[[nodiscard]] bool memory_is_limited() noexcept;

}  // namespace isoatlas

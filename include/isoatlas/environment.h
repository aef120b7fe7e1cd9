// Environment: what calls work with beside their arguments: a memory budget, files, threads. Two analyses in one process may have two
// budgets.
//
// Every thread has a current environment: at first the process's own, with the operating system's files, no budget and all processors.
// An EnvironmentScope makes another one current for a thread, and for the threads that work for it. A Context carries one to a long call.
#pragma once

#include <cstdint>
#include <string>

namespace isoatlas {

struct Context;
class FileSystem;

/// Bytes of memory for the work of one environment: arrays larger than memory lie in a scratch file of this budget.
///
/// The file is mapped, so that code for arrays in memory works on it unchanged; its name is removed at once, so that nothing stays behind
/// when the program dies. A watcher unmaps pages from the process whenever the resident memory comes close to the budget: they stay in the
/// system's cache as long as there is room, and are on the disk otherwise. What is fast then is what runs through memory in order.
///
/// Several budgets may live at a time. Each has its own scratch file, and its own bytes for arrays that are accessed at random. What is
/// resident is known of the process only, so the guarantee is about the sum: while budgets live, the process stays within their sum, the
/// program itself and all that was made outside of them included; it cannot hold when that alone is more. One budget may use what another
/// leaves, until that one needs it: when the total comes close to the sum, arrays are unmapped of every budget whose arrays exceed its
/// share, in proportion to the shares, and of the others only if that is not enough. After the end of a budget the process may take a
/// moment, and a check, to come down to the sum of the rest.
class MemoryBudget {
public:
    /// bytes: at least kMinMemory; less is not refused, but not kept. folder: of the scratch file; it takes as much disk as the arrays
    /// need, from the first array on. Throws Error: usage (bytes are not positive), resource (the system refuses the thread that watches).
    MemoryBudget(std::int64_t bytes, const std::string& folder);
    /// No thread may be in an environment with it. Arrays may outlive it; the file lives as long as the last of them.
    ~MemoryBudget();
    MemoryBudget(const MemoryBudget&) = delete;
    MemoryBudget& operator=(const MemoryBudget&) = delete;

    [[nodiscard]] std::int64_t bytes() const noexcept;
    /// Does a part of an array lie in the scratch file of this budget?
    [[nodiscard]] bool holds(const void* memory) const;
    /// Bytes of the arrays in the scratch file.
    [[nodiscard]] std::int64_t scratch_bytes() const;
    /// Bytes of the arrays that stay in memory because they are accessed at random, and how many there may be.
    [[nodiscard]] std::int64_t bytes_at_random() const;
    [[nodiscard]] std::int64_t max_at_random() const noexcept;

    struct Arrays;
    /// For the library.
    [[nodiscard]] Arrays& arrays() const noexcept { return *arrays_; }

private:
    Arrays* arrays_;
};

/// The smallest budget that leaves room for the program itself and some pages of every array.
inline constexpr std::int64_t kMinMemory = std::int64_t{80} << 20;

/// Default: the process's own. What it points to must outlive its use.
struct Environment {
    MemoryBudget* memory = nullptr;  ///< null: no budget
    FileSystem* files = nullptr;     ///< null: those of the operating system; others exist for tests
    int threads = 0;                 ///< for calls that ask for all (Context::threads 0); 0: one per processor
};

/// The environment of the calling thread.
[[nodiscard]] const Environment& current_environment() noexcept;

/// While it lives, an environment is current for this thread, and for the threads that work for it. Ends on the thread that made it, before
/// those that were there earlier.
class EnvironmentScope {
public:
    explicit EnvironmentScope(const Environment& environment) noexcept;
    /// That of a context; one without an environment changes nothing.
    explicit EnvironmentScope(const Context& context) noexcept;
    ~EnvironmentScope();
    EnvironmentScope(const EnvironmentScope&) = delete;
    EnvironmentScope& operator=(const EnvironmentScope&) = delete;

private:
    const Environment environment_;
    const Environment* const before_;
};

}  // namespace isoatlas

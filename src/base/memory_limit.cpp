#include "base/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <thread>
#include <utility>

#include "base/check.h"
#include "base/memory_budgets.h"

namespace isoatlas {
namespace {

thread_local bool pins = false;  // PinInMemory
thread_local const MemoryBudget* pinned = nullptr;

MemoryBudget* budget_in_force() noexcept { return current_environment().memory; }

/// Copies all bytes between memory and the place of an array in its file; call(file, bytes, size, offset) copies some.
template <class Byte, class Call>
void transfer(const void* array, std::span<Byte> bytes, const Call& call) {
    const auto found = memory_budgets().find(array);  // the caller keeps the array alive
    ISOATLAS_CHECK(found);
    for (auto [file, offset] = found->place; !bytes.empty();) {
        const ssize_t count = call(file, bytes.data(), bytes.size(), offset);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) found->arrays->file.fail(count < 0 ? errno : EIO);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
        offset += count;
    }
}

}  // namespace

MemoryBudget::MemoryBudget(std::int64_t bytes, const std::string& folder) : arrays_(&memory_budgets().begin(bytes, folder)) {}
MemoryBudget::~MemoryBudget() { memory_budgets().end(*arrays_); }
std::int64_t MemoryBudget::bytes() const noexcept { return arrays_->limit; }
bool MemoryBudget::holds(const void* memory) const {
    const auto found = memory_budgets().find(memory);
    return found && found->arrays == arrays_;
}
std::int64_t MemoryBudget::scratch_bytes() const { return memory_budgets().scratch_and_kept(*arrays_).first; }
std::int64_t MemoryBudget::bytes_at_random() const { return memory_budgets().scratch_and_kept(*arrays_).second; }
std::int64_t MemoryBudget::max_at_random() const noexcept { return arrays_->at_random(); }

MemoryLimit::MemoryLimit(std::int64_t bytes, const std::string& folder) {
    if (bytes <= 0 || memory_is_limited()) return;
    budget_.emplace(bytes, folder);
    Environment limited = current_environment();
    limited.memory = &*budget_;
    scope_.emplace(limited);
}

// A block of another analysis that this thread does meanwhile pins nothing.
PinInMemory::PinInMemory() : pinned_before_(std::exchange(pins, true)), budget_before_(std::exchange(pinned, budget_in_force())) {}
PinInMemory::~PinInMemory() { pins = pinned_before_, pinned = budget_before_; }

void* take_array(std::size_t bytes, void* (*in_memory)(std::size_t)) {
    const MemoryBudget* const budget = budget_in_force();
    if (budget == nullptr || bytes < kMinScratch) return in_memory(bytes);
    return memory_budgets().take(budget->arrays(), bytes, pins && pinned == budget, in_memory);
}
bool give_array(void* memory, std::size_t bytes) noexcept { return memory_budgets().give(memory, bytes); }

std::size_t check_memory() {
    constexpr std::int64_t kMin = std::int64_t{1} << 18;
    static const std::int64_t threads = std::max(1U, std::thread::hardware_concurrency());
    if (!memory_is_limited()) return std::numeric_limits<std::size_t>::max();
    return static_cast<std::size_t>(std::max(memory_budgets().check() / (2 * threads), kMin));
}

std::size_t BudgetPoll::look() {
    if (!memory_is_limited()) return std::numeric_limits<std::size_t>::max();
    static thread_local long faults_before = 0;
    static thread_local std::size_t left = 0;
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    const long faults = usage.ru_minflt + usage.ru_majflt;
    const std::size_t used = static_cast<std::size_t>(faults - std::exchange(faults_before, faults)) * kTouch;
    static thread_local std::size_t granted = 0;
    left = used < left ? left - used : 0;
    if (left <= granted / 2) left = granted = check_memory();
    return left;
}

bool is_scratch(const void* memory) { return memory_budgets().find(memory).has_value(); }

void read_scratch(const void* from, std::span<std::byte> to) {
    transfer(from, to, [](int file, std::byte* part, std::size_t size, off_t offset) { return ::pread(file, part, size, offset); });
}

void write_scratch(void* to, std::span<const std::byte> from) {
    transfer(to, from, [](int file, const std::byte* part, std::size_t size, off_t offset) { return ::pwrite(file, part, size, offset); });
}

std::int64_t memory_limit() noexcept { return memory_is_limited() ? budget_in_force()->bytes() : 0; }
bool memory_is_limited() noexcept { return budget_in_force() != nullptr; }
bool process_is_limited() noexcept { return memory_budgets().any(); }
std::int64_t memory_at_random() noexcept {
    return memory_is_limited() ? budget_in_force()->max_at_random() : std::numeric_limits<std::int64_t>::max();
}

}  // namespace isoatlas

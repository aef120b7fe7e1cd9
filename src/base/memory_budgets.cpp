#include "base/memory_budgets.h"

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <system_error>

#include "base/library_pages.h"
#include "base/memory_limit.h"
#include "base/pages.h"
#include "base/refusals.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

// What may become resident between two checks.
constexpr std::int64_t kReserve = std::int64_t{10} << 20;
constexpr std::int64_t kElse = std::int64_t{40} << 20;    // what is in memory anyway: the program, tiles, pages of the file
constexpr std::int64_t kWorthIt = std::int64_t{2} << 20;  // less is not worth unmapping, when other memory takes the room

struct Resident {
    std::int64_t all, of_files;  ///< bytes
};

Resident resident_memory(int statm) {
    char text[128] = {};
    if (::pread(statm, text, sizeof text - 1, 0) <= 0) return {0, 0};
    char* next = text;
    std::array<std::int64_t, 3> pages{};  // size, resident, of these of files
    for (std::int64_t& count : pages) count = std::strtoll(next, &next, 10);
    return {pages[1] * static_cast<std::int64_t>(kPage), pages[2] * static_cast<std::int64_t>(kPage)};
}

/// Freed memory of vectors returns to the system: the allocator would keep up to 32 MB for each thread, and more the more is freed.
void keep_heap_small() {
    constexpr int kMapped = 1 << 18, kKept = 1 << 18, kArenas = 2;
    (void)::mallopt(M_MMAP_THRESHOLD, kMapped);
    (void)::mallopt(M_TRIM_THRESHOLD, kKept);
    (void)::mallopt(M_ARENA_MAX, kArenas);
    (void)::malloc_trim(0);
}

}  // namespace

std::int64_t MemoryBudget::Arrays::usable() const noexcept { return limit - std::max(limit / 20 * 3, kReserve); }

std::int64_t MemoryBudget::Arrays::at_random() const noexcept { return std::max(limit - kElse, limit / 4) / 20 * 13; }

bool MemoryBudget::Arrays::fit() const noexcept {
    return is_alive && static_cast<std::int64_t>(file.mapped()) + kept_bytes <= usable() - kElse;
}

MemoryBudget::Arrays& MemoryBudgets::begin(std::int64_t limit, const std::string& folder) {
    if (limit <= 0) throw Error(ErrorKind::usage, {.where = "memory budget", .what = "no memory", .expected = "more than 0 bytes"});
    const std::lock_guard beginning(begin_or_end_);
    auto made = std::make_unique<Arrays>(limit, folder);
    const std::lock_guard lock(mutex_);
    all_.reserve(all_.size() + 1);
    if (alive_ == 0) start();
    ++alive_;
    total_ += limit;
    usable_ += made->usable();
    all_.push_back(std::move(made));
    return *all_.back();
}

/// For the first budget.
void MemoryBudgets::start() {
    stop_ = false;
    try {
        watcher_ = std::thread([this] { watch(); });  // which waits for the lock
    } catch (const std::system_error& error) {
        throw threads_refused(error.what());
    }
    keep_heap_small();
    if (statm_ < 0) statm_ = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    program_at_most_ = resident_memory(statm_).of_files;
    release_library_pages();
    program_ = resident_memory(statm_).of_files;
}

void MemoryBudgets::end(Arrays& arrays) noexcept {
    const std::lock_guard ending(begin_or_end_);
    {
        const std::lock_guard lock(mutex_);
        stop_ = alive_ == 1;
    }
    if (stop_) {  // changed by this thread alone
        wake_.notify_all();
        watcher_.join();
    }
    const std::lock_guard lock(mutex_);
    --alive_;
    usable_ -= arrays.usable();
    total_ -= arrays.limit;
    arrays.is_alive = false;
    arrays.kept.clear();
    arrays.kept_bytes = 0;
    forget_unused();
}

/// Of budgets that have ended.
void MemoryBudgets::forget_unused() noexcept {
    std::erase_if(all_, [](const auto& arrays) { return !arrays->is_alive && arrays->file.is_unused(); });
}

void* MemoryBudgets::take(Arrays& arrays, std::size_t bytes, bool at_random, void* (*in_memory)(std::size_t)) {
    if (at_random && keep(arrays, bytes)) return take_kept(arrays, bytes, in_memory);
    std::unique_lock lock(mutex_);
    const ScratchFile::Room room = arrays.file.take(bytes);
    lock.unlock();  // reserving blocks may be slow, and the watcher must not wait for it
    const ScratchFile::Mapped mapped = ScratchFile::map(room);
    lock.lock();
    if (mapped.memory == nullptr) {
        arrays.file.drop();
        arrays.file.fail(mapped.error);
    }
    arrays.file.add(mapped.memory, room.part);
    lock.unlock();
    const auto size = static_cast<std::int64_t>(room.part.size);
    if (usable_ - resident_memory(statm_).all < size) make_room(size);  // it may be filled at once
    return mapped.memory;
}

/// Counts an array that is about to be made as one that stays in memory, if there is room for it.
bool MemoryBudgets::keep(Arrays& arrays, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (arrays.kept_bytes + static_cast<std::int64_t>(bytes) > arrays.at_random()) return false;
    arrays.kept.push_back({nullptr, bytes});
    arrays.kept_bytes += static_cast<std::int64_t>(bytes);
    return true;
}

/// Makes an array that keep() has counted.
void* MemoryBudgets::take_kept(Arrays& arrays, std::size_t bytes, void* (*in_memory)(std::size_t)) {
    void* memory = nullptr;
    const auto note = [&] {
        const std::lock_guard lock(mutex_);
        const auto counted =
            std::ranges::find_if(arrays.kept, [&](const auto& one) { return one.memory == nullptr && one.bytes == bytes; });
        if (counted == arrays.kept.end()) return;  // the budget has ended
        counted->memory = memory;
        if (memory != nullptr) return;
        arrays.kept_bytes -= static_cast<std::int64_t>(bytes);
        arrays.kept.erase(counted);
    };
    try {
        memory = in_memory(bytes);
    } catch (...) {
        note();
        throw;
    }
    note();
    return memory;
}

void MemoryBudgets::forget_kept(const void* memory) noexcept {
    for (const auto& arrays : all_) {
        const auto kept = std::ranges::find(arrays->kept, memory, &Arrays::Kept::memory);
        if (kept == arrays->kept.end()) continue;
        arrays->kept_bytes -= static_cast<std::int64_t>(kept->bytes);
        arrays->kept.erase(kept);
        return;
    }
}

bool MemoryBudgets::give(void* memory, std::size_t bytes) noexcept {
    if (bytes < kMinScratch) return false;
    std::unique_lock lock(mutex_);
    for (const auto& each : all_) {
        Arrays& arrays = *each;  // stays where it is: it is in use
        const std::optional<ScratchFile::Part> part = arrays.file.remove(memory);
        if (!part) continue;
        lock.unlock();
        ::munmap(memory, part->size);
        lock.lock();
        arrays.file.give(*part);
        forget_unused();
        return true;
    }
    forget_kept(memory);
    return false;
}

std::optional<MemoryBudgets::Found> MemoryBudgets::find(const void* memory) const {
    const std::lock_guard lock(mutex_);
    for (const auto& arrays : all_) {
        if (const auto place = arrays->file.find(memory)) return Found{arrays.get(), *place};
    }
    return std::nullopt;
}

std::pair<std::int64_t, std::int64_t> MemoryBudgets::scratch_and_kept(const Arrays& arrays) const {
    const std::lock_guard lock(mutex_);
    return {static_cast<std::int64_t>(arrays.file.mapped()), arrays.kept_bytes};
}

std::int64_t MemoryBudgets::check() {
    if (const std::int64_t before = usable_ - resident_memory(statm_).all; before > total_ / 32) return before;
    make_room(total_ / 8);
    return usable_ - resident_memory(statm_).all;
}

/// Another thread may have unmapped; little is not worth it when other memory takes the room.
bool MemoryBudgets::is_enough(std::int64_t bytes) const {
    const Resident resident = resident_memory(statm_);
    return usable_ - resident.all >= bytes || resident.of_files - program_ < kWorthIt;
}

/// Unmaps arrays until so many bytes are left or nothing is mapped: of budgets whose arrays fit into their share only when the others do
/// not make enough room.
void MemoryBudgets::make_room(std::int64_t bytes) {
    const std::lock_guard lock(mutex_);
    if (unmap_in_turn(bytes, false)) return;
    // A new array of one budget may ask for more than there can be: not at the cost of the others.
    if (unmap_in_turn(all_.size() > 1 ? std::min<std::int64_t>(bytes, total_ / 8) : bytes, true)) return;
    program_ =
        std::min(resident_memory(statm_).of_files, program_at_most_);  // no array is mapped: what is left, the program has used again
}

/// Part after part of the arrays of one budget after the other, the more the larger its share. False: all is unmapped.
bool MemoryBudgets::unmap_in_turn(std::int64_t bytes, bool fitting) {
    for (const auto& arrays : all_) arrays->file.begin_unmapping();
    for (bool unmapped = true; unmapped;) {
        unmapped = false;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            Arrays& arrays = *all_[(first_ + i) % all_.size()];
            if (arrays.fit() != fitting) continue;
            if (is_enough(bytes)) {
                first_ = (first_ + i) % all_.size();
                return true;
            }
            const std::int64_t share = arrays.is_alive ? arrays.limit / 32 : 0;
            const std::size_t part = static_cast<std::size_t>(std::max<std::int64_t>(share, kMinScratch)) / kPage * kPage;
            unmapped = arrays.file.unmap_next(part) || unmapped;
        }
    }
    return false;
}

/// Sleeps as long as the memory that is left lasts for a thread that touches page after page.
void MemoryBudgets::watch() {
    constexpr std::int64_t kBytesPerMicrosecond = 32 << 10;  // of threads that only read what is in the system's cache
    std::unique_lock lock(mutex_);
    while (!stop_) {
        lock.unlock();
        const std::int64_t microseconds = std::clamp<std::int64_t>(check() / kBytesPerMicrosecond, 500, 5000);
        lock.lock();
        wake_.wait_for(lock, std::chrono::microseconds(microseconds), [this] { return stop_; });
    }
}

MemoryBudgets& memory_budgets() {
    static auto* const budgets = new MemoryBudgets;  // never destroyed: vectors may outlive it at exit
    return *budgets;
}

}  // namespace isoatlas

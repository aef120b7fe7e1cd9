#include "base/big_vector.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <new>

#include "base/memory_limit.h"
#include "base/pages.h"

namespace isoatlas {
namespace {

constexpr std::size_t kSmall = std::size_t{1} << 16;  // below: the ordinary heap
constexpr std::size_t kMostBeyond = std::size_t{4} << 20;
constexpr int kSteady = 200;  // arrays; after its peak an analysis takes fewer

/// What an array takes: whole huge pages where it may have some.
std::size_t taken_by(std::size_t bytes) { return rounded_up(bytes, bytes < kHugePage ? kPage : kHugePage); }

/// Fresh memory from the system, aligned to huge pages where it may have some; null when there is none.
char* map_memory(std::size_t size) {
    if (size < kHugePage) {
        void* mapped = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        return mapped == MAP_FAILED ? nullptr : static_cast<char*>(mapped);
    }
    void* mapped = mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) return nullptr;
    // Keep the highest aligned part: mappings grow downwards, so this one touches the one before and both can be joined when they are free.
    char* const begin = static_cast<char*>(mapped);
    const std::size_t tail = reinterpret_cast<std::uintptr_t>(begin) % kHugePage;
    const std::size_t head = kHugePage - tail;
    munmap(begin, head);
    if (tail > 0) munmap(begin + head + size, tail);
    return begin + head;
}

/// Maps fresh memory at an address whose pages may have been moved away.
void replace_memory(char* at, std::size_t size) {
    if (mmap(at, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED) throw std::bad_alloc();
}

/// Memory in use and memory kept for reuse. Their sum never exceeds the peak of memory in use: keeping costs nothing. Where many arrays
/// came without a new peak, as in queries that are asked again and again, it may exceed it a little, so that pieces that do not fit
/// together are not returned and fetched each time.
class Pool {
public:
    char* take(std::size_t size) {
        const std::lock_guard lock(mutex_);
        char* memory = reuse(size);
        if (memory == nullptr) {
            most_used_ = std::max(most_used_, used_ + size);
            memory = map_memory(size);
            if (memory == nullptr) throw std::bad_alloc();
            if (size >= kHugePage) move_pages(memory, size);
        }
        used_ += size;
        since_peak_ = used_ >= most_used_ ? 0 : std::min(since_peak_, kSteady) + 1;
        most_used_ = std::max(most_used_, used_);
        const std::size_t most = most_used_ + (since_peak_ > kSteady ? std::min(most_used_ / 4, kMostBeyond) : 0);
        while (!free_.empty() && used_ + kept_ > most) drop_one();
        return memory;
    }

    void put(char* memory, std::size_t size) {
        const std::lock_guard lock(mutex_);
        used_ -= size;
        if (process_is_limited()) {
            munmap(memory, size);
            return;
        }
        kept_ += size;
        auto piece = free_.emplace(memory, size).first;
        if (const auto next = std::next(piece); next != free_.end() && memory + size == next->first) {
            piece->second += next->second;
            free_.erase(next);
        }
        if (piece == free_.begin()) return;
        const auto before = std::prev(piece);
        if (before->first + before->second != piece->first) return;
        before->second += piece->second;
        free_.erase(piece);
    }

    void give_back() {
        const std::lock_guard lock(mutex_);
        while (!free_.empty()) drop_one();
        most_used_ = used_, since_peak_ = 0;
    }

private:
    /// Cuts size from the smallest free piece that holds it: small ones from its end, so that the rest stays aligned.
    char* reuse(std::size_t size) {
        auto best = free_.end();
        for (auto piece = free_.begin(); piece != free_.end(); ++piece) {
            if (piece->second >= size && (best == free_.end() || piece->second < best->second)) best = piece;
        }
        if (best == free_.end()) return nullptr;
        kept_ -= size;
        char* const begin = best->first;
        const std::size_t rest = best->second - size;
        if (size < kHugePage && rest > 0) {
            best->second = rest;
            return begin + rest;
        }
        free_.erase(best);
        if (rest > 0) free_.emplace(begin + size, rest);
        return begin;
    }

    /// Moves pages of free pieces, none of which is large enough, to a new piece: a page that was in use need not be cleared again.
    void move_pages(char* to, std::size_t size) {
        while (size > 0 && !free_.empty()) {
            const auto piece = std::prev(free_.end());
            const std::size_t moved = std::min(size, piece->second);
            char* const from = piece->first + (piece->second - moved);
            if (mremap(from, moved, moved, MREMAP_MAYMOVE | MREMAP_FIXED, to) == MAP_FAILED) {  // it lies in two mappings, say
                replace_memory(to, moved);
                return;
            }
            piece->second -= moved, kept_ -= moved, to += moved, size -= moved;
            if (piece->second == 0) free_.erase(piece);
        }
    }

    void drop_one() {
        const auto piece = std::prev(free_.end());
        munmap(piece->first, piece->second);
        kept_ -= piece->second;
        free_.erase(piece);
    }

    std::mutex mutex_;
    std::map<char*, std::size_t> free_;  // by address; neighbours are joined
    std::size_t used_ = 0, kept_ = 0, most_used_ = 0;
    int since_peak_ = 0;  ///< arrays that came since then
};

Pool& pool() {
    static auto* const pool = new Pool;  // never destroyed: vectors may outlive it at exit
    return *pool;
}

void* allocate_in_memory(std::size_t bytes) {
    if (bytes < kSmall) return ::operator new(bytes);
    if (bytes > std::numeric_limits<std::size_t>::max() / 2) throw std::bad_alloc();
    return pool().take(taken_by(bytes));
}

}  // namespace

void* allocate_big(std::size_t bytes) { return take_array(bytes, allocate_in_memory); }

void free_big(void* memory, std::size_t bytes) noexcept {
    if (give_array(memory, bytes)) return;
    if (bytes < kSmall) {
        ::operator delete(memory);
    } else {
        pool().put(static_cast<char*>(memory), taken_by(bytes));
    }
}

void trim_memory_pool() noexcept { pool().give_back(); }

}  // namespace isoatlas

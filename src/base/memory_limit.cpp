#include "base/memory_limit.h"

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "base/check.h"
#include "base/refusals.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kPage = 4096;
constexpr std::size_t kHugePage = std::size_t{1} << 21;
thread_local bool keeps_in_memory = false;  // PinInMemory

std::size_t rounded(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

[[noreturn]] void scratch_failed(const std::string& folder, int error) {
    throw Error(ErrorKind::resource, {.file = folder,
                                      .what = std::string("the scratch file cannot grow: ") + std::strerror(error),
                                      .next = "free some disk space, build the store on another disk with -o, or allow more --memory"});
}

/// An unnamed file in a folder.
int open_scratch(const std::string& folder) {
    int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0) return file;
    std::string name = folder + "/.isoatlas-scratch-XXXXXX";  // file systems without unnamed files
    file = ::mkostemp(name.data(), O_CLOEXEC);
    if (file < 0) scratch_failed(folder, errno);
    ::unlink(name.c_str());
    return file;
}

/// Maps a part of the file, at an address that has another place in its huge page than the part has in the file: the system would map
/// up to 2 MB of its cache at one touch, and so maps BudgetPoll::kTouch. Null when it cannot.
void* map_scratch(int file, off_t offset, std::size_t size) {
    void* const room = ::mmap(nullptr, size + kHugePage, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (room == MAP_FAILED) return nullptr;
    const auto begin = reinterpret_cast<std::uintptr_t>(room);
    const std::size_t head = (static_cast<std::size_t>(offset) + BudgetPoll::kTouch - begin) % kHugePage;  // wraps around and back
    char* const at = static_cast<char*>(room) + head;
    if (head > 0) ::munmap(room, head);
    if (head < kHugePage) ::munmap(at + size, kHugePage - head);
    if (::mmap(at, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, file, offset) != MAP_FAILED) return at;
    const int error = errno;
    ::munmap(at, size);
    errno = error;
    return nullptr;
}

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

/// The arrays in the scratch file, and the thread that watches them.
class Scratch {
public:
    void start(std::int64_t limit, const std::string& folder) {
        const std::lock_guard starting(start_or_stop_);
        const std::lock_guard lock(mutex_);
        if (users_ == 0) {
            stop_ = false;
            try {
                watcher_ = std::thread([this] { watch(); });  // which waits for the lock
            } catch (const std::system_error& error) {
                throw threads_refused(error.what());
            }
        }
        limit_ = users_ > 0 ? std::min<std::int64_t>(limit_, limit) : limit;
        if (users_++ > 0) return;
        folder_ = folder;
        kept_bytes_ = 0;
        kept_.clear();
        keep_heap_small();
        if (statm_ < 0) statm_ = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
        program_ = resident_memory(statm_).of_files;
        active_ = true;
    }
    void stop() {
        const std::lock_guard stopping(start_or_stop_);
        {
            const std::lock_guard lock(mutex_);
            if (--users_ > 0) return;
            stop_ = true;
        }
        wake_.notify_all();
        watcher_.join();
        const std::lock_guard lock(mutex_);
        active_ = false;
        close_unused_file();
    }
    [[nodiscard]] bool active() const noexcept { return active_; }
    [[nodiscard]] std::int64_t limit() const noexcept { return active_ ? limit_.load() : 0; }

    void* take(std::size_t bytes) {
        if (!active_ || bytes < kMinScratch) return nullptr;
        const std::size_t size = rounded(bytes);
        std::unique_lock lock(mutex_);
        if (keeps_in_memory && kept_bytes_ + static_cast<std::int64_t>(bytes) <= at_random()) {
            kept_bytes_ += static_cast<std::int64_t>(bytes);
            ++kept_[bytes];
            return nullptr;
        }
        if (file_ < 0) file_ = open_scratch(folder_);
        const std::optional<off_t> unused = reuse(size);
        const off_t offset = unused ? *unused : static_cast<off_t>(std::exchange(end_, end_ + size));
        ++calls_;
        lock.unlock();  // reserving blocks may be slow, and the watcher must not wait for it
        // Blocks are reserved now: a full disk is an error here, and not a signal when a page is written.
        const int error = unused ? 0 : ::posix_fallocate(file_, offset, static_cast<off_t>(size));
        void* const mapped = error == 0 ? map_scratch(file_, offset, size) : nullptr;
        const int reason = error != 0 ? error : errno;
        lock.lock();
        --calls_;
        if (mapped == nullptr) scratch_failed(folder_, reason);
        pieces_.emplace(static_cast<char*>(mapped), Piece{offset, size});
        lock.unlock();
        if (left() < static_cast<std::int64_t>(size)) make_room(static_cast<std::int64_t>(size));  // it may be filled at once
        return mapped;
    }

    bool give(void* memory, std::size_t bytes) noexcept {
        if (bytes < kMinScratch) return false;
        std::unique_lock lock(mutex_);
        const auto found = pieces_.find(static_cast<char*>(memory));
        if (found == pieces_.end()) {
            forget_kept(bytes);
            return false;
        }
        const Piece piece = found->second;
        pieces_.erase(found);
        ++calls_;
        lock.unlock();
        ::munmap(memory, piece.size);
        lock.lock();
        --calls_;
        add_unused(piece);
        if (!active_) close_unused_file();
        return true;
    }

    /// Calls copy(offset in the file) for an address in it. Returns false, and does nothing, for others.
    template <class Copy>
    bool locate(const void* memory, const Copy& copy) {
        std::unique_lock lock(mutex_);
        const auto* const at = static_cast<const char*>(memory);
        auto piece = pieces_.upper_bound(const_cast<char*>(at));
        if (piece == pieces_.begin()) return false;
        --piece;
        const auto into = static_cast<std::size_t>(at - piece->first);
        if (into >= piece->second.size) return false;
        const off_t offset = piece->second.offset + static_cast<off_t>(into);
        const int file = file_;
        lock.unlock();  // the caller of the copy keeps the array alive
        copy(file, offset);
        return true;
    }
    [[noreturn]] void failed(int error) { scratch_failed(folder_, error); }

    [[nodiscard]] std::int64_t at_random() const noexcept { return std::max(limit_ - kElse, limit_ / 4) / 20 * 13; }

    /// Unmaps the arrays when what is resident comes close to the limit. Returns how much is left until then: never so little that threads
    /// only poll.
    std::int64_t check() {
        if (const std::int64_t before = left(); before > limit_ / 32) return before;
        make_room(limit_ / 8);
        return left();
    }

private:
    [[nodiscard]] std::int64_t left() const { return limit_ - std::max(limit_ / 20 * 3, kReserve) - resident_memory(statm_).all; }

    /// Unmaps arrays, part after part in turn, until so many bytes are left or nothing is mapped.
    void make_room(std::int64_t bytes) {
        const std::lock_guard lock(mutex_);
        const std::size_t part = static_cast<std::size_t>(std::max<std::int64_t>(limit_ / 32, kMinScratch)) / kPage * kPage;
        for (std::size_t round = 0; round < pieces_.size() + 1; ++round) {
            auto piece = pieces_.upper_bound(next_unmapped_);
            if (piece != pieces_.begin()) --piece;
            for (; piece != pieces_.end(); ++piece) {
                const auto& [memory, it] = *piece;
                std::size_t from = next_unmapped_ > memory ? static_cast<std::size_t>(next_unmapped_ - memory) : 0;
                for (; from < it.size; from += part) {
                    // Another thread may have unmapped; little is not worth it when other memory takes the room.
                    const Resident resident = resident_memory(statm_);
                    if (left() >= bytes || resident.of_files - program_ < kWorthIt) return;
                    ::madvise(memory + from, std::min(part, it.size - from), MADV_DONTNEED);
                    next_unmapped_ = memory + from + std::min(part, it.size - from);
                }
            }
            next_unmapped_ = nullptr;
            if (round > 0) return;
        }
    }

    // What may become resident between two checks.
    static constexpr std::int64_t kReserve = std::int64_t{10} << 20;
    static constexpr std::int64_t kElse = std::int64_t{40} << 20;    // what is in memory anyway: the program, tiles, pages of the file
    static constexpr std::int64_t kWorthIt = std::int64_t{2} << 20;  // less is not worth unmapping, when other memory takes the room

    struct Piece {
        off_t offset;
        std::size_t size;
    };

    /// The smallest unused part of the file that is large enough: its pages are in memory already, or its blocks on the disk.
    std::optional<off_t> reuse(std::size_t size) {
        auto best = unused_.end();
        for (auto part = unused_.begin(); part != unused_.end(); ++part) {
            if (part->second >= size && (best == unused_.end() || part->second < best->second)) best = part;
        }
        if (best == unused_.end()) return std::nullopt;
        const auto [offset, all] = *best;
        unused_.erase(best);
        if (all > size) unused_.emplace(offset + static_cast<off_t>(size), all - size);
        return offset;
    }

    /// An array that is not in the file: if one of its size was kept in memory, it is that one, or will be.
    void forget_kept(std::size_t bytes) {
        const auto found = kept_.find(bytes);
        if (found == kept_.end()) return;
        kept_bytes_ -= static_cast<std::int64_t>(bytes);
        if (--found->second == 0) kept_.erase(found);
    }

    void add_unused(const Piece& piece) {
        auto part = unused_.emplace(piece.offset, piece.size).first;
        const auto next = std::next(part);
        if (next != unused_.end() && part->first + static_cast<off_t>(part->second) == next->first) {
            part->second += next->second;
            unused_.erase(next);
        }
        if (part == unused_.begin()) return;
        const auto before = std::prev(part);
        if (before->first + static_cast<off_t>(before->second) != part->first) return;
        before->second += part->second;
        unused_.erase(part);
    }

    void close_unused_file() {
        if (file_ < 0 || !pieces_.empty() || calls_ > 0) return;
        ::close(file_);
        file_ = -1;
        unused_.clear();
        end_ = 0;
    }

    /// Sleeps as long as the memory that is left lasts for a thread that touches page after page.
    void watch() {
        constexpr std::int64_t kBytesPerMicrosecond = 32 << 10;  // of threads that only read what is in the system's cache
        std::unique_lock lock(mutex_);
        while (!stop_) {
            lock.unlock();
            const std::int64_t microseconds = std::clamp<std::int64_t>(check() / kBytesPerMicrosecond, 500, 5000);
            lock.lock();
            wake_.wait_for(lock, std::chrono::microseconds(microseconds), [this] { return stop_; });
        }
    }

    std::mutex start_or_stop_, mutex_;
    std::condition_variable wake_;
    int users_ = 0;
    std::thread watcher_;
    std::atomic<bool> active_ = false;
    bool stop_ = false;
    std::atomic<std::int64_t> limit_ = 0;
    std::int64_t program_ = 0;           // resident bytes of files before there were arrays
    std::int64_t kept_bytes_ = 0;        // of arrays that were kept in memory
    std::map<std::size_t, int> kept_{};  // how many of each size
    std::string folder_;
    int file_ = -1;
    std::atomic<int> statm_ = -1;  // opened once: a check may still read it when a limit ends
    int calls_ = 0;                // that use the file right now
    std::size_t end_ = 0;
    std::map<char*, Piece> pieces_;
    char* next_unmapped_ = nullptr;
    std::map<off_t, std::size_t> unused_;  // parts of the file, from offset to size; no two are neighbours
};

Scratch& scratch() {
    static auto* const scratch = new Scratch;  // never destroyed: vectors may outlive it at exit
    return *scratch;
}

/// Copies all bytes between memory and the place of an array in the file; call(file, bytes, size, offset) copies some.
template <class Byte, class Call>
void transfer(const void* array, std::span<Byte> bytes, const Call& call) {
    const bool found = scratch().locate(array, [&](int file, off_t offset) {
        while (!bytes.empty()) {
            const ssize_t count = call(file, bytes.data(), bytes.size(), offset);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) scratch().failed(count < 0 ? errno : EIO);
            bytes = bytes.subspan(static_cast<std::size_t>(count));
            offset += count;
        }
    });
    ISOATLAS_CHECK(found);
}

}  // namespace

MemoryLimit::MemoryLimit(std::int64_t bytes, const std::string& folder) : holds_(bytes > 0) {
    if (holds_) scratch().start(bytes, folder);
}

MemoryLimit::~MemoryLimit() {
    if (holds_) scratch().stop();
}

PinInMemory::PinInMemory() : before_(std::exchange(keeps_in_memory, true)) {}
PinInMemory::~PinInMemory() { keeps_in_memory = before_; }

void* take_scratch(std::size_t bytes) { return scratch().take(bytes); }
bool give_scratch(void* memory, std::size_t bytes) noexcept { return scratch().give(memory, bytes); }
std::size_t check_memory() {
    constexpr std::int64_t kMin = std::int64_t{1} << 18;
    static const std::int64_t threads = std::max(1U, std::thread::hardware_concurrency());
    if (!scratch().active()) return std::numeric_limits<std::size_t>::max();
    return static_cast<std::size_t>(std::max(scratch().check() / (2 * threads), kMin));
}
std::size_t BudgetPoll::look() {
    if (!scratch().active()) return std::numeric_limits<std::size_t>::max();
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
std::int64_t memory_at_random() noexcept { return scratch().active() ? scratch().at_random() : std::numeric_limits<std::int64_t>::max(); }
bool is_scratch(const void* memory) {
    return scratch().locate(memory, [](int, off_t) {});
}

void read_scratch(const void* from, std::span<std::byte> to) {
    transfer(from, to, [](int file, std::byte* part, std::size_t size, off_t offset) { return ::pread(file, part, size, offset); });
}

void write_scratch(void* to, std::span<const std::byte> from) {
    transfer(to, from, [](int file, const std::byte* part, std::size_t size, off_t offset) { return ::pwrite(file, part, size, offset); });
}

std::int64_t memory_limit() noexcept { return scratch().limit(); }
bool memory_is_limited() noexcept { return scratch().active(); }

}  // namespace isoatlas

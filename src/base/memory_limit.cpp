#include "base/memory_limit.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <thread>

#include "base/check.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kLeastPiece = std::size_t{1} << 20;  // smaller arrays stay in memory
constexpr std::size_t kPage = 4096;

std::size_t rounded(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

[[noreturn]] void scratch_failed(const std::string& folder, int error) {
    throw Error(ErrorKind::resource, {.file = folder,
                                      .what = std::string("the scratch file cannot grow: ") + std::strerror(error),
                                      .next = "free some disk space, choose another folder with --scratch, or allow more --memory"});
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

std::int64_t resident_memory(int statm) {
    char text[128] = {};
    if (::pread(statm, text, sizeof text - 1, 0) <= 0) return 0;
    long long pages = 0, resident = 0;
    return std::sscanf(text, "%lld %lld", &pages, &resident) == 2 ? resident * static_cast<std::int64_t>(kPage) : 0;
}

/// The arrays in the scratch file, and the thread that watches them.
class Scratch {
public:
    void start(std::int64_t limit, const std::string& folder) {
        const std::lock_guard lock(mutex_);
        ISOATLAS_CHECK(!active_);
        limit_ = limit, folder_ = folder;
        in_memory_ = 0, end_ = 0;
        active_ = true;
        stop_ = false;
        watcher_ = std::thread([this] { watch(); });
    }
    void stop() {
        {
            const std::lock_guard lock(mutex_);
            stop_ = true;
        }
        wake_.notify_all();
        watcher_.join();
        const std::lock_guard lock(mutex_);
        active_ = false;
        if (pieces_.empty()) close_file();
    }
    [[nodiscard]] bool active() const noexcept { return active_; }
    [[nodiscard]] std::int64_t limit() const noexcept { return active_ ? limit_.load() : 0; }

    void* take(std::size_t bytes) {
        if (!active_ || bytes < kLeastPiece) return nullptr;
        const std::lock_guard lock(mutex_);
        // A quarter of the limit for arrays in memory; the rest is for pages of the file and the program.
        if (in_memory_ + static_cast<std::int64_t>(bytes) <= limit_ / 4) {
            in_memory_ += static_cast<std::int64_t>(bytes);
            return nullptr;
        }
        if (file_ < 0) file_ = open_scratch(folder_);
        const std::size_t size = rounded(bytes);
        const auto offset = static_cast<off_t>(end_);
        // Blocks are reserved now: a full disk is an error here, and not a signal when a page is written.
        if (const int error = ::posix_fallocate(file_, offset, static_cast<off_t>(size)); error != 0) scratch_failed(folder_, error);
        void* mapped = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file_, offset);
        if (mapped == MAP_FAILED) scratch_failed(folder_, errno);
        end_ += size;
        pieces_.emplace(static_cast<char*>(mapped), Piece{offset, size});
        return mapped;
    }

    bool give(void* memory, std::size_t bytes) noexcept {
        if (bytes < kLeastPiece) return false;
        const std::lock_guard lock(mutex_);
        const auto found = pieces_.find(static_cast<char*>(memory));
        if (found == pieces_.end()) {
            in_memory_ = std::max<std::int64_t>(in_memory_ - static_cast<std::int64_t>(bytes), 0);
            return false;
        }
        const Piece piece = found->second;
        pieces_.erase(found);
        ::munmap(memory, piece.size);
        ::fallocate(file_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, piece.offset, static_cast<off_t>(piece.size));
        if (pieces_.empty() && !active_) close_file();
        return true;
    }

    void forget(void* memory, std::size_t bytes) noexcept {
        if (!active_) return;
        const std::lock_guard lock(mutex_);
        auto* const begin = static_cast<char*>(memory);
        auto found = pieces_.upper_bound(begin);
        if (found == pieces_.begin() || begin >= (--found)->first + found->second.size) return;
        const std::size_t head = (kPage - reinterpret_cast<std::uintptr_t>(begin) % kPage) % kPage;
        const std::size_t pages = bytes > head ? (bytes - head) / kPage * kPage : 0;
        if (pages > 0) ::madvise(begin + head, pages, MADV_REMOVE);
    }

private:
    struct Piece {
        off_t offset;
        std::size_t size;
    };

    void close_file() {
        if (file_ >= 0) ::close(file_);
        file_ = -1;
    }

    /// Sleeps as long as the memory that is left lasts for a thread that touches page after page.
    void watch() {
        const int statm = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
        const std::int64_t most = limit_ - limit_ / 5;
        constexpr std::int64_t kBytesPerMillisecond = 8 << 20;
        std::unique_lock lock(mutex_);
        while (!stop_) {
            const std::int64_t left = most - resident_memory(statm);
            if (left <= 0) {
                for (const auto& [memory, piece] : pieces_) ::madvise(memory, piece.size, MADV_DONTNEED);
            }
            const std::int64_t milliseconds = std::clamp<std::int64_t>(left / kBytesPerMillisecond, 1, 50);
            wake_.wait_for(lock, std::chrono::milliseconds(milliseconds), [this] { return stop_; });
        }
        ::close(statm);
    }

    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread watcher_;
    std::atomic<bool> active_ = false;
    bool stop_ = false;
    std::atomic<std::int64_t> limit_ = 0;
    std::int64_t in_memory_ = 0;
    std::string folder_;
    int file_ = -1;
    std::size_t end_ = 0;
    std::map<char*, Piece> pieces_;
};

Scratch& scratch() {
    static auto* const scratch = new Scratch;  // never destroyed: vectors may outlive it at exit
    return *scratch;
}

/// The limit of a control group, or of its parents; nothing when there is none.
std::int64_t control_group_limit() {
    std::ifstream own("/proc/self/cgroup");
    std::int64_t least = INT64_MAX;
    const auto look = [&](const std::string& path) {
        std::ifstream file(path);
        std::int64_t bytes = 0;
        if (file >> bytes && bytes > 0) least = std::min(least, bytes);
    };
    for (std::string line; std::getline(own, line);) {
        const std::size_t colon = line.rfind(':');
        if (line.rfind("0::", 0) == 0) {
            for (std::string path = line.substr(colon + 1);; path.resize(path.rfind('/'))) {
                look("/sys/fs/cgroup" + path + "/memory.max");
                if (path.empty() || path == "/") break;
            }
        } else if (line.find(":memory:") != std::string::npos) {
            look("/sys/fs/cgroup/memory" + line.substr(colon + 1) + "/memory.limit_in_bytes");
        }
    }
    return least;
}

}  // namespace

MemoryLimit::MemoryLimit(std::int64_t bytes, const std::string& folder) : holds_(bytes > 0) {
    if (holds_) scratch().start(bytes, folder);
}

MemoryLimit::~MemoryLimit() {
    if (holds_) scratch().stop();
}

std::int64_t available_memory() {
    const std::int64_t machine = static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGE_SIZE);
    return std::min(machine, control_group_limit());
}

std::int64_t peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss * std::int64_t{1024};
}

void* take_scratch(std::size_t bytes) { return scratch().take(bytes); }
bool give_scratch(void* memory, std::size_t bytes) noexcept { return scratch().give(memory, bytes); }
void forget_scratch(void* memory, std::size_t bytes) noexcept { scratch().forget(memory, bytes); }
std::int64_t memory_limit() noexcept { return scratch().limit(); }
bool memory_is_limited() noexcept { return scratch().active(); }

}  // namespace isoatlas

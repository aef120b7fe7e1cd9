#include "output/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "base/check.h"
#include "isoatlas/error.h"

namespace isoatlas {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

/// Set by WriteFault. Files are written from the calling thread only, so no lock is needed.
std::int64_t fault_after = std::numeric_limits<std::int64_t>::max();
int fault_error = 0;

std::string next_step(int error_number) {
    switch (error_number) {
        case ENOSPC:
        case EDQUOT: return "free some space or write to another disk";
        case EFBIG: return "write to a file system (or under a limit) that takes files of this size";
        case ENOENT: return "create the folder first, or check its name";
        case EACCES:
        case EPERM: return "choose a folder you may write to, or change its permissions";
        case EROFS: return "choose a folder on a disk that is not read-only";
        case EISDIR: return "give the name of a file, not of a folder";
        case EWOULDBLOCK: return "wait until the other program has finished, or choose another name";
        case ENAMETOOLONG: return "choose a shorter name";
        default: return "check the disk and the folder, then run the command again";
    }
}

/// The file behind symbolic links, also when it does not exist yet; the path itself when links go in circles (open reports it).
std::string resolve(const std::string& path) {
    std::error_code error;
    std::filesystem::path target = path;
    for (int hops = 0; hops < 40 && std::filesystem::is_symlink(target, error); ++hops) {
        const std::filesystem::path link = std::filesystem::read_symlink(target, error);
        if (error) return path;
        target = link.is_absolute() ? link : target.parent_path() / link;
    }
    return target.string();
}

/// The new name is on disk only when its folder is; systems that cannot sync folders lose nothing else.
void sync_folder(const std::string& target) {
    const std::string folder = std::filesystem::path(target).parent_path().string();
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    (void)::fsync(descriptor);
    (void)::close(descriptor);
}

}  // namespace

WriteFault::WriteFault(std::int64_t after, int error_number) {
    fault_after = after;
    fault_error = error_number;
}

WriteFault::~WriteFault() {
    fault_after = std::numeric_limits<std::int64_t>::max();
    fault_error = 0;
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), target_(resolve(path_)) {
    buffer_.reserve(kBufferBytes);
    struct stat status{};
    const bool exists = ::stat(target_.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) fail("cannot be written", EISDIR);
    if (exists && !S_ISREG(status.st_mode)) {
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail("cannot be opened for writing", errno);
    } else {
        open_partial();
        if (exists) (void)::fchmod(descriptor_, status.st_mode & 07777);  // a replaced file keeps its permissions
    }
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::open_partial() {
    const std::string partial = target_ + ".partial";
    descriptor_ = ::open(partial.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("cannot be created", errno);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {  // not every file system has locks
        (void)::close(descriptor_);
        descriptor_ = -1;
        fail("is being written by another program", EWOULDBLOCK);
    }
    partial_ = partial;
    if (::ftruncate(descriptor_, 0) != 0) {
        const int error_number = errno;
        discard();
        fail("cannot be created", error_number);
    }
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    ISOATLAS_CHECK(descriptor_ >= 0);
    if (buffer_.size() + bytes.size() > kBufferBytes) flush();
    if (bytes.size() >= kBufferBytes) {
        put(bytes.data(), bytes.size(), size_);
    } else {
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    }
    size_ += static_cast<std::int64_t>(bytes.size());
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }

void AtomicFile::overwrite(std::int64_t offset, std::span<const std::byte> bytes) {
    ISOATLAS_CHECK(descriptor_ >= 0 && offset >= 0 && offset + static_cast<std::int64_t>(bytes.size()) <= size_);
    flush();
    if (partial_.empty()) fail("cannot be written: this format needs a file, not a device or a pipe", ESPIPE);
    put(bytes.data(), bytes.size(), offset);
}

void AtomicFile::flush() {
    if (buffer_.empty()) return;
    put(buffer_.data(), buffer_.size(), size_ - static_cast<std::int64_t>(buffer_.size()));
    buffer_.clear();
}

void AtomicFile::put(const std::byte* data, std::size_t count, std::int64_t offset) {
    while (count > 0) {
        const std::int64_t allowed = std::max<std::int64_t>(fault_after - offset, 0);
        if (allowed == 0) fail("cannot be written", fault_error);
        const std::size_t some = static_cast<std::size_t>(std::min<std::int64_t>(static_cast<std::int64_t>(count), allowed));
        const ssize_t done = partial_.empty() ? ::write(descriptor_, data, some) : ::pwrite(descriptor_, data, some, offset);
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) fail("cannot be written", errno);
        data += done;
        offset += done;
        count -= static_cast<std::size_t>(done);
    }
}

void AtomicFile::commit() {
    ISOATLAS_CHECK(descriptor_ >= 0);
    flush();
    if (!partial_.empty()) {
        if (::fsync(descriptor_) != 0 && errno != EINVAL) fail("cannot be written to disk", errno);
        if (::rename(partial_.c_str(), target_.c_str()) != 0) fail("cannot be given its name", errno);
        partial_.clear();
        sync_folder(target_);
    }
    const int descriptor = std::exchange(descriptor_, -1);
    if (::close(descriptor) != 0) fail("cannot be closed", errno);
}

void AtomicFile::discard() noexcept {
    if (!partial_.empty()) (void)::unlink(partial_.c_str());  // before the lock is released
    partial_.clear();
    if (descriptor_ >= 0) (void)::close(descriptor_);
    descriptor_ = -1;
}

void AtomicFile::fail(const char* action, int error_number) const {
    throw Error(ErrorKind::resource, {.file = path_,
                                      .what = std::string(action) + ": " + std::system_category().message(error_number),
                                      .next = next_step(error_number)});
}

}  // namespace isoatlas

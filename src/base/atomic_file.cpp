#include "base/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/check.h"
#include "isoatlas/error.h"

namespace isoatlas {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

/// The file behind symbolic links, also when it does not exist yet; the path itself when links go in circles (create reports it).
std::string resolve(const std::string& path) {
    std::string target = path;
    for (int hops = 0; hops < 40; ++hops) {
        const std::filesystem::path link = file_system().link(target);
        if (link.empty()) return target;
        target = link.is_absolute() ? link.string() : (std::filesystem::path(target).parent_path() / link).string();
    }
    return path;
}

std::string folder_of(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

}  // namespace

std::string next_step_after(int error) {
    switch (-error) {
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

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), target_(resolve(path_)) {
    buffer_.reserve(kBufferBytes);
    open();
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::open() {
    using Kind = FileStatus::Kind;
    const FileStatus status = file_system().status(target_);
    if (status.kind == Kind::folder) fail("cannot be written", -EISDIR);
    if (status.kind == Kind::other) {
        OpenedFile opened = file_system().open_stream(target_);
        if (!opened.file) fail("cannot be opened for writing", opened.error);
        file_ = std::move(opened.file);
        return;
    }
    const std::string partial = target_ + ".partial";
    OpenedFile opened = file_system().create(partial);
    if (opened.error == -EWOULDBLOCK) fail("is being written by another program", opened.error);
    if (!opened.file) fail("cannot be created", opened.error);
    file_ = std::move(opened.file);
    partial_ = partial;
    if (status.kind == Kind::regular) (void)file_system().set_mode(partial_, status.mode);  // a replaced file keeps its permissions
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    ISOATLAS_CHECK(file_ != nullptr);
    const bool continues = buffer_begin_ + static_cast<std::int64_t>(buffer_.size()) == size_;
    if (!continues || buffer_.size() + bytes.size() > kBufferBytes) flush();
    if (bytes.size() >= kBufferBytes) {
        put(size_, bytes);
    } else {
        if (buffer_.empty()) buffer_begin_ = size_;
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    }
    size_ += static_cast<std::int64_t>(bytes.size());
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text.data(), text.size()))); }

void AtomicFile::write_at(std::int64_t offset, std::span<const std::byte> bytes) {
    ISOATLAS_CHECK(file_ != nullptr && offset >= 0);
    if (offset > size_) extend(offset);
    if (offset == size_) return write(bytes);
    flush();
    put(offset, bytes);
    size_ = std::max(size_, offset + static_cast<std::int64_t>(bytes.size()));
}

void AtomicFile::reserve(std::int64_t size) {
    ISOATLAS_CHECK(file_ != nullptr);
    if (!partial_.empty()) require(file_->reserve(size), "cannot be written");
}

void AtomicFile::extend(std::int64_t size) {
    ISOATLAS_CHECK(file_ != nullptr && size >= size_);
    if (size == size_) return;
    flush();
    if (partial_.empty()) fail("cannot be written: this format needs a file, not a device or a pipe", -ESPIPE);
    require(file_->resize(size), "cannot be written");
    size_ = size;
}

void AtomicFile::flush() {
    if (buffer_.empty()) return;
    put(buffer_begin_, buffer_);
    buffer_.clear();
}

void AtomicFile::put(std::int64_t offset, std::span<const std::byte> bytes) {
    if (partial_.empty() && offset != written_) fail("cannot be written: this format needs a file, not a device or a pipe", -ESPIPE);
    require(write_fully(*file_, offset, bytes), "cannot be written");
    written_ = offset + static_cast<std::int64_t>(bytes.size());
}

void AtomicFile::commit() {
    ISOATLAS_CHECK(file_ != nullptr);
    flush();
    require(file_->sync(), "cannot be written to disk");
    if (!partial_.empty()) {  // renamed while it is locked: nobody else may take the name for their own
        require(file_system().rename(partial_, target_), "cannot be given its name");
        partial_.clear();
        require(file_system().sync_folder(folder_of(target_)), "is complete, but its name may be lost in a power failure");
    }
    const std::unique_ptr<File> file = std::move(file_);
    require(file->close(), "cannot be closed");
}

void AtomicFile::discard() noexcept {
    if (!partial_.empty()) (void)file_system().remove(partial_);  // before the lock is released
    partial_.clear();
    file_.reset();
}

void AtomicFile::require(int error, const char* action) const {
    if (error < 0) fail(action, error);
}

void AtomicFile::fail(const char* action, int error) const {
    throw Error(
        ErrorKind::resource,
        {.file = path_, .what = std::string(action) + ": " + std::system_category().message(-error), .next = next_step_after(error)});
}

}  // namespace isoatlas

#include "base/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/check.h"
#include "base/output_target.h"
#include "base/temporary_name.h"
#include "isoatlas/error.h"

namespace isoatlas {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

constexpr int kMaxNames = 100;                // names tried: 64 random bits hardly ever collide
constexpr std::size_t kMaxEntries = 100'000;  // of a folder that is tidied up
constexpr const char* kNeedsFile = "cannot be written: this format needs a file, not a device or a pipe";

/// Removes temporary files that a crash has left in a folder: only our names, and only files of this user that no process has locked.
void tidy_up(const std::string& folder) {
    for (const std::string& name : file_system().entries(folder, kMaxEntries)) {
        if (is_temporary_name(name)) file_system().remove_abandoned(folder + "/" + name);
    }
}

/// Repeats the call with new names in a folder until it does not return -EEXIST. Returns its last result.
template <class Call>
int with_new_name(const std::string& folder, std::string& name, const Call& call) {
    int error = -EEXIST;
    for (int i = 0; i < kMaxNames && error == -EEXIST; ++i) {
        name = (folder == "/" ? "" : folder) + "/" + temporary_name();
        error = call(name);
    }
    if (error < 0) name.clear();
    return error;
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : Sink(std::move(path)) {
    buffer_.reserve(kBufferBytes);
    open();
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::open() {
    const OutputTarget target = require_target(name());
    target_ = target.path;
    is_stream_ = target.is_stream;
    if (is_stream_) {
        OpenedFile opened = file_system().open_stream(target_);
        if (!opened.file) fail("cannot be opened for writing", opened.error);
        file_ = std::move(opened.file);
        return;
    }
    const bool replaces = target.status.kind == FileStatus::Kind::regular;
    tidy_up(folder_of(target_));
    open_temporary(replaces ? target.status.mode & 0777U : 0666U);
    if (replaces) (void)file_->set_mode(target.status.mode & 0777U);  // before content is written: a replaced file keeps its permissions
}

void AtomicFile::open_temporary(unsigned mode) {
    const std::string folder = folder_of(target_);
    OpenedFile opened = file_system().create_unnamed(folder, mode);
    if (opened.error == -EOPNOTSUPP) {
        require(with_new_name(folder, partial_,
                              [&](const std::string& name) {
                                  opened = file_system().create(name, mode);
                                  return opened.file ? 0 : opened.error;
                              }),
                "cannot be created");
    }
    if (!opened.file) fail("cannot be created", opened.error);
    file_ = std::move(opened.file);
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
    if (!is_stream_) require(file_->reserve(size), "cannot be written");
}

void AtomicFile::extend(std::int64_t size) {
    ISOATLAS_CHECK(file_ != nullptr && size >= size_);
    if (size == size_) return;
    flush();
    if (is_stream_) fail(kNeedsFile, -ESPIPE);
    require(file_->resize(size), "cannot be written");
    size_ = size;
}

void AtomicFile::flush() {
    if (buffer_.empty()) return;
    put(buffer_begin_, buffer_);
    buffer_.clear();
}

void AtomicFile::put(std::int64_t offset, std::span<const std::byte> bytes) {
    if (is_stream_ && offset != written_) fail(kNeedsFile, -ESPIPE);
    require(write_fully(*file_, offset, bytes), "cannot be written");
    written_ = offset + static_cast<std::int64_t>(bytes.size());
}

void AtomicFile::commit() {
    ISOATLAS_CHECK(file_ != nullptr);
    flush();
    require(file_->sync(), "cannot be written to disk");
    if (!is_stream_) take_name();
    const std::unique_ptr<File> file = std::move(file_);
    require(file->close(), "cannot be closed");
}

/// The file stays locked until it has its name, so that no other process takes it for an abandoned one.
void AtomicFile::take_name() {
    const std::string folder = folder_of(target_);
    if (partial_.empty()) {
        require(with_new_name(folder, partial_, [&](const std::string& name) { return file_->take_name(name); }), "cannot be given a name");
    }
    require(file_system().rename(partial_, target_), "cannot be given its name");
    partial_.clear();
    require(file_system().sync_folder(folder), "is complete, but its name may be lost in a power failure");
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
    throw Error(ErrorKind::resource, {.file = name(),
                                      .what = std::string(action) + ": " + std::system_category().message(-error),
                                      .next = next_step_after(error),
                                      .reason = reason_after(error)});
}

}  // namespace isoatlas

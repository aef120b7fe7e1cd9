// The operating system's files.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "base/file_system.h"
#include "base/temporary_name.h"
#include "base/unfinished.h"

namespace isoatlas {
namespace {

int error_of(int result) { return result < 0 ? -errno : 0; }

/// Repeats a call that a signal interrupts.
template <class Call>
int repeated(const Call& call) {
    int error = error_of(call());
    while (error == -EINTR) error = error_of(call());
    return error;
}

/// The whole file as a lock that belongs to the open file, not to the process: two parts of one process exclude each other too.
struct flock whole_file(short type) {
    struct flock lock{};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    return lock;
}

/// Path of an open file without a name: linking it by its descriptor alone takes the superuser.
std::string path_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

class SystemFile : public File {
public:
    explicit SystemFile(int descriptor) : descriptor_(descriptor) {
        struct stat status{};
        if (::fstat(descriptor_, &status) == 0) size_ = status.st_size;
    }
    ~SystemFile() override {
        if (descriptor_ >= 0) (void)::close(descriptor_);
    }
    std::int64_t size() const override { return size_; }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        const ::ssize_t done = ::pread(descriptor_, out.data(), out.size(), offset);
        return done < 0 ? -errno : done;
    }
    std::ptrdiff_t read_nowait(std::int64_t offset, std::span<std::byte> out) override {
        const ::iovec part{out.data(), out.size()};
        const ::ssize_t done = ::preadv2(descriptor_, &part, 1, offset, RWF_NOWAIT);
        if (done >= 0) return done;
        return errno == EAGAIN ? -EAGAIN : read_at(offset, out);  // not every file system supports it
    }
    void prefetch(std::int64_t offset, std::int64_t bytes) override {
        (void)::posix_fadvise(descriptor_, offset, bytes, POSIX_FADV_WILLNEED);
    }
    void drop_pages() override { (void)::posix_fadvise(descriptor_, 0, 0, POSIX_FADV_DONTNEED); }
    std::ptrdiff_t write_at(std::int64_t offset, std::span<const std::byte> bytes) override {
        const ::ssize_t done = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset);
        return done < 0 ? -errno : done;
    }
    int resize(std::int64_t size) override {
        return repeated([&] { return ::ftruncate(descriptor_, size); });
    }
    int reserve(std::int64_t size) override {
        const int error = repeated([&] { return ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, 0, size); });
        return error == -EOPNOTSUPP || error == -ENOSYS || error == -EINVAL ? 0 : error;
    }
    int sync() override {
        const int error = repeated([&] { return ::fsync(descriptor_); });
        return error == -EINVAL ? 0 : error;  // a file that has nothing to sync
    }
    int set_mode(unsigned mode) override { return error_of(::fchmod(descriptor_, mode)); }
    int take_name(const std::string& path) override {
        note_unfinished(path);
        const int error = error_of(::linkat(AT_FDCWD, path_of(descriptor_).c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW));
        if (error < 0) forget_unfinished(path);
        return error;
    }
    int close() override {  // not repeated: after EINTR the descriptor is gone
        const int error = error_of(::close(std::exchange(descriptor_, -1)));
        return error == -EINTR ? 0 : error;
    }

protected:
    int descriptor_;

private:
    std::int64_t size_ = 0;
};

class SystemStream final : public SystemFile {
public:
    using SystemFile::SystemFile;
    std::ptrdiff_t write_at(std::int64_t, std::span<const std::byte> bytes) override {
        const ::ssize_t done = ::write(descriptor_, bytes.data(), bytes.size());
        return done < 0 ? -errno : done;
    }
    int sync() override { return 0; }
};

/// Does the path still name the open file? It may have been renamed or removed before the lock was taken.
bool is_named(int descriptor, const std::string& path) {
    struct stat own{}, named{};
    return ::fstat(descriptor, &own) == 0 && ::lstat(path.c_str(), &named) == 0 && own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

/// A regular file of this user without other hard links.
bool is_plainly_own(int descriptor) {
    struct stat status{};
    return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() && status.st_nlink == 1;
}

/// Takes the lock of an open file. Systems without locks report success, unless `must_be_told`.
int take_lock(int descriptor, bool must_be_told) {
    struct flock lock = whole_file(F_WRLCK);
    const int error = repeated([&] { return ::fcntl(descriptor, F_OFD_SETLK, &lock); });
    return error == -EWOULDBLOCK || must_be_told ? error : 0;
}

FileStatus status_from(const struct stat& status, const std::string& path) {
    using EntryKind = FileStatus::Kind;
    const mode_t type = status.st_mode & S_IFMT;
    FileStatus found;
    found.kind = type == S_IFREG   ? EntryKind::regular
                 : type == S_IFDIR ? EntryKind::folder
                 : type == S_IFLNK ? EntryKind::link
                                   : EntryKind::other;
    found.mode = status.st_mode & 07777U;
    found.own = status.st_uid == ::geteuid();
    found.trusted = found.own || status.st_uid == 0;
    found.names = status.st_nlink;
    const bool refused = found.kind == EntryKind::regular && (found.own ? (found.mode & S_IWUSR) == 0 : (found.mode & 0222U) == 0);
    found.writable = !refused && (found.kind == EntryKind::link || ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0);
    return found;
}

class SystemFiles final : public FileSystem {
public:
    FileStatus status(const std::string& path) override {
        struct stat status{};
        if (::stat(path.c_str(), &status) != 0) return {.error = -errno};
        return status_from(status, path);
    }
    FileStatus status_of_name(const std::string& path) override {
        struct stat status{};
        if (::lstat(path.c_str(), &status) != 0) return {.error = -errno};
        return status_from(status, path);
    }
    OpenedFile open(const std::string& path) override { return opened<SystemFile>(::open(path.c_str(), O_RDONLY | O_CLOEXEC)); }
    std::string link(const std::string& path) override {
        std::error_code none;
        return std::filesystem::read_symlink(path, none).string();
    }
    std::string resolved(const std::string& path) override {
        std::error_code error;
        const std::filesystem::path absolute = std::filesystem::absolute(path, error);
        if (error) return FileSystem::resolved(path);
        const std::filesystem::path real = std::filesystem::weakly_canonical(absolute, error);
        const std::filesystem::path path_found = error ? absolute.lexically_normal() : real;
        return (path_found.has_filename() ? path_found : path_found.parent_path()).string();
    }
    OpenedFile open_stream(const std::string& path) override { return opened<SystemStream>(::open(path.c_str(), O_WRONLY | O_CLOEXEC)); }
    OpenedFile create(const std::string& path, unsigned mode) override {
        if (is_temporary_name(path)) note_unfinished(path);
        const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
        const int error = error_of(descriptor);
        OpenedFile result{std::make_unique<SystemFile>(descriptor), error};
        // A cleanup may have removed it meanwhile: then the caller tries another name.
        if (error == 0 && (take_lock(descriptor, false) < 0 || !is_named(descriptor, path))) result.error = -EEXIST;
        if (result.error < 0) {
            forget_unfinished(path);
            result.file.reset();
        }
        return result;
    }
    OpenedFile create_unnamed(const std::string& folder, unsigned mode) override {
        const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
        if (descriptor < 0) return {nullptr, errno == EISDIR || errno == EINVAL || errno == ENOSYS ? -EOPNOTSUPP : -errno};
        OpenedFile result{std::make_unique<SystemFile>(descriptor), 0};
        if (::access(path_of(descriptor).c_str(), F_OK) != 0) return {nullptr, -EOPNOTSUPP};  // it could not get a name
        (void)take_lock(descriptor, false);  // the file is not visible yet; the lock counts once it has a name
        return result;
    }
    OpenedFile lock(const std::string& path) override {
        for (;;) {
            int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
            const bool is_new = descriptor >= 0;
            if (!is_new && errno == EEXIST) descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
            const int error = error_of(descriptor);
            if (error == -ENOENT && status(folder_of(path)).kind == FileStatus::Kind::folder) continue;  // removed since
            if (error < 0) return {nullptr, error == -ELOOP || error == -ENXIO || error == -EISDIR ? -EPERM : error};
            OpenedFile result{std::make_unique<SystemFile>(descriptor), 0};
            const bool is_ours = is_new || is_plainly_own(descriptor);
            if (is_ours && take_lock(descriptor, false) == -EWOULDBLOCK) return {nullptr, -EWOULDBLOCK};
            if (!is_named(descriptor, path)) continue;  // removed since
            if (!is_ours) return {nullptr, -EPERM};
            return result;
        }
    }
    bool is_held(const std::string& path) override {
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (descriptor < 0) return false;
        const SystemFile closes(descriptor);
        struct flock lock = whole_file(F_RDLCK);  // tested, not taken: taking it would block lock()
        return repeated([&] { return ::fcntl(descriptor, F_OFD_GETLK, &lock); }) == 0 && lock.l_type != F_UNLCK;
    }
    void remove_abandoned(const std::string& path) override {
        const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (descriptor < 0) return;
        const SystemFile closes(descriptor);
        if (is_plainly_own(descriptor) && take_lock(descriptor, true) == 0 && is_named(descriptor, path)) (void)::unlink(path.c_str());
    }
    int rename(const std::string& from, const std::string& to) override {
        const int error = error_of(::rename(from.c_str(), to.c_str()));
        if (error == 0) forget_unfinished(from);
        return error;
    }
    int remove(const std::string& path) override {
        const int error = error_of(::unlink(path.c_str()));
        forget_unfinished(path);
        return error;
    }
    int make_folder(const std::string& path) override { return error_of(::mkdir(path.c_str(), 0777)); }
    int remove_folder(const std::string& path) override { return error_of(::rmdir(path.c_str())); }
    std::vector<std::string> entries(const std::string& path, std::size_t max) override {
        std::vector<std::string> names;
        std::error_code error;
        std::filesystem::directory_iterator at(path, error);
        while (!error && at != std::filesystem::directory_iterator() && names.size() < max) {
            names.push_back(at->path().filename().string());
            at.increment(error);
        }
        return names;
    }
    int sync_folder(const std::string& path) override {
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) return 0;  // a folder may be writable but not readable
        const int error = SystemFile(descriptor).sync();
        return error == -ENOTSUP || error == -EBADF || error == -EACCES ? 0 : error;
    }

private:
    template <class Opened>
    static OpenedFile opened(int descriptor) {
        if (descriptor < 0) return {nullptr, -errno};
        return {std::make_unique<Opened>(descriptor), 0};
    }
};

}  // namespace

FileSystem& system_files() {
    static SystemFiles files;
    return files;
}

}  // namespace isoatlas

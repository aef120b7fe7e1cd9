// The operating system's files.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <utility>

#include "base/file_system.h"

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
    std::ptrdiff_t read_present(std::int64_t offset, std::span<std::byte> out) override {
        const ::iovec part{out.data(), out.size()};
        const ::ssize_t done = ::preadv2(descriptor_, &part, 1, offset, RWF_NOWAIT);
        if (done >= 0) return done;
        return errno == EAGAIN ? -EAGAIN : read_at(offset, out);  // not every file system can tell
    }
    void expect(std::int64_t offset, std::int64_t bytes) override {
        (void)::posix_fadvise(descriptor_, offset, bytes, POSIX_FADV_WILLNEED);
    }
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

/// Does the path still name the open file? Somebody may have renamed or removed it before we held the lock.
bool is_named(int descriptor, const std::string& path) {
    struct stat own{}, named{};
    return ::fstat(descriptor, &own) == 0 && ::stat(path.c_str(), &named) == 0 && own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

class SystemFiles final : public FileSystem {
public:
    FileStatus status(const std::string& path) override {
        struct stat status{};
        if (::stat(path.c_str(), &status) != 0) return {.error = -errno};
        using Kind = FileStatus::Kind;
        const Kind kind = S_ISREG(status.st_mode) ? Kind::regular : S_ISDIR(status.st_mode) ? Kind::folder : Kind::other;
        return {.kind = kind, .mode = status.st_mode & 07777U};
    }
    OpenedFile open(const std::string& path) override { return opened<SystemFile>(::open(path.c_str(), O_RDONLY | O_CLOEXEC)); }
    std::string link(const std::string& path) override {
        std::error_code none;
        return std::filesystem::read_symlink(path, none).string();
    }
    OpenedFile open_stream(const std::string& path) override { return opened<SystemStream>(::open(path.c_str(), O_WRONLY | O_CLOEXEC)); }
    OpenedFile create(const std::string& path) override {
        for (;;) {
            OpenedFile result;
            const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
            if (descriptor < 0) return {nullptr, -errno};
            result.file = std::make_unique<SystemFile>(descriptor);
            struct flock lock = whole_file(F_WRLCK);
            if (repeated([&] { return ::fcntl(descriptor, F_OFD_SETLK, &lock); }) == -EWOULDBLOCK) return {nullptr, -EWOULDBLOCK};
            if (!is_named(descriptor, path)) continue;  // not every file system has locks, so that only "held" is an answer
            result.error = result.file->resize(0);
            if (result.error < 0) result.file.reset();
            return result;
        }
    }
    bool is_held(const std::string& path) override {
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        if (descriptor < 0) return false;
        const SystemFile closes(descriptor);
        struct flock lock = whole_file(F_RDLCK);  // asked for, not taken: taking it would be in the way of create()
        return repeated([&] { return ::fcntl(descriptor, F_OFD_GETLK, &lock); }) == 0 && lock.l_type != F_UNLCK;
    }
    int set_mode(const std::string& path, unsigned mode) override { return error_of(::chmod(path.c_str(), mode)); }
    int rename(const std::string& from, const std::string& to) override { return error_of(::rename(from.c_str(), to.c_str())); }
    int remove(const std::string& path) override { return error_of(::unlink(path.c_str())); }
    int make_folder(const std::string& path) override { return error_of(::mkdir(path.c_str(), 0777)); }
    int remove_folder(const std::string& path) override { return error_of(::rmdir(path.c_str())); }
    std::vector<std::string> entries(const std::string& path, std::size_t most) override {
        std::vector<std::string> names;
        std::error_code error;
        std::filesystem::directory_iterator at(path, error);
        while (!error && at != std::filesystem::directory_iterator() && names.size() < most) {
            names.push_back(at->path().filename().string());
            at.increment(error);
        }
        return names;
    }
    int sync_folder(const std::string& path) override {
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) return 0;  // one may write to a folder that one may not read
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

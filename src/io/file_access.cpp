#include "io/file_access.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "isoatlas/error.h"

namespace isoatlas::io {
namespace {

[[noreturn]] void cannot_open(const std::string& path, int error) {
    const char* next = error == EACCES ? "give yourself permission to read the file" : "check the path";
    throw Error(ErrorKind::input, {.file = path, .what = std::string("cannot be opened: ") + std::strerror(error), .next = next});
}

class SystemFile final : public FileHandle {
public:
    SystemFile(int descriptor, std::int64_t size) : descriptor_(descriptor), size_(size) {}
    SystemFile(const SystemFile&) = delete;
    SystemFile& operator=(const SystemFile&) = delete;
    ~SystemFile() override { ::close(descriptor_); }
    std::int64_t size() const override { return size_; }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        const ::ssize_t got = ::pread(descriptor_, out.data(), out.size(), offset);
        return got < 0 ? -errno : got;
    }

private:
    int descriptor_;
    std::int64_t size_;
};

FileOpener& current_opener() {
    static FileOpener opener;
    return opener;
}

}  // namespace

std::unique_ptr<FileHandle> open_system_file(const std::string& path) {
    struct stat status{};
    if (::stat(path.c_str(), &status) != 0) cannot_open(path, errno);
    if (S_ISDIR(status.st_mode)) {
        throw Error(ErrorKind::input, {.file = path, .what = "is a directory", .expected = "a file", .next = "name a file inside it"});
    }
    if (!S_ISREG(status.st_mode)) {  // a pipe would block and cannot go back
        throw Error(ErrorKind::input, {.file = path, .what = "is not a regular file", .next = "copy the data into a file and open that"});
    }
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) cannot_open(path, errno);
    return std::make_unique<SystemFile>(descriptor, status.st_size);
}

std::unique_ptr<FileHandle> open_file(const std::string& path) {
    const FileOpener& opener = current_opener();
    return opener ? opener(path) : open_system_file(path);
}

bool file_exists(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

bool is_directory(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored);
}

std::vector<std::string> directory_entries(const std::string& path, std::size_t most) {
    std::vector<std::string> names;
    std::error_code error;
    std::filesystem::directory_iterator at(path, error);
    while (!error && at != std::filesystem::directory_iterator() && names.size() < most) {
        names.push_back(at->path().filename().string());
        at.increment(error);
    }
    return names;
}

void replace_file_opener(FileOpener opener) { current_opener() = std::move(opener); }

std::size_t read_available(FileHandle& file, const std::string& path, std::int64_t offset, std::span<std::byte> out) {
    std::size_t done = 0;
    while (done < out.size()) {
        const std::int64_t position = offset + static_cast<std::int64_t>(done);
        const std::ptrdiff_t got = file.read_at(position, out.subspan(done));
        if (got == -EINTR) continue;
        if (got < 0) {
            throw Error(ErrorKind::input, {.file = path,
                                           .where = "offset " + std::to_string(position),
                                           .what = std::string("reading failed: ") + std::strerror(static_cast<int>(-got)),
                                           .next = "check the disk, or copy the file elsewhere and try again"});
        }
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

void read_fully(FileHandle& file, const std::string& path, std::int64_t offset, std::span<std::byte> out) {
    const std::size_t got = read_available(file, path, offset, out);
    if (got == out.size()) return;
    throw Error(ErrorKind::input, {.file = path,
                                   .where = "offset " + std::to_string(offset + static_cast<std::int64_t>(got)),
                                   .what = "the file ends early",
                                   .expected = std::to_string(out.size() - got) + " more bytes",
                                   .next = "the file is truncated: get it again"});
}

}  // namespace isoatlas::io

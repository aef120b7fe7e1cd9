#include "base/file_system.h"

#include <atomic>
#include <cerrno>
#include <filesystem>

namespace isoatlas {

File::~File() = default;
std::ptrdiff_t File::read_at(std::int64_t, std::span<std::byte>) { return -EBADF; }
std::ptrdiff_t File::read_nowait(std::int64_t offset, std::span<std::byte> out) { return read_at(offset, out); }
void File::prefetch(std::int64_t, std::int64_t) {}
void File::prefetch_ranges(std::span<const FileRange> ranges) {
    for (const FileRange& range : ranges) prefetch(range.begin, range.bytes());
}
void File::fetch_ranges(std::span<const FileRange>) {}
void File::drop_pages() {}
std::ptrdiff_t File::write_at(std::int64_t, std::span<const std::byte>) { return -EBADF; }
int File::resize(std::int64_t) { return -EBADF; }
int File::reserve(std::int64_t) { return -EBADF; }
int File::sync() { return -EBADF; }
int File::set_mode(unsigned) { return -EBADF; }
int File::take_name(const std::string&) { return -EBADF; }
int File::close() { return 0; }

FileSystem::~FileSystem() = default;
FileStatus FileSystem::status_of_name(const std::string& path) { return status(path); }
std::string FileSystem::link(const std::string&) { return {}; }
std::string FileSystem::resolved(const std::string& path) { return (std::filesystem::path("/") / path).lexically_normal().string(); }
OpenedFile FileSystem::open_stream(const std::string&) { return {nullptr, -EROFS}; }
OpenedFile FileSystem::create(const std::string&, unsigned) { return {nullptr, -EROFS}; }
OpenedFile FileSystem::create_unnamed(const std::string&, unsigned) { return {nullptr, -EOPNOTSUPP}; }
OpenedFile FileSystem::lock(const std::string&) { return {nullptr, -EROFS}; }
bool FileSystem::is_held(const std::string&) { return false; }
void FileSystem::remove_abandoned(const std::string&) {}
int FileSystem::rename(const std::string&, const std::string&) { return -EROFS; }
int FileSystem::remove(const std::string&) { return -EROFS; }
int FileSystem::make_folder(const std::string&) { return -EROFS; }
int FileSystem::remove_folder(const std::string&) { return -EROFS; }
std::vector<std::string> FileSystem::entries(const std::string&, std::size_t) { return {}; }
int FileSystem::sync_folder(const std::string&) { return -EROFS; }

namespace {

std::atomic<FileSystem*> default_files{nullptr};

Environment with_files(FileSystem& files) {
    Environment environment = current_environment();
    environment.files = &files;
    return environment;
}

}  // namespace

FileSystem& file_system() {
    FileSystem* files = current_environment().files;
    if (files == nullptr) files = default_files.load(std::memory_order_acquire);
    return files != nullptr ? *files : system_files();
}

void set_default_files(FileSystem* files) { default_files.store(files, std::memory_order_release); }

ReplacedFileSystem::ReplacedFileSystem(FileSystem& files) : scope_(with_files(files)) {}

int write_fully(File& file, std::int64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const std::ptrdiff_t done = file.write_at(offset, bytes);
        if (done == -EINTR) continue;
        if (done <= 0) return done < 0 ? static_cast<int>(done) : -EIO;
        offset += done;
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return 0;
}

}  // namespace isoatlas

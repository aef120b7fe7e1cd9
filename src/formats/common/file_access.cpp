#include "formats/common/file_access.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

[[noreturn]] void cannot_open(const std::string& path, int error) {
    if (is_address(path) && error == -ENOENT)
        throw Error(ErrorKind::input, {.file = path, .what = "there is no such file on the server", .next = "check the address"});
    const char* next = error == -EACCES ? "give yourself permission to read the file" : "check the path";
    throw Error(ErrorKind::input, {.file = path, .what = std::string("cannot be opened: ") + std::strerror(-error), .next = next});
}

[[noreturn]] void failed(const std::string& path, std::int64_t offset, std::ptrdiff_t error) {
    throw Error(ErrorKind::input, {.file = path,
                                   .where = "offset " + std::to_string(offset),
                                   .what = std::string("reading failed: ") + std::strerror(static_cast<int>(-error)),
                                   .next = "check the disk, or copy the file elsewhere and try again"});
}

class BytesFile final : public File {
public:
    explicit BytesFile(std::string_view bytes) : bytes_(bytes) {}
    std::int64_t size() const override { return static_cast<std::int64_t>(bytes_.size()); }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        const std::string_view rest = bytes_.substr(std::min(static_cast<std::size_t>(offset), bytes_.size()));
        const std::size_t count = std::min(rest.size(), out.size());
        if (count > 0) std::memcpy(out.data(), rest.data(), count);
        return static_cast<std::ptrdiff_t>(count);
    }

private:
    std::string_view bytes_;
};

}  // namespace

std::unique_ptr<File> open_file(const std::string& path) {
    using Kind = FileStatus::Kind;
    const FileStatus status = file_system().status(path);
    if (status.kind == Kind::missing) cannot_open(path, status.error);
    if (status.kind == Kind::folder) {
        throw Error(ErrorKind::input, {.file = path, .what = "is a directory", .expected = "a file", .next = "name a file inside it"});
    }
    if (status.kind == Kind::other) {  // a pipe would block and cannot seek
        throw Error(ErrorKind::input, {.file = path, .what = "is not a regular file", .next = "copy the data into a file and open that"});
    }
    OpenedFile opened = file_system().open(path);
    if (!opened.file) cannot_open(path, opened.error);
    return std::move(opened.file);
}

std::unique_ptr<File> open_bytes(std::string_view bytes) { return std::make_unique<BytesFile>(bytes); }

bool file_exists(const std::string& path) { return file_system().status(path).kind == FileStatus::Kind::regular; }

bool is_directory(const std::string& path) { return file_system().status(path).kind == FileStatus::Kind::folder; }

std::vector<std::string> directory_entries(const std::string& path, std::size_t max) { return file_system().entries(path, max); }

std::size_t read_available(File& file, const std::string& path, std::int64_t offset, std::span<std::byte> out) {
    std::size_t done = 0;
    while (done < out.size()) {
        const std::int64_t position = offset + static_cast<std::int64_t>(done);
        const std::ptrdiff_t got = file.read_at(position, out.subspan(done));
        if (got == -EINTR) continue;
        if (got < 0) failed(path, position, got);
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return done;
}

bool read_if_present(File& file, const std::string& path, std::int64_t offset, std::span<std::byte> out) {
    const std::ptrdiff_t got = file.read_nowait(offset, out);
    if (got < 0 && got != -EAGAIN && got != -EINTR) failed(path, offset, got);
    return got == static_cast<std::ptrdiff_t>(out.size());
}

void read_fully(File& file, const std::string& path, std::int64_t offset, std::span<std::byte> out) {
    const std::size_t got = read_available(file, path, offset, out);
    if (got == out.size()) return;
    throw Error(ErrorKind::input, {.file = path,
                                   .where = "offset " + std::to_string(offset + static_cast<std::int64_t>(got)),
                                   .what = "the file ends early",
                                   .expected = std::to_string(out.size() - got) + " more bytes",
                                   .next = "the file is truncated: get it again"});
}

}  // namespace isoatlas

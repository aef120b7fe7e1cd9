#include "server/file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>

#include "base/cancel.h"
#include "base/check.h"
#include "base/file_system.h"

namespace isoatlas {
namespace {

class MemoryFile final : public File {
public:
    MemoryFile(std::string& bytes, const Context& context)
        : bytes_(bytes), context_(context), size_(static_cast<std::int64_t>(bytes.size())) {}
    std::int64_t size() const override { return size_; }
    std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
        const std::size_t first = std::min(static_cast<std::size_t>(offset), bytes_.size()),
                          count = std::min(out.size(), bytes_.size() - first);
        if (count > 0) std::memcpy(out.data(), bytes_.data() + first, count);
        return static_cast<std::ptrdiff_t>(count);
    }
    std::ptrdiff_t write_at(std::int64_t offset, std::span<const std::byte> bytes) override {
        stop_if_cancelled(context_);
        const auto first = static_cast<std::size_t>(offset);
        if (first + bytes.size() > bytes_.size()) bytes_.resize(first + bytes.size());
        if (!bytes.empty()) std::memcpy(bytes_.data() + first, bytes.data(), bytes.size());
        return static_cast<std::ptrdiff_t>(bytes.size());
    }
    int resize(std::int64_t size) override {
        bytes_.resize(static_cast<std::size_t>(size));
        return 0;
    }
    int reserve(std::int64_t size) override {
        bytes_.reserve(static_cast<std::size_t>(size));
        return 0;
    }
    int sync() override { return 0; }
    int set_mode(unsigned) override { return 0; }

private:
    std::string& bytes_;
    const Context& context_;
    std::int64_t size_;
};

/// The part of a file system that an AtomicFile needs, in memory.
class MemoryFiles final : public FileSystem {
public:
    explicit MemoryFiles(const Context& context) : context_(context) {}

    std::string& content(const std::string& path) { return files_[path]; }

    FileStatus status(const std::string& path) override {
        if (path == ".") return {.kind = FileStatus::Kind::folder, .mode = 0700};
        if (!files_.contains(path)) return {.error = -ENOENT};
        return {.kind = FileStatus::Kind::regular, .mode = 0600};
    }
    OpenedFile open(const std::string& path) override {
        if (!files_.contains(path)) return {nullptr, -ENOENT};
        return {std::make_unique<MemoryFile>(files_[path], context_), 0};
    }
    OpenedFile create(const std::string& path, unsigned) override {
        if (!files_.try_emplace(path).second) return {nullptr, -EEXIST};
        return open(path);
    }
    int rename(const std::string& from, const std::string& to) override {
        if (!files_.contains(from)) return -ENOENT;
        files_[to] = std::move(files_[from]);
        return remove(from);
    }
    int remove(const std::string& path) override { return files_.erase(path) == 1 ? 0 : -ENOENT; }
    int sync_folder(const std::string&) override { return 0; }

private:
    const Context& context_;
    std::map<std::string, std::string> files_;
};

}  // namespace

std::string file_bytes(const std::string& extension, const std::function<void(const std::string&)>& write, const Context& context) {
    MemoryFiles files(context);
    const OwnFileSystem own(files);
    const std::string path = "file" + extension;
    write(path);
    ISOATLAS_CHECK(files.status(path).kind == FileStatus::Kind::regular);
    return std::move(files.content(path));
}

}  // namespace isoatlas

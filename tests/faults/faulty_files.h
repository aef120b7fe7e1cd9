// A disk that fails: the operation with a certain number, everything from it on, or every write beyond some byte; and one that reads and
// writes a few bytes at a time and is interrupted in between.
#pragma once

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "base/file_system.h"

namespace isoatlas::test {

struct Fault {
    std::int64_t at = -1;  ///< number of the operation that fails; -1: none
    int error = EIO;
    bool for_ever = false;  ///< so do all later ones
    std::size_t max = 0;    ///< bytes of a read or write, and every third one is interrupted; 0: all
    std::int64_t full_at = std::numeric_limits<std::int64_t>::max();  ///< nothing can be written at this byte of a file and beyond
};

/// Counts the operations, over all files; status() and closing count, size(), link(), entries() and remove_abandoned(), which cannot fail,
/// do not.
class FaultyFiles final : public FileSystem {
public:
    explicit FaultyFiles(Fault fault, FileSystem& below = system_files()) : fault_(fault), below_(below) {}

    [[nodiscard]] std::int64_t operations() const { return operations_; }
    [[nodiscard]] bool has_failed() const { return fault_.at >= 0 && operations_ > fault_.at; }
    [[nodiscard]] const std::string& failed() const { return failed_; }  ///< name of the operation that failed first
    /// From now on with this fault; operations are counted from 0 again.
    void restart(Fault fault) { fault_ = fault, operations_ = 0, failed_.clear(); }

    FileStatus status(const std::string& path) override {
        const int error = count("status");
        return error < 0 ? FileStatus{.error = error} : below_.status(path);
    }
    FileStatus status_of_name(const std::string& path) override {
        const int error = count("status");
        return error < 0 ? FileStatus{.error = error} : below_.status_of_name(path);
    }
    OpenedFile open(const std::string& path) override {
        return opened("open", [&] { return below_.open(path); });
    }
    std::string link(const std::string& path) override { return below_.link(path); }
    OpenedFile open_stream(const std::string& path) override {
        return opened("open", [&] { return below_.open_stream(path); });
    }
    OpenedFile create(const std::string& path, unsigned mode) override {
        return opened("create", [&] { return below_.create(path, mode); });
    }
    OpenedFile create_unnamed(const std::string& folder, unsigned mode) override {
        return opened("create_unnamed", [&] { return below_.create_unnamed(folder, mode); });
    }
    OpenedFile lock(const std::string& path) override {
        return opened("lock", [&] { return below_.lock(path); });
    }
    bool is_held(const std::string& path) override { return below_.is_held(path); }
    void remove_abandoned(const std::string& path) override { below_.remove_abandoned(path); }
    int rename(const std::string& from, const std::string& to) override {
        return done("rename", [&] { return below_.rename(from, to); });
    }
    int remove(const std::string& path) override {
        return done("remove", [&] { return below_.remove(path); });
    }
    int make_folder(const std::string& path) override {
        return done("make_folder", [&] { return below_.make_folder(path); });
    }
    int remove_folder(const std::string& path) override {
        return done("remove_folder", [&] { return below_.remove_folder(path); });
    }
    std::vector<std::string> entries(const std::string& path, std::size_t max) override { return below_.entries(path, max); }
    int sync_folder(const std::string& path) override {
        return done("sync_folder", [&] { return below_.sync_folder(path); });
    }

private:
    class Opened final : public File {
    public:
        Opened(FaultyFiles& files, std::unique_ptr<File> file) : files_(files), file_(std::move(file)) {}
        std::int64_t size() const override { return file_->size(); }
        std::ptrdiff_t read_at(std::int64_t offset, std::span<std::byte> out) override {
            if (const int error = files_.count_transfer("read"); error < 0) return error;
            return file_->read_at(offset, out.first(files_.max_of(out.size())));
        }
        std::ptrdiff_t write_at(std::int64_t offset, std::span<const std::byte> bytes) override {
            if (const int error = files_.count_transfer("write"); error < 0) return error;
            const std::int64_t room = std::max<std::int64_t>(files_.fault_.full_at - offset, 0);
            if (room == 0 && !bytes.empty()) return -files_.fault_.error;
            const std::size_t max = files_.max_of(bytes.size());
            return file_->write_at(offset, bytes.first(std::min<std::size_t>(max, static_cast<std::size_t>(room))));
        }
        int resize(std::int64_t size) override {
            return files_.done("resize", [&] { return file_->resize(size); });
        }
        int reserve(std::int64_t size) override {
            return files_.done("reserve", [&] { return file_->reserve(size); });
        }
        int sync() override {
            return files_.done("sync", [&] { return file_->sync(); });
        }
        int set_mode(unsigned mode) override {
            return files_.done("set_mode", [&] { return file_->set_mode(mode); });
        }
        int take_name(const std::string& path) override {
            return files_.done("take_name", [&] { return file_->take_name(path); });
        }
        int close() override {
            return files_.done("close", [&] { return file_->close(); });
        }

    private:
        FaultyFiles& files_;
        std::unique_ptr<File> file_;
    };

    int count(const char* name) {
        const std::int64_t number = operations_++;
        const bool fails = fault_.at >= 0 && (number == fault_.at || (fault_.for_ever && number > fault_.at));
        if (number == fault_.at) failed_ = name;
        return fails ? -fault_.error : 0;
    }
    int count_transfer(const char* name) {
        const int error = count(name);
        return error == 0 && fault_.max > 0 && operations_ % 3 == 0 ? -EINTR : error;
    }
    [[nodiscard]] std::size_t max_of(std::size_t size) const { return fault_.max > 0 ? std::min(size, fault_.max) : size; }

    template <class Call>
    int done(const char* name, const Call& call) {
        const int error = count(name);
        return error < 0 ? error : call();
    }
    template <class Call>
    OpenedFile opened(const char* name, const Call& call) {
        if (const int error = count(name); error < 0) return {nullptr, error};
        OpenedFile below = call();
        if (!below.file) return below;
        return {std::make_unique<Opened>(*this, std::move(below.file)), 0};
    }

    Fault fault_;
    FileSystem& below_;
    std::atomic<std::int64_t> operations_ = 0;
    std::string failed_;
};

/// While it lives, every file of the system is full at the byte `after`, and writing there fails with `error`.
class FullDisk {
public:
    FullDisk(std::int64_t after, int error) : files_({.error = error, .full_at = after}), replaced_(files_) {}

private:
    FaultyFiles files_;
    ReplacedFileSystem replaced_;
};

}  // namespace isoatlas::test

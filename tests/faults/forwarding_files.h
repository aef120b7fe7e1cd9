// A file system that passes everything on to another one: tests override what they want to change.
#pragma once

#include "base/file_system.h"

namespace isoatlas::test {

class ForwardingFiles : public FileSystem {
public:
    explicit ForwardingFiles(FileSystem& below = system_files()) : below_(below) {}
    FileStatus status(const std::string& path) override { return below_.status(path); }
    FileStatus status_of_name(const std::string& path) override { return below_.status_of_name(path); }
    OpenedFile open(const std::string& path) override { return below_.open(path); }
    std::string link(const std::string& path) override { return below_.link(path); }
    std::string resolved(const std::string& path) override { return below_.resolved(path); }
    OpenedFile open_stream(const std::string& path) override { return below_.open_stream(path); }
    OpenedFile create(const std::string& path, unsigned mode) override { return below_.create(path, mode); }
    OpenedFile create_unnamed(const std::string& folder, unsigned mode) override { return below_.create_unnamed(folder, mode); }
    OpenedFile lock(const std::string& path) override { return below_.lock(path); }
    bool is_held(const std::string& path) override { return below_.is_held(path); }
    void remove_abandoned(const std::string& path) override { below_.remove_abandoned(path); }
    int rename(const std::string& from, const std::string& to) override { return below_.rename(from, to); }
    int remove(const std::string& path) override { return below_.remove(path); }
    int make_folder(const std::string& path) override { return below_.make_folder(path); }
    int remove_folder(const std::string& path) override { return below_.remove_folder(path); }
    std::vector<std::string> entries(const std::string& path, std::size_t max) override { return below_.entries(path, max); }
    int sync_folder(const std::string& path) override { return below_.sync_folder(path); }

protected:
    FileSystem& below_;
};

}  // namespace isoatlas::test

// A folder of files that appears whole or not at all: a Zarr hierarchy that is written.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_system.h"

namespace isoatlas {

/// The files go to a folder with an unpredictable name beside `path`; commit() gives it the name. Without commit() it is removed; one that
/// a crash has left is removed by the next FolderOutput beside it. Throws Error{resource}, also when there is something at `path` already:
/// a folder is never replaced. Not thread safe.
class FolderOutput {
public:
    explicit FolderOutput(std::string path);
    FolderOutput(const FolderOutput&) = delete;
    FolderOutput& operator=(const FolderOutput&) = delete;
    ~FolderOutput();

    /// Writes the file of a key, which must be new: is_sound_key().
    void put(const std::string& key, std::span<const std::byte> value);
    void put(const std::string& key, std::string_view text) { put(key, std::as_bytes(std::span(text.data(), text.size()))); }
    /// Nothing may be put afterwards.
    void commit();

private:
    [[noreturn]] void fail(const char* action, int error) const;
    void require(int error, const char* action) const;
    void make_folders(const std::string& key);

    std::string path_, partial_;        ///< partial_: empty when it has its name
    std::vector<std::string> folders_;  ///< made in it, sorted
    std::unique_ptr<File> lock_;        ///< says to others that this process is still writing
};

}  // namespace isoatlas

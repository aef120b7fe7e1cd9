#include "formats/zarr/folder_output.h"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "base/check.h"
#include "base/output_target.h"
#include "base/temporary_name.h"
#include "formats/zarr/key_store.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr const char* kLockName = "/.lock";
constexpr std::size_t kMostFiles = 10'000'000;

/// Links are removed, not followed.
void remove_tree(const std::string& root) {
    std::vector<std::string> folders{root};
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const std::string folder = folders[i];
        for (const std::string& name : file_system().entries(folder, kMostFiles)) {
            const std::string path = folder + "/" + name;
            if (file_system().status_of_name(path).kind == FileStatus::Kind::folder) {
                folders.push_back(path);
            } else {
                (void)file_system().remove(path);
            }
        }
    }
    for (std::size_t i = folders.size(); i-- > 0;) (void)file_system().remove_folder(folders[i]);
}

/// Removes folders that a crash has left: only those with our names and a lock that no process holds.
void remove_abandoned_folders(const std::string& folder) {
    constexpr std::size_t kMostEntries = 100'000;
    for (const std::string& name : file_system().entries(folder, kMostEntries)) {
        if (!is_temporary_name(name)) continue;
        const std::string path = folder + "/" + name;
        const FileStatus status = file_system().status_of_name(path);
        if (status.kind != FileStatus::Kind::folder || !status.own) continue;
        const bool has_lock = file_system().status_of_name(path + kLockName).kind == FileStatus::Kind::regular;
        if (has_lock && !file_system().is_held(path + kLockName)) remove_tree(path);
    }
}

}  // namespace

FolderOutput::FolderOutput(std::string path) : path_(std::move(path)) {
    while (path_.size() > 1 && path_.ends_with('/')) path_.pop_back();
    if (file_system().status_of_name(path_).kind != FileStatus::Kind::missing) {
        throw Error(ErrorKind::resource, {.file = path_,
                                          .what = "is there already, and a folder is not replaced",
                                          .next = "remove it, or choose another name",
                                          .reason = Reason::output_is_folder});
    }
    const std::string folder = folder_of(path_);
    remove_abandoned_folders(folder);
    int error = -EEXIST;
    for (int i = 0; i < 100 && error == -EEXIST; ++i) {
        partial_ = (folder == "/" ? "" : folder) + "/" + temporary_name();
        error = file_system().make_folder(partial_);
    }
    if (error < 0) partial_.clear();
    require(error, "cannot be created");
    lock_ = file_system().lock(partial_ + kLockName).file;
}

FolderOutput::~FolderOutput() {
    if (!partial_.empty()) remove_tree(partial_);
}

void FolderOutput::make_folders(const std::string& key) {
    for (std::size_t slash = key.find('/'); slash != std::string::npos; slash = key.find('/', slash + 1)) {
        const std::string folder = key.substr(0, slash);
        const auto place = std::ranges::lower_bound(folders_, folder);
        if (place != folders_.end() && *place == folder) continue;
        require(file_system().make_folder(partial_ + "/" + folder), "cannot be created");
        folders_.insert(place, folder);
    }
}

void FolderOutput::put(const std::string& key, std::span<const std::byte> value) {
    ISOATLAS_CHECK(!partial_.empty() && is_sound_key(key));
    make_folders(key);
    OpenedFile opened = file_system().create(partial_ + "/" + key, 0666);
    if (!opened.file) fail("cannot be created", opened.error);
    require(write_fully(*opened.file, 0, value), "cannot be written");
    require(opened.file->sync(), "cannot be written to disk");
    require(opened.file->close(), "cannot be closed");
}

void FolderOutput::commit() {
    ISOATLAS_CHECK(!partial_.empty());
    for (const std::string& folder : folders_) require(file_system().sync_folder(partial_ + "/" + folder), "cannot be written to disk");
    (void)file_system().remove(partial_ + kLockName);
    lock_.reset();
    require(file_system().sync_folder(partial_), "cannot be written to disk");
    require(file_system().rename(partial_, path_), "cannot be given its name");
    partial_.clear();
    require(file_system().sync_folder(folder_of(path_)), "is complete, but its name may be lost in a power failure");
}

void FolderOutput::require(int error, const char* action) const {
    if (error < 0) fail(action, error);
}

void FolderOutput::fail(const char* action, int error) const {
    throw Error(ErrorKind::resource, {.file = path_,
                                      .what = std::string(action) + ": " + std::system_category().message(-error),
                                      .next = next_step_after(error),
                                      .reason = reason_after(error)});
}

}  // namespace isoatlas

// PATH.build: the folder of the finished phases of a build until the store is written.
//
// A phase is a file of arrays with checksums (store/container.h), written atomically; it records its volume and parameters. During a build
// the folder is locked; the lock file marks the folder as made by a build and records process and progress. A folder without that mark is
// not touched, nor are foreign files in a marked one.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "base/file_system.h"

namespace isoatlas {

class Container;
struct BuildState;
struct Contents;

class BuildFolder {
public:
    /// Creates the folder, or reuses an empty one or that of an earlier build. Throws Error{resource}: another process builds, the folder
    /// cannot be created, the path is not a folder, is a link, belongs to another user or was not made by a build; the store could not be
    /// written (base/output_target.h). Links to the store are followed: it has one folder for all its names.
    BuildFolder(const std::string& store_path, bool restart);
    /// Removes the folder when it contains no phase.
    ~BuildFolder();
    BuildFolder(const BuildFolder&) = delete;
    BuildFolder& operator=(const BuildFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string file(const std::string& phase) const { return path_ + "/" + phase; }
    /// A finished phase with the fingerprint of these contents; null: none. Others, and damaged ones, are removed; then why_not is the
    /// reason.
    [[nodiscard]] std::unique_ptr<Container> finished(const std::string& phase, const Contents& wanted, std::string& why_not) const;
    /// Publishes the progress for other processes, about once a second. Write errors are ignored.
    void say(const BuildState& state);
    /// The store is complete: removes the files of the build, and the folder if it is empty then. Returns whether it was removed.
    bool remove();

private:
    void lock(const std::string& store_path);
    void mark();

    std::string path_;
    std::unique_ptr<File> lock_;
    std::chrono::steady_clock::time_point said_ = std::chrono::steady_clock::now();
};

}  // namespace isoatlas

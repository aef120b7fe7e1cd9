// PATH.build: where the finished phases of a build lie until the store is there.
//
// A phase is a file of arrays with checksums (store/container.h), present as a whole or not at all; it tells the volume and the parameters
// it belongs to. While somebody builds, the folder is locked; the lock says that a build has made the folder, who it is and where the build
// is. A folder without that mark is not touched, nor is anything in a marked one that no build makes.
#pragma once

#include <memory>
#include <string>

#include "base/file_system.h"
#include "isoatlas/build.h"
#include "store/container.h"

namespace isoatlas {

class BuildFolder {
public:
    /// Makes the folder, or takes over an empty one or that of an earlier build. Throws Error{resource}: another process builds, the folder
    /// cannot be made, what is there is no folder, is a link, belongs to another user or was not made by a build; the store could not be
    /// written (base/output_target.h). Links to the store are followed: it has one folder, whatever it is called.
    BuildFolder(const std::string& store_path, bool restart);
    /// Takes the folder away when no phase is in it.
    ~BuildFolder();
    BuildFolder(const BuildFolder&) = delete;
    BuildFolder& operator=(const BuildFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string file(const std::string& phase) const { return path_ + "/" + phase; }
    /// A finished phase with the fingerprint of these contents; null: there is none. Others, and damaged ones, are removed; then why_not
    /// says what is wrong with it.
    [[nodiscard]] std::unique_ptr<Container> finished(const std::string& phase, const Contents& wanted, std::string& why_not) const;
    /// Says where the build is, for other processes: about once a second, whenever it is called. A disk that refuses is no failure.
    void say(const BuildState& state);
    /// The store is there: removes what the build has made, and the folder when nothing else is in it. Returns whether it is gone.
    bool remove();

private:
    void lock(const std::string& store_path);
    void mark();

    std::string path_;
    std::unique_ptr<File> lock_;
    std::chrono::steady_clock::time_point said_ = std::chrono::steady_clock::now();
};

}  // namespace isoatlas

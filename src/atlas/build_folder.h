// PATH.build: where the finished phases of a build lie until the store is there.
//
// A phase is a file of arrays with checksums (store/container.h), present as a whole or not at all; it tells the volume and the parameters
// it belongs to. While somebody builds, the folder is locked; the lock says who it is and where the build is.
#pragma once

#include <memory>
#include <string>

#include "base/file_system.h"
#include "isoatlas/build.h"
#include "store/container.h"

namespace isoatlas {

class BuildFolder {
public:
    /// Makes the folder or takes over what is there. Throws Error{resource}: another process builds, the folder cannot be made.
    BuildFolder(const std::string& store_path, bool restart);
    /// Takes the folder away when no phase is in it.
    ~BuildFolder();
    BuildFolder(const BuildFolder&) = delete;
    BuildFolder& operator=(const BuildFolder&) = delete;

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::string file(const std::string& phase) const { return path_ + "/" + phase; }
    /// A finished phase of this volume and these parameters; null: there is none. Others, and damaged ones, are removed.
    [[nodiscard]] std::unique_ptr<store::Container> finished(const std::string& phase, const store::Contents& wanted) const;
    /// Says where the build is, for other processes: about once a second, whenever it is called. A disk that refuses is no failure.
    void say(const BuildState& state);
    /// The store is there: removes everything. Returns whether the folder is gone.
    bool remove();

private:
    std::string path_;
    std::unique_ptr<File> lock_;
    std::chrono::steady_clock::time_point said_ = std::chrono::steady_clock::now();
};

}  // namespace isoatlas

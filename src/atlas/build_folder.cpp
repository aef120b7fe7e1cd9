#include "atlas/build_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

namespace fs = std::filesystem;
constexpr const char* kLock = "lock";

[[noreturn]] void cannot_make(const std::string& path, const std::string& why) {
    throw Error(ErrorKind::resource, {.file = path,
                                      .what = "the folder for the build cannot be made: " + why,
                                      .next = "choose another folder with -o, or remove what is in the way"});
}

void remove_contents(const std::string& path) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, ignored)) {
        if (entry.path().filename() != kLock) fs::remove_all(entry.path(), ignored);
    }
}

/// Does a phase belong to the same samples, and are its arrays what this version would make?
bool belongs(const store::Contents& found, const store::Contents& wanted) {
    return found.version == wanted.version && found.volume.extent == wanted.volume.extent && found.volume.type == wanted.volume.type &&
           found.parameters.interpolant == wanted.parameters.interpolant &&
           found.parameters.tunnel_height == wanted.parameters.tunnel_height &&
           found.parameters.samples_checksum == wanted.parameters.samples_checksum;
}

}  // namespace

BuildFolder::BuildFolder(const std::string& store_path, bool restart) : path_(store_path + ".build") {
    std::error_code error;
    fs::create_directory(path_, error);
    if (error) cannot_make(path_, error.message());
    const std::string lock = file(kLock);
    lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) cannot_make(path_, std::strerror(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        std::string who;
        std::ifstream(lock) >> who;
        ::close(lock_);
        throw Error(ErrorKind::resource, {.file = store_path,
                                          .what = "is being built by another process" + (who.empty() ? "" : ", " + who),
                                          .next = "wait until it is done, or build to another file with -o"});
    }
    const std::string own = std::to_string(::getpid()) + "\n";
    if (::ftruncate(lock_, 0) != 0 || ::pwrite(lock_, own.data(), own.size(), 0) < 0) errno = 0;  // only for the message above
    if (restart) remove_contents(path_);
}

BuildFolder::~BuildFolder() {
    std::error_code ignored;
    const auto entries = std::distance(fs::directory_iterator(path_, ignored), fs::directory_iterator());
    if (entries == 1) fs::remove_all(path_, ignored);  // the lock alone: nothing was finished
    ::close(lock_);
}

std::unique_ptr<store::Container> BuildFolder::finished(const std::string& phase, const store::Contents& wanted) const {
    std::error_code ignored;
    if (!fs::exists(file(phase), ignored)) return nullptr;
    try {
        auto container = std::make_unique<store::Container>(file(phase));
        if (belongs(container->contents(), wanted)) {
            container->check_all();
            return container;
        }
    } catch (const Error&) {  // damaged: it is made again
    }
    fs::remove(file(phase), ignored);
    return nullptr;
}

void BuildFolder::remove() {
    remove_contents(path_);
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace isoatlas

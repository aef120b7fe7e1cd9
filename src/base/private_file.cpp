#include "base/private_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "base/own_files.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

[[noreturn]] void refuse_private(const std::string& path, const std::string& what) {
    throw Error(ErrorKind::resource, {.where = path, .what = what, .next = "set XDG_RUNTIME_DIR to a folder of yours"});
}

/// The folder for files shared by programs of this user; empty: none.
std::string user_folder() {
    for (const char* variable : {"XDG_RUNTIME_DIR", "XDG_CACHE_HOME"}) {
        if (const std::string folder = folder_in(variable); !folder.empty()) return folder;
    }
    const std::string home = folder_in("HOME");
    return home.empty() ? home : home + "/.cache";
}

std::string path_of(const std::string& name) {
    const std::string folder = user_folder();
    return folder.empty() ? folder : folder + "/isoatlas/" + name;
}

/// Ensures a folder of this user that no other user may enter.
void make_own_folder(const std::string& path) {
    struct stat status{};
    if (::mkdir(path.c_str(), kOwnFolder) != 0 && errno != EEXIST)
        refuse_private(path, std::string("cannot be created: ") + std::strerror(errno));
    if (::lstat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) refuse_private(path, "is not a folder");
    if (status.st_uid != ::geteuid()) refuse_private(path, "belongs to another user");
    if ((status.st_mode & kOthers) != 0 && ::chmod(path.c_str(), kOwnFolder) != 0) refuse_private(path, "is open to other users");
}

}  // namespace

PrivateFile::PrivateFile(const std::string& name, const std::string& text) : path_(path_of(name)) {
    if (path_.empty()) refuse_private(name, "has no folder: none of XDG_RUNTIME_DIR, XDG_CACHE_HOME and HOME is set");
    (void)::mkdir(user_folder().c_str(), kOwnFolder);  // ~/.cache of a new user
    make_own_folder(path_.substr(0, path_.rfind('/')));
    const std::string made = path_ + "." + std::to_string(::getpid());
    (void)::unlink(made.c_str());
    const int file = ::open(made.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnFile);
    if (file < 0) refuse_private(made, std::string("cannot be created: ") + std::strerror(errno));
    struct stat status{};
    const bool good = write_all(file, text) && ::fstat(file, &status) == 0;
    if (::close(file) != 0 || !good || ::rename(made.c_str(), path_.c_str()) != 0) {
        const std::string reason = std::strerror(errno);
        (void)::unlink(made.c_str());
        refuse_private(path_, "cannot be written: " + reason);
    }
    device_ = status.st_dev;
    inode_ = status.st_ino;
}

PrivateFile::~PrivateFile() {
    struct stat status{};
    const bool ours = ::lstat(path_.c_str(), &status) == 0 && status.st_dev == device_ && status.st_ino == inode_;
    if (ours) (void)::unlink(path_.c_str());
}

std::string private_text(const std::string& name) {
    const std::string path = path_of(name);
    const int file = path.empty() ? -1 : ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return {};
    std::string text;
    struct stat status{};
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == ::geteuid() && (status.st_mode & kOthers) == 0) {
        std::array<char, 4096> bytes;
        const ssize_t count = ::read(file, bytes.data(), bytes.size());
        if (count > 0) text.assign(bytes.data(), static_cast<std::size_t>(count));
    }
    (void)::close(file);
    return text;
}

}  // namespace isoatlas

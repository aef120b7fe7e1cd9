#include "base/kept_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/own_files.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr std::size_t kMost = 16384;  ///< bytes of a file

[[noreturn]] void refuse_kept(const std::string& path, const std::string& what) {
    throw Error(ErrorKind::resource, {.where = path, .what = what, .next = "set XDG_STATE_HOME to a folder of yours"});
}

std::string reason() { return std::strerror(errno); }

/// The folder for states of this user, which its parents are made for; empty: none.
std::string state_folder() {
    if (std::string folder = folder_in("XDG_STATE_HOME"); !folder.empty()) {
        (void)::mkdir(folder.c_str(), kOwnFolder);
        return folder;
    }
    std::string folder = folder_in("HOME");
    if (folder.empty()) return folder;
    for (const char* part : {"/.local", "/state"}) (void)::mkdir((folder += part).c_str(), kOwnFolder);
    return folder;
}

/// Why an open file must not be used; empty: it may.
std::string refusal_of(const struct stat& status) {
    if (!S_ISREG(status.st_mode)) return "is not a file";
    if (status.st_uid != ::geteuid()) return "belongs to another user";
    return (status.st_mode & kOthers) != 0 ? "is open to other users" : "";
}

}  // namespace

KeptFolder::KeptFolder() : path_(state_folder()) {
    if (path_.empty()) refuse_kept("the folder for links", "is unknown: neither XDG_STATE_HOME nor HOME is set");
    path_ += "/isoatlas";
    if (::mkdir(path_.c_str(), kOwnFolder) != 0 && errno != EEXIST) refuse_kept(path_, "cannot be created: " + reason());
    folder_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder_ < 0) refuse_kept(path_, errno == ENOTDIR || errno == ELOOP ? "is not a folder" : "cannot be opened: " + reason());
    struct stat status{};
    std::string what;
    if (::fstat(folder_, &status) != 0 || status.st_uid != ::geteuid())
        what = "belongs to another user";
    else if ((status.st_mode & kOthers) != 0 && ::fchmod(folder_, kOwnFolder) != 0)
        what = "is open to other users";
    if (what.empty()) return;
    (void)::close(folder_);
    refuse_kept(path_, what);
}

KeptFolder::~KeptFolder() { (void)::close(folder_); }

KeptFolder::Content KeptFolder::read(const std::string& name) const {
    const int file = ::openat(folder_, name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        if (errno == ENOENT) return {};
        return {.refusal = errno == ELOOP ? "is a symbolic link" : "cannot be read: " + reason()};
    }
    Content content;
    struct stat status{};
    content.refusal = ::fstat(file, &status) == 0 ? refusal_of(status) : "cannot be read: " + reason();
    if (content.refusal.empty()) {
        content.text.resize(kMost);
        const ssize_t count = ::read(file, content.text.data(), kMost);
        content.text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
        if (content.text.empty()) content.refusal = "is empty";
    }
    (void)::close(file);
    return content;
}

void KeptFolder::write(const std::string& name, const std::string& text) const {
    const std::string made = name + "." + std::to_string(::getpid());
    (void)::unlinkat(folder_, made.c_str(), 0);
    const int file = ::openat(folder_, made.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kOwnFile);
    if (file < 0) refuse_kept(path_of(name), "cannot be created: " + reason());
    const bool good = write_all(file, text);
    if (::close(file) == 0 && good && ::renameat(folder_, made.c_str(), folder_, name.c_str()) == 0) return;
    const std::string why = reason();
    (void)::unlinkat(folder_, made.c_str(), 0);
    refuse_kept(path_of(name), "cannot be written: " + why);
}

}  // namespace isoatlas

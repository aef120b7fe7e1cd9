// PrivateFile: a small secret shared by programs of one user, in a file that no other user can read.
#pragma once

#include <string>

#include <sys/types.h>

namespace isoatlas {

/// A file of this user in $XDG_RUNTIME_DIR/isoatlas, else $XDG_CACHE_HOME/isoatlas or ~/.cache/isoatlas. It appears whole, replaces one
/// that was left behind, and is removed when this ends.
class PrivateFile {
public:
    /// name: of the file in that folder. Throws Error{resource}: there is no such folder, it is another user's, it cannot be written.
    PrivateFile(const std::string& name, const std::string& text);
    PrivateFile(const PrivateFile&) = delete;
    PrivateFile& operator=(const PrivateFile&) = delete;
    ~PrivateFile();

    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
    dev_t device_ = 0;
    ino_t inode_ = 0;
};

/// Empty: there is no such file, or it is not this user's alone. At most 4096 bytes are read.
[[nodiscard]] std::string private_text(const std::string& name);

}  // namespace isoatlas

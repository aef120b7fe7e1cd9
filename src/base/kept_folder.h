// KeptFolder: small secrets of a user that outlive the programs that use them.
#pragma once

#include <string>

namespace isoatlas {

/// $XDG_STATE_HOME/isoatlas, else ~/.local/state/isoatlas: a folder of this user that no other user may enter, created where it is missing.
/// Nothing in it is read or written through a symbolic link.
class KeptFolder {
public:
    /// Throws Error{resource}: there is no such folder, it is another user's, it cannot be created.
    KeptFolder();
    KeptFolder(const KeptFolder&) = delete;
    KeptFolder& operator=(const KeptFolder&) = delete;
    ~KeptFolder();

    struct Content {
        std::string text{};     ///< empty: there is no such file, or it is refused
        std::string refusal{};  ///< why a file that is there must not be used: "can be read by other users"; empty: it may
    };
    /// At most 16 KiB.
    [[nodiscard]] Content read(const std::string& name) const;
    /// Replaces the file, which then only this user can read; it appears whole. Throws Error{resource}.
    void write(const std::string& name, const std::string& text) const;
    [[nodiscard]] std::string path_of(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
    int folder_ = -1;
};

}  // namespace isoatlas

// TemporaryFolder: a folder in TMPDIR that is removed with all that is in it.
#pragma once

#include <string>

namespace isoatlas::cli {

class TemporaryFolder {
public:
    /// Throws Error{resource}: TMPDIR cannot take it.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// TMPDIR, or a file that is kept there, fails. error: errno.
[[noreturn]] void temporary_file_failed(const char* file, int error);

}  // namespace isoatlas::cli

#include "server/mesh_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "base/file_system.h"
#include "io/file_access.h"
#include "isoatlas/error.h"

namespace isoatlas::server {
namespace {

/// A new folder that goes with its owner.
class TemporaryFolder {
public:
    TemporaryFolder() {
        const std::string base = (std::filesystem::temp_directory_path() / ("isoatlas-view-" + std::to_string(::getpid()) + "-")).string();
        int error = -EEXIST;
        for (int i = 0; error == -EEXIST; ++i) error = file_system().make_folder(path_ = base + std::to_string(i));
        if (error != 0)
            throw Error(ErrorKind::resource, {.file = path_, .what = "the folder cannot be made", .next = "set TMPDIR to another one"});
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        for (const std::string& name : file_system().entries(path_, 16)) (void)file_system().remove(path_ + "/" + name);
        (void)file_system().remove_folder(path_);
    }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::string path_;
};

}  // namespace

std::string mesh_file(const Surface& surface, const std::string& extension) {
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/surface" + extension;
    (void)write_surface(path, surface);
    const std::unique_ptr<File> file = io::open_file(path);
    std::string bytes(static_cast<std::size_t>(file->size()), '\0');
    io::read_fully(*file, path, 0, std::as_writable_bytes(std::span(bytes.data(), bytes.size())));
    return bytes;
}

}  // namespace isoatlas::server

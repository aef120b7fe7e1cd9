// use_remote_files: the operating system's files, and those of other machines by their addresses.
#include <cerrno>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>

#include "isoatlas/error.h"
#include "isoatlas/remote.h"
#include "remote/remote_file.h"

namespace isoatlas {
namespace {

/// Keys of which a Zarr array or group has at least one.
constexpr const char* kZarrKeys[] = {"/zarr.json", "/.zattrs", "/.zarray", "/.zgroup"};

class RemoteFiles final : public FileSystem {
public:
    void set(const RemoteOptions& options) {
        auto shared = std::make_shared<RemoteShared>(options);
        const std::scoped_lock lock(mutex_);
        if (shared_) shared_->recent.forget();  // its files hold it
        shared_ = std::move(shared);
        kinds_.clear();
    }
    [[nodiscard]] std::shared_ptr<RemoteShared> shared() const {
        const std::scoped_lock lock(mutex_);
        return shared_;
    }

    // A server has no folders. What looks like a Zarr array or group is one; everything else is a file, whose absence is seen when it is
    // opened. A server that does not answer is asked again by open(), which says why.
    FileStatus status(const std::string& path) override {
        if (!is_address(path)) return system_files().status(path);
        {
            const std::scoped_lock lock(mutex_);
            if (const auto found = kinds_.find(path); found != kinds_.end())
                return {.kind = found->second, .own = false, .writable = false};
        }
        const FileStatus::Kind kind = is_zarr(path) ? FileStatus::Kind::folder : FileStatus::Kind::regular;
        const std::scoped_lock lock(mutex_);
        kinds_[path] = kind;
        return {.kind = kind, .own = false, .writable = false};
    }
    FileStatus status_of_name(const std::string& path) override {
        return is_address(path) ? status(path) : system_files().status_of_name(path);
    }
    OpenedFile open(const std::string& path) override {
        if (!is_address(path)) return system_files().open(path);
        std::unique_ptr<File> file = open_remote_file(shared(), path);
        const int error = file == nullptr ? -ENOENT : 0;
        return {std::move(file), error};
    }
    std::string link(const std::string& path) override { return is_address(path) ? std::string() : system_files().link(path); }
    std::string resolved(const std::string& path) override { return is_address(path) ? path : system_files().resolved(path); }
    OpenedFile open_stream(const std::string& path) override { return system_files().open_stream(path); }
    OpenedFile create(const std::string& path, unsigned mode) override {
        return is_address(path) ? OpenedFile{nullptr, -EROFS} : system_files().create(path, mode);
    }
    OpenedFile create_unnamed(const std::string& folder, unsigned mode) override {
        return is_address(folder) ? OpenedFile{nullptr, -EROFS} : system_files().create_unnamed(folder, mode);
    }
    OpenedFile lock(const std::string& path) override { return is_address(path) ? OpenedFile{nullptr, -EROFS} : system_files().lock(path); }
    bool is_held(const std::string& path) override { return !is_address(path) && system_files().is_held(path); }
    void remove_abandoned(const std::string& path) override {
        if (!is_address(path)) system_files().remove_abandoned(path);
    }
    int rename(const std::string& from, const std::string& to) override {
        return is_address(from) || is_address(to) ? -EROFS : system_files().rename(from, to);
    }
    int remove(const std::string& path) override { return is_address(path) ? -EROFS : system_files().remove(path); }
    int make_folder(const std::string& path) override { return is_address(path) ? -EROFS : system_files().make_folder(path); }
    int remove_folder(const std::string& path) override { return is_address(path) ? -EROFS : system_files().remove_folder(path); }
    std::vector<std::string> entries(const std::string& path, std::size_t max) override {
        return is_address(path) ? std::vector<std::string>() : system_files().entries(path, max);
    }
    int sync_folder(const std::string& path) override { return is_address(path) ? -EROFS : system_files().sync_folder(path); }

private:
    bool is_zarr(std::string path) const {
        while (path.ends_with('/')) path.pop_back();
        const std::size_t query = path.find('?');
        const bool may_be = path.find(".zarr") != std::string::npos || path.find('.', path.rfind('/')) == std::string::npos;
        if (query != std::string::npos || !may_be) return false;
        const std::shared_ptr<RemoteShared> now = shared();
        for (const char* key : kZarrKeys) {
            if (exists_remotely(*now, path + key)) return true;
        }
        return false;
    }

    mutable std::mutex mutex_;
    std::shared_ptr<RemoteShared> shared_;
    std::map<std::string, FileStatus::Kind> kinds_;
};

RemoteFiles& remote_files() {
    static auto* const files = new RemoteFiles;  // as long as the process: files may outlive main()
    return *files;
}

std::string variable(const char* name) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
    return value == nullptr ? "" : value;
}

}  // namespace

std::string remote_cache_folder(const RemoteOptions& options) {
    if (options.disk_cache <= 0) return "";
    if (!options.cache_folder.empty()) return options.cache_folder;
    const std::string cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
    if (!cache.empty()) return cache + "/isoatlas/remote";
    return home.empty() ? "" : home + "/.cache/isoatlas/remote";
}

void use_remote_files(const RemoteOptions& options) {
    RemoteOptions completed = options;
    if (completed.certificates.empty()) completed.certificates = variable("SSL_CERT_FILE");
    remote_files().set(completed);
    set_default_files(&remote_files());
}

RemoteTraffic remote_traffic() {
    const std::shared_ptr<RemoteShared> shared = remote_files().shared();
    if (!shared) return {};
    RemoteTraffic traffic = shared->client.traffic();
    traffic.from_disk = shared->from_disk;
    return traffic;
}

}  // namespace isoatlas

// A Zarr hierarchy in a folder: every key is a file.
#include <algorithm>
#include <cerrno>
#include <utility>

#include "formats/common/file_access.h"
#include "formats/common/natural_order.h"
#include "formats/common/own_folder.h"
#include "formats/zarr/key_store.h"
#include "formats/zarr/zarr_error.h"

namespace isoatlas {
namespace {

class FolderStore final : public KeyStore {
public:
    FolderStore(const std::string& folder, bool follow_links) : KeyStore(folder), follow_links_(follow_links) {}

    std::optional<std::vector<std::byte>> read(const std::string& key, std::int64_t most) override {
        if (!find(key)) return std::nullopt;
        const std::int64_t bytes = file_->size();
        if (bytes > most)
            bad_zarr(*this, key, "the file has " + std::to_string(bytes) + " bytes", "at most " + std::to_string(most) + " bytes");
        std::vector<std::byte> value(static_cast<std::size_t>(bytes));
        read_fully(*file_, path_, 0, value);
        return value;
    }

    std::optional<std::int64_t> size(const std::string& key) override {
        if (!find(key)) return std::nullopt;
        return file_->size();
    }

    void read_range(const std::string& key, std::int64_t offset, std::span<std::byte> out) override {
        if (!find(key)) bad_zarr(*this, key, "the file is gone", "the file that was there when it was opened");
        if (offset < 0 || offset > file_->size() || static_cast<std::int64_t>(out.size()) > file_->size() - offset)
            bad_zarr(*this, key, "the file has " + std::to_string(file_->size()) + " bytes",
                     std::to_string(out.size()) + " bytes at offset " + std::to_string(offset));
        read_fully(*file_, path_, offset, out);
    }

    std::optional<std::vector<std::string>> list(const std::string& folder, std::size_t most) override {
        if (is_remote()) return std::nullopt;
        if (!folder.empty()) require_sound_key(*this, folder);
        std::vector<std::string> names = directory_entries(path_of(folder), most);
        std::ranges::sort(names, natural_less);
        return names;
    }

    bool is_remote() const override { return is_address(name()); }

private:
    std::string path_of(const std::string& key) const { return key.empty() ? name() : name() + "/" + key; }

    /// Opens the file of a key, unless it is the one that is open. False: there is none.
    bool find(const std::string& key) {
        require_sound_key(*this, key);
        if (file_ && key == key_) return true;
        file_.reset();
        const std::string path = path_of(key);
        if (!(is_remote() ? open_on_server(path) : open_in_folder(path))) return false;
        key_ = key, path_ = path;
        return true;
    }

    bool open_in_folder(const std::string& path) {
        const FileStatus status = file_system().status(path);
        const bool is_absent =
            status.kind == FileStatus::Kind::missing && (status.error == 0 || status.error == -ENOENT || status.error == -ENOTDIR);
        if (is_absent || status.kind == FileStatus::Kind::folder) return false;
        if (!follow_links_) require_inside(name(), path, "a part of the Zarr hierarchy is a link to a file");
        file_ = open_file(path);
        return true;
    }

    /// Without the status that open_file() asks for: on a server that is more requests. What is not "no such file" throws, or a chunk that
    /// a broken connection hides would be one that was never written.
    bool open_on_server(const std::string& path) {
        OpenedFile opened = file_system().open(path);
        if (!opened.file && opened.error != -ENOENT)
            bad_zarr(*this, path, "cannot be opened", "a file", "check the connection, and try again");
        file_ = std::move(opened.file);
        return file_ != nullptr;
    }

    bool follow_links_;
    std::unique_ptr<File> file_;  ///< the one that was read last: a shard is read in many pieces
    std::string key_, path_;      ///< of it
};

}  // namespace

std::unique_ptr<KeyStore> open_folder_store(const std::string& folder, bool follow_links) {
    return std::make_unique<FolderStore>(folder, follow_links);
}

}  // namespace isoatlas

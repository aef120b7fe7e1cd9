// A Zarr hierarchy in a zip archive: every key is an entry.
#include <zlib.h>

#include <algorithm>
#include <string_view>

#include "formats/common/file_access.h"
#include "formats/common/natural_order.h"
#include "formats/zarr/codecs.h"
#include "formats/zarr/key_store.h"
#include "formats/zarr/zarr_error.h"
#include "formats/zarr/zip_directory.h"

namespace isoatlas {
namespace {

class ZipStore final : public KeyStore {
public:
    explicit ZipStore(const std::string& path) : KeyStore(path), file_(open_file(path)), entries_(read_zip_directory(*file_, path)) {
        root_ = common_folder();
    }

    std::optional<std::vector<std::byte>> read(const std::string& key, std::int64_t most) override {
        const ZipEntry* entry = find(key);
        if (entry == nullptr) return std::nullopt;
        if (entry->bytes > most)
            bad_zarr(*this, key, "the entry has " + std::to_string(entry->bytes) + " bytes", "at most " + std::to_string(most) + " bytes");
        return value_of(key, *entry);
    }

    std::optional<std::int64_t> size(const std::string& key) override {
        const ZipEntry* entry = find(key);
        return entry == nullptr ? std::nullopt : std::optional(entry->bytes);
    }

    void read_range(const std::string& key, std::int64_t offset, std::span<std::byte> out) override {
        const ZipEntry* entry = find(key);
        if (entry == nullptr || offset < 0 || offset > entry->bytes || static_cast<std::int64_t>(out.size()) > entry->bytes - offset)
            bad_zarr(*this, key, "the entry is missing or too short",
                     std::to_string(out.size()) + " bytes at offset " + std::to_string(offset));
        if (entry->method == kZipStored && !entry->is_encrypted)
            return read_fully(*file_, name(), zip_data_offset(*file_, name(), *entry) + offset, out);
        if (whole_key_ != key) {
            whole_ = value_of(key, *entry);
            whole_key_ = key;
        }
        std::copy_n(whole_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
    }

    std::optional<std::vector<std::string>> list(const std::string& folder, std::size_t most) override {
        if (!folder.empty()) require_sound_key(*this, folder);
        const std::string prefix = root_ + (folder.empty() ? "" : folder + "/");
        std::vector<std::string> names;
        auto entry = std::ranges::lower_bound(entries_, prefix, {}, &ZipEntry::name);
        while (entry != entries_.end() && entry->name.starts_with(prefix) && names.size() < most) {
            const std::size_t end = entry->name.find('/', prefix.size());
            names.push_back(entry->name.substr(prefix.size(), end - prefix.size()));
            if (end == std::string::npos) {
                ++entry;
            } else {  // behind everything in that folder
                entry = std::ranges::lower_bound(entries_, entry->name.substr(0, end) + char('/' + 1), {}, &ZipEntry::name);
            }
        }
        std::ranges::sort(names, natural_less);
        names.erase(std::unique(names.begin(), names.end()), names.end());
        return names;
    }

    std::optional<std::int64_t> bytes() override { return file_->size(); }

private:
    /// "image.zarr/" where every entry lies in it.
    std::string common_folder() const {
        if (entries_.empty()) return "";
        const std::string& first = entries_.front().name;
        const std::string folder = first.substr(0, first.find('/') + 1);
        return !folder.empty() && entries_.back().name.starts_with(folder) && first.find('/') != std::string::npos ? folder : "";
    }

    const ZipEntry* find(const std::string& key) const {
        require_sound_key(*this, key);
        const auto entry = std::ranges::lower_bound(entries_, root_ + key, {}, &ZipEntry::name);
        return entry == entries_.end() || entry->name != root_ + key ? nullptr : &*entry;
    }

    std::vector<std::byte> value_of(const std::string& key, const ZipEntry& entry) {
        if (entry.is_encrypted)
            unsupported_zarr(*this, key, "the entry of the archive is encrypted", "entries without a password", "write it without one");
        if (entry.method != kZipStored && entry.method != kZipDeflated)
            unsupported_zarr(*this, key, "the entry of the archive is compressed by method " + std::to_string(entry.method),
                             "stored or deflated entries", "zip the folder again without compression");
        std::vector<std::byte> packed(static_cast<std::size_t>(entry.packed)), value;
        read_fully(*file_, name(), zip_data_offset(*file_, name(), entry), packed);
        if (entry.method == kZipStored) {
            value = std::move(packed);
        } else if (const std::string error = inflate_raw(packed, static_cast<std::size_t>(entry.bytes), value); !error.empty()) {
            bad_zarr(*this, key, "the entry of the archive is damaged: " + error, "a deflate stream");
        }
        const auto crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(value.data()), value.size());
        if (static_cast<std::int64_t>(value.size()) != entry.bytes || crc != entry.crc)
            bad_zarr(*this, key, "the checksum of the entry is wrong", "the bytes that were put into the archive");
        return value;
    }

    std::unique_ptr<File> file_;
    std::vector<ZipEntry> entries_;  ///< by name
    std::string root_;               ///< "", or a folder with its slash
    std::string whole_key_;          ///< of a deflated entry that is read in pieces
    std::vector<std::byte> whole_;
};

}  // namespace

std::unique_ptr<KeyStore> open_zip_store(const std::string& path) { return std::make_unique<ZipStore>(path); }

}  // namespace isoatlas

// KeyStore: the keys and values of a Zarr hierarchy, wherever they lie: in a folder, in a zip archive, behind an address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isoatlas {

/// Keys are names joined by "/", relative to the root of the store: "0/.zarray", "0/c/1/2/3". Implementations refuse keys that
/// is_sound_key() does not hold for. What throws, throws Error{input} that names the store and the key. Not thread safe.
class KeyStore {
public:
    explicit KeyStore(std::string name) : name_(std::move(name)) {}
    KeyStore(const KeyStore&) = delete;
    KeyStore& operator=(const KeyStore&) = delete;
    virtual ~KeyStore() = default;

    /// The value; nullopt: there is none. Throws where it has more than `most` bytes, before it takes memory for them.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>> read(const std::string& key, std::int64_t most) = 0;
    /// Bytes of the value; nullopt: there is none.
    [[nodiscard]] virtual std::optional<std::int64_t> size(const std::string& key) = 0;
    /// Fills out with the bytes of a value from `offset` on. Throws where it has no such bytes.
    virtual void read_range(const std::string& key, std::int64_t offset, std::span<std::byte> out) = 0;
    /// Names directly below a folder of keys ("": the root), at most `most`, in natural order; nullopt: this store cannot list.
    [[nodiscard]] virtual std::optional<std::vector<std::string>> list(const std::string& folder, std::size_t most) = 0;
    /// Bytes of the whole store, where they are known without asking for every value.
    [[nodiscard]] virtual std::optional<std::int64_t> bytes() { return std::nullopt; }
    /// Every question about a key is a request to a server.
    [[nodiscard]] virtual bool is_remote() const { return false; }
    /// For messages.
    [[nodiscard]] const std::string& name() const { return name_; }

private:
    std::string name_;
};

/// Not empty, of names that are neither empty nor "." nor "..", without zero bytes, at most 4,096 bytes: it leads out of no folder.
[[nodiscard]] bool is_sound_key(const std::string& key);
/// Throws Error{input} where it is not.
void require_sound_key(const KeyStore& store, const std::string& key);
/// "a/b", or "b" below the root.
[[nodiscard]] std::string join_key(const std::string& folder, const std::string& name);

/// A folder of files, or an address that keys are appended to. Links that lead out of a folder are refused, unless follow_links. The folder
/// need not exist. A server is not listed; a key costs one request, whether it is there or not.
[[nodiscard]] std::unique_ptr<KeyStore> open_folder_store(const std::string& folder, bool follow_links);
/// The entries of a zip archive (zip64, too), stored or deflated; nothing is unpacked to the disk. Where all of them lie in one folder,
/// that is the root. Throws Error: input (damaged), as open_file(). Memory: the list of entries.
[[nodiscard]] std::unique_ptr<KeyStore> open_zip_store(const std::string& path);

}  // namespace isoatlas

// The Zarr reader takes any bytes: a documented error or a sound volume. The input is a zip archive, or keys and values in text: lines
// "key length" and, behind each, so many bytes.
#include <charconv>
#include <map>
#include <string_view>

#include "formats/volume/formats.h"
#include "formats/volume/zarr.h"
#include "formats/zarr/zarr_error.h"
#include "fuzz/volume_target.h"

namespace {

class FuzzStore final : public isoatlas::KeyStore {
public:
    explicit FuzzStore(std::string_view text) : KeyStore("fuzz") {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find('\n'), text.size()), blank = std::min(text.find(' '), end);
            std::size_t length = 0;
            if (blank < end) std::from_chars(text.data() + blank + 1, text.data() + end, length);
            const std::string key(text.substr(0, blank));
            text.remove_prefix(std::min(end + 1, text.size()));
            length = std::min(length, text.size());
            values_[key] = text.substr(0, length);
            text.remove_prefix(length);
        }
    }
    std::optional<std::vector<std::byte>> read(const std::string& key, std::int64_t most) override {
        const std::string_view* value = find(key);
        if (value == nullptr) return std::nullopt;
        if (static_cast<std::int64_t>(value->size()) > most) isoatlas::bad_zarr(*this, key, "too long", "less");
        const std::span<const std::byte> bytes = std::as_bytes(std::span(*value));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    }
    std::optional<std::int64_t> size(const std::string& key) override {
        const std::string_view* value = find(key);
        return value == nullptr ? std::nullopt : std::optional(static_cast<std::int64_t>(value->size()));
    }
    void read_range(const std::string& key, std::int64_t offset, std::span<std::byte> out) override {
        const std::string_view* value = find(key);
        fuzz::require_volume(value != nullptr && offset >= 0 && offset <= std::ssize(*value) &&
                             std::ssize(out) <= std::ssize(*value) - offset);
        if (!out.empty()) std::memcpy(out.data(), value->data() + offset, out.size());
    }
    std::optional<std::vector<std::string>> list(const std::string& folder, std::size_t most) override {
        if (values_.contains("cannot list")) return std::nullopt;
        std::vector<std::string> names;
        const std::string prefix = folder.empty() ? "" : folder + "/";
        for (const auto& [key, value] : values_) {
            if (!key.starts_with(prefix) || names.size() >= most) continue;
            std::string name = key.substr(prefix.size(), key.find('/', prefix.size()) - prefix.size());
            if (names.empty() || names.back() != name) names.push_back(std::move(name));
        }
        return names;
    }

private:
    const std::string_view* find(const std::string& key) const {
        isoatlas::require_sound_key(*this, key);
        const auto found = values_.find(key);
        return found == values_.end() ? nullptr : &found->second;
    }
    std::map<std::string, std::string_view> values_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (text.starts_with("PK")) return fuzz::open_and_read(isoatlas::open_zarr_zip, data, size);
    const auto open = [&](const std::string& path, isoatlas::OpenOptions options) {
        if (options.time_step) options.channel = "0", options.level = 1;
        return isoatlas::open_zarr_store(std::make_shared<FuzzStore>(text), path, "", options);
    };
    return fuzz::open_and_read(open, data, size);
}

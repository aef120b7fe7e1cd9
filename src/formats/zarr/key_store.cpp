#include "formats/zarr/key_store.h"

#include <string_view>

#include "formats/zarr/zarr_error.h"

namespace isoatlas {

bool is_sound_key(const std::string& key) {
    constexpr std::size_t kLongestKey = 4096;
    if (key.size() > kLongestKey || key.find('\0') != std::string::npos) return false;
    for (std::size_t begin = 0; begin <= key.size();) {
        const std::size_t end = std::min(key.find('/', begin), key.size());
        const std::string_view name = std::string_view(key).substr(begin, end - begin);
        if (name.empty() || name == "." || name == "..") return false;
        begin = end + 1;
    }
    return true;
}

void require_sound_key(const KeyStore& store, const std::string& key) {
    if (is_sound_key(key)) return;
    bad_zarr(store, key, "the path leads out of the Zarr hierarchy, or is empty", "names joined by \"/\", without \"..\"");
}

std::string join_key(const std::string& folder, const std::string& name) { return folder.empty() ? name : folder + "/" + name; }

}  // namespace isoatlas

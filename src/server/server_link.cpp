// Links that outlive a server: its port follows from the path of the store, its secrets lie in a file of the user.
#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>

#include "base/kept_folder.h"
#include "codec/checksum.h"
#include "isoatlas/error.h"
#include "isoatlas/server.h"
#include "server/secret.h"

namespace isoatlas {
namespace {

constexpr int kFirstPort = 49152, kPorts = 16384;  ///< those that IANA assigns to no service
constexpr std::string_view kHead = "isoatlas link 1\n";
constexpr std::size_t kSecret = 32;  ///< digits

std::string canonical(const std::string& store) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::weakly_canonical(store, error);  // it may not be built yet
    return error ? std::filesystem::absolute(store, error).string() : path.string();
}

std::string hexadecimal(std::uint64_t number) {
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[(number >> shift) & 15];
    return text;
}

std::string text_of(const ServerLink& link, const std::string& path) {
    return std::string(kHead) + link.token + "\n" + link.cookie + "\n" + link.key + "\n" + path + "\n";
}

bool is_digits(std::string_view text) {
    return text.size() == kSecret && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Sets the secrets of a file of this store. False: it is malformed.
bool read_secrets(std::string_view text, const std::string& path, ServerLink& link) {
    if (!text.starts_with(kHead)) return false;
    text.remove_prefix(kHead.size());
    for (std::string* secret : {&link.token, &link.cookie, &link.key}) {
        *secret = text.substr(0, kSecret);
        if (!is_digits(*secret) || text.size() == kSecret || text[kSecret] != '\n') return false;
        text.remove_prefix(kSecret + 1);
    }
    return text == path + "\n";
}

void make_secrets(ServerLink& link) {
    for (std::string* secret : {&link.token, &link.cookie, &link.key}) *secret = random_secret();
}

}  // namespace

ServerLink link_of_store(const std::string& store, bool is_new) {
    const std::string path = canonical(store);
    const std::uint64_t hash = checksum(std::as_bytes(std::span(path)));
    const std::string name = "link-" + hexadecimal(hash);
    ServerLink link{.port = kFirstPort + static_cast<int>(hash % kPorts)};
    try {
        const KeptFolder folder;
        KeptFolder::Content kept = folder.read(name);
        link.is_kept = true;
        if (!is_new && kept.refusal.empty() && !kept.text.empty()) {
            if (read_secrets(kept.text, path, link)) return link;
            kept.refusal = "is malformed";
        }
        make_secrets(link);
        folder.write(name, text_of(link, path));
        if (!is_new && !kept.refusal.empty())
            link.note = folder.path_of(name) + " " + kept.refusal + " and is replaced: earlier links to this store do not open any more";
    } catch (const Error& error) {
        make_secrets(link);
        link.is_kept = false;
        link.note = "links to this viewer end with it: " + std::string(error.what());
    }
    return link;
}

}  // namespace isoatlas

// Random secrets, and their comparison.
#pragma once

#include <sys/random.h>

#include <array>
#include <string>
#include <string_view>

#include "isoatlas/error.h"

namespace isoatlas {

/// 128 random bits as 32 hexadecimal digits. Throws Error{resource}.
[[nodiscard]] inline std::string random_secret() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw Error(ErrorKind::resource, {.what = "the system provides no random numbers"});
    std::string text;
    for (const unsigned char byte : bytes) {
        for (const int digit : {byte / 16, byte % 16}) text += "0123456789abcdef"[digit];
    }
    return text;
}

/// Constant time for texts of one length: the time reveals nothing about the secret. An empty text never matches.
[[nodiscard]] inline bool is_secret(std::string_view given, std::string_view secret) {
    if (given.size() != secret.size() || secret.empty()) return false;
    unsigned different = 0;
    for (std::size_t i = 0; i < secret.size(); ++i) different |= static_cast<unsigned char>(given[i] ^ secret[i]);
    return different == 0;
}

}  // namespace isoatlas

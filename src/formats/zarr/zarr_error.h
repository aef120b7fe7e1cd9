// Errors of Zarr hierarchies.
#pragma once

#include <string>

#include "formats/zarr/key_store.h"
#include "isoatlas/error.h"
#include "isoatlas/text.h"

namespace isoatlas {

/// A key is shown as it is in the store, or shortened where it is very long.
[[nodiscard]] inline std::string shown_key(const std::string& key) {
    constexpr std::size_t kMost = 120;
    const std::string shown = shown_name(key);
    return shown.size() <= kMost ? shown : std::string(utf8_prefix(shown, kMost)) + "...";
}

/// What no sound hierarchy has.
[[noreturn]] inline void bad_zarr(const KeyStore& store, const std::string& key, const std::string& what, const std::string& expected,
                                  const std::string& next = "the Zarr hierarchy is damaged or incomplete: copy it again") {
    throw Error(ErrorKind::input, {.file = store.name(), .where = shown_key(key), .what = what, .expected = expected, .next = next});
}

/// What Zarr allows and is not read.
[[noreturn]] inline void unsupported_zarr(const KeyStore& store, const std::string& key, const std::string& what,
                                          const std::string& expected,
                                          const std::string& next = "write the array again in another form, for example with zarr-python") {
    throw Error(ErrorKind::unsupported, {.file = store.name(), .where = shown_key(key), .what = what, .expected = expected, .next = next});
}

}  // namespace isoatlas

// The JSON documents of a Zarr hierarchy.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/zarr/key_store.h"

namespace isoatlas {

using Json = nlohmann::json;

/// The object that the value of a key is; nullopt: there is no such key. NaN and infinity, which Python writes, become null; of the
/// members of the object those named `without` are left out. Throws Error{input} for what is no object, larger than 8 MiB, or nested deeper
/// than 64.
[[nodiscard]] std::optional<Json> read_json(KeyStore& store, const std::string& key, std::string_view without = {});

/// A member; nullptr where `value` is no object or has none. Never throws.
[[nodiscard]] const Json* find_member(const Json& value, const char* name);
/// A member that is a text, else "".
[[nodiscard]] std::string text_member(const Json& value, const char* name);
/// An integer that fits in 63 bits and is not negative.
[[nodiscard]] std::optional<std::int64_t> as_count(const Json& value);
/// Counts, at least `least` each, as many as there are from 1 to 32. Throws Error{input}.
[[nodiscard]] std::vector<std::int64_t> read_counts(const KeyStore& store, const std::string& key, const Json& object, const char* name,
                                                    std::int64_t least);
/// "shape", "codecs[2].name", ... in messages: key, then member.
[[nodiscard]] std::string in_key(const std::string& key, const std::string& member);

}  // namespace isoatlas

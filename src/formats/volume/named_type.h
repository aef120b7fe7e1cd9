// The types of samples under the names that a format gives them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "formats/common/wide_integers.h"
#include "isoatlas/volume.h"

namespace isoatlas {

struct NamedType {
    std::string_view name;
    ValueType type;
    WideInteger wide = WideInteger::none;
};

/// nullptr: the format has no such type, or no samples have it. O(types).
[[nodiscard]] inline const NamedType* find_named_type(std::span<const NamedType> types, std::string_view name) {
    for (const NamedType& known : types) {
        if (known.name == name) return &known;
    }
    return nullptr;
}

/// The same of a table without wide integers.
[[nodiscard]] inline std::optional<ValueType> find_type(std::span<const NamedType> types, std::string_view name) {
    const NamedType* found = find_named_type(types, name);
    return found == nullptr ? std::nullopt : std::optional(found->type);
}

}  // namespace isoatlas

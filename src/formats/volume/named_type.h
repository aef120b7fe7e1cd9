// The types of samples under the names that a format gives them.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "isoatlas/volume.h"

namespace isoatlas {

struct NamedType {
    std::string_view name;
    ValueType type;
};

/// nullopt: the format has no such type, or no samples have it. O(types).
[[nodiscard]] inline std::optional<ValueType> find_type(std::span<const NamedType> types, std::string_view name) {
    for (const NamedType& known : types) {
        if (known.name == name) return known.type;
    }
    return std::nullopt;
}

}  // namespace isoatlas

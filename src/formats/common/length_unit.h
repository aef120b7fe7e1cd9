// Units of length as headers of volumes spell them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "isoatlas/text.h"

namespace isoatlas {

/// Metres in one unit; nullopt: not a unit of length that is known here ("", "pixel", ...).
[[nodiscard]] inline std::optional<double> metres_in(std::string_view given) {
    const std::string unit = decoded_text(given);
    constexpr std::pair<std::string_view, double> kUnits[] = {{"m", 1},
                                                              {"cm", 1e-2},
                                                              {"mm", 1e-3},
                                                              {"um", 1e-6},
                                                              {"\xc2\xb5m", 1e-6},  // micro sign
                                                              {"\xce\xbcm", 1e-6},  // Greek mu
                                                              {"micron", 1e-6},
                                                              {"microns", 1e-6},
                                                              {"micrometer", 1e-6},
                                                              {"nm", 1e-9},
                                                              {"A", 1e-10},
                                                              {"\xc3\x85", 1e-10},      // A with ring
                                                              {"\xe2\x84\xab", 1e-10},  // angstrom sign
                                                              {"angstrom", 1e-10},
                                                              {"km", 1e3},
                                                              {"in", 0.0254},
                                                              {"inch", 0.0254}};
    for (const auto& [name, metres] : kUnits) {
        if (unit == name) return metres;
    }
    return std::nullopt;
}

}  // namespace isoatlas

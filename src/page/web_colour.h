// A colour in CSS notation.
#pragma once

#include <cmath>
#include <string>

#include "isoatlas/render.h"

namespace isoatlas {

/// "#rrggbb"
[[nodiscard]] inline std::string web_colour(const Colour& colour) {
    std::string text = "#";
    for (const double part : {colour.red, colour.green, colour.blue}) {
        const int byte = static_cast<int>(std::lround(255 * part));
        for (const int digit : {byte / 16, byte % 16}) text += "0123456789abcdef"[digit];
    }
    return text;
}

}  // namespace isoatlas

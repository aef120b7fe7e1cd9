#include "server/unit_word.h"

#include <algorithm>

#include "isoatlas/error.h"
#include "isoatlas/units.h"

namespace isoatlas {

std::string unit_of_lengths(QueryParameters& words, const Geometry& geometry) {
    constexpr std::size_t kLongest = 32;
    const std::optional<std::string> word = words.text("unit");
    if (!word) return geometry.unit;
    const std::string unit = unit_name(*word);
    const bool is_text = std::ranges::none_of(unit, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
    if (unit.empty() || unit.size() > kLongest || !is_text)
        throw Error(ErrorKind::usage, {.where = "unit", .what = "is no unit of length", .expected = "um, mm, m, ..."});
    if (!geometry.unit.empty() && geometry.unit != unit)
        throw Error(ErrorKind::usage, {.where = "unit",
                                       .what = "the lengths of the volume are in " + geometry.unit,
                                       .expected = "a unit where the file says none",
                                       .next = "omit it: files have the lengths and the unit of the volume"});
    return unit;
}

}  // namespace isoatlas

// An ElementCode (field/order.h) as two numbers: position and kind of the element. Separated they compress better, and the position is
// readable by other programs.
//
//   place  the voxel; of a face the corner with the smallest coordinates, of a body point that of its cell
//   form   bits 0-1 kind, 2-3 l0, 4-5 h0; voxel: 7-9 axis; face: 6 diagonal, 7-9 tie corner, 10-11 orientation; body: 6-14 corners
#pragma once

#include <cstdint>

#include "field/order.h"

namespace isoatlas {

struct ElementForm {
    std::int64_t place;
    std::uint16_t form;
};

constexpr ElementForm form_of(ElementCode code) {
    constexpr std::uint64_t kCommon = (1 << 6) - 1, kRest = (1 << 10) - 1;
    const std::int64_t index = code.index();
    if (code.is_body())
        return {index >> 9, static_cast<std::uint16_t>((code.bits & kCommon) | static_cast<std::uint64_t>(index & 511) << 6)};
    if (code.kind() == CodeKind::vertex) return {index, static_cast<std::uint16_t>(code.bits & kRest)};
    return {index / 3, static_cast<std::uint16_t>((code.bits & kRest) | static_cast<std::uint64_t>(index % 3) << 10)};
}

/// The code of this place and form; unspecified for invalid numbers. place: at least 0 and less than 2^45.
constexpr ElementCode code_of(ElementForm element) {
    const std::uint64_t form = element.form, low = form & ((1 << 10) - 1);
    const auto place = static_cast<std::uint64_t>(element.place);
    if (form >> 1 & 1) return {(place << 9 | form >> 6) << 10 | (form & ((1 << 6) - 1))};
    if ((form & 1) == 0) return {place << 10 | low};
    return {(3 * place + (form >> 10)) << 10 | low};
}

}  // namespace isoatlas

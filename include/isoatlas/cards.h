// Cards: one for each object of a table; another isovalue of the same object has a card of its own where it has another shape.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/objects.h"

namespace isoatlas {

/// Two lines of one object with at least this overlap look the same.
inline constexpr double kSameShape = 0.6;

/// Where a line of a table of objects is shown.
struct Card {
    std::size_t line = 0;        ///< position in ObjectTable::entries of the line whose card it is on; its own: it has a card
    double overlap = 1;          ///< of the voxels of both lines, intersection over union, above 0; 1 with itself
    bool is_background = false;  ///< the outline of the scanned field (is_background()), folded away; all lines of its card are

    friend bool operator==(const Card&, const Card&) = default;
};

/// Of all lines, by position. A line is on the card with which it overlaps most, the first of several, among the lines before it that have
/// cards, are of its object, and background as it is or not; below kSameShape it has its own. The object at a higher isovalue is part of
/// that at a lower one, so overlap is voxels / voxels, exactly (docs/theory/7-which-objects-matter.md#cards). What a line gets depends on
/// the lines before it alone, and of an outline of low values on the lines inside it (is_background()): first_entries() changes nothing
/// else. Cost: O(lines), and for each those of its object.
[[nodiscard]] std::vector<Card> cards_of(const ObjectTable& table, const Extent& extent);

}  // namespace isoatlas

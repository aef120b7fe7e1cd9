// Levels: contour-tree nodes of one value joined by arcs of no length, contracted (docs/theory/3-trees.md#levels).
//
// A level has k contours in (from above) and m out (below). It is trivial iff k = m = 1 and the genus stays. The set of non-trivial
// levels does not depend on voxel numbering nor on how ties are broken.
#pragma once

#include "critical/ids.h"

namespace isoatlas {

template <class Number>
struct ContourTree;

/// Has another element the value of x? value: descending. Cheaper to ask than where that lies in a tree.
template <class Number>
[[nodiscard]] bool has_equal(ByElementView<Number, double> value, ElementIdOf<Number> x) {
    return (x.index() > 0 && value[x.previous()] == value[x]) || (x.index() + 1 < value.size() && value[x.next()] == value[x]);
}

/// Does the arc of node x span an interval of values? Arcs to the outside do.
template <class Number>
[[nodiscard]] bool has_length(const ContourTree<Number>& tree, ByElementView<Number, double> value, ElementIdOf<Number> x) {
    const ElementIdOf<Number> lower = tree.lower(x);
    return lower.index() == value.size() || value[tree.upper(x)] != value[lower];
}

/// Per element: the highest element of its level. value: per element, descending. Cost: O(n alpha).
template <class Number>
ByElement<Number, ElementIdOf<Number>> level_roots(const ContourTree<Number>& tree, ByElementView<Number, double> value);

/// What happens at a level: k contours in, m out, and whether the sum of their genera changes.
enum class LevelKind : std::uint8_t { maximum, minimum, merge, split, genus, complex, trivial };

/// Per element, meaningful at the roots of levels. level: of level_roots. value, delta_chi: per element; no delta_chi: contours have no
/// genus (2D). Cost: O(n); 12 bytes an element of the most frequent value while it runs, for 32-bit ids.
template <class Number>
ByElement<Number, LevelKind> level_kinds(const ContourTree<Number>& tree, ByElementView<Number, ElementIdOf<Number>> level,
                                         ByElementView<Number, double> value, ByElementView<Number, std::int8_t> delta_chi);

}  // namespace isoatlas

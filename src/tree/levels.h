// Levels: contour-tree nodes of one value joined by arcs of no length, contracted (theory.md section 6b).
//
// A level has k contours in (from above) and m out (below). It is trivial iff k = m = 1 and the genus stays. The set of non-trivial
// levels does not depend on voxel numbering nor on how ties are broken.
#pragma once

#include <span>
#include <vector>

#include "isoatlas/analysis.h"
#include "tree/contour_tree.h"

namespace isoatlas {

template <class Id>
struct Levels {
    using Signed = std::make_signed_t<Id>;
    std::vector<Id> root;          ///< per element: the highest element of its level
    // Indexed by element, meaningful at roots:
    std::vector<Id> in, out;       ///< number of contours just above and just below
    std::vector<Signed> gain;      ///< sum of genera out - sum of genera in

    [[nodiscard]] bool is_root(std::size_t element) const { return root[element] == static_cast<Id>(element); }
    [[nodiscard]] bool is_trivial(std::size_t root_element) const {
        return in[root_element] == 1 && out[root_element] == 1 && gain[root_element] == 0;
    }
    [[nodiscard]] Criticality kind(std::size_t root_element) const;
};

/// value: per element, descending. Cost: O(n alpha).
template <class Id>
Levels<Id> contract_levels(const ContourTree<Id>& tree, std::span<const double> value);

}  // namespace isoatlas

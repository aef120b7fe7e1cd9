// CriticalSet: the critical elements of any domain, the input of the tree stage; independent of grids.
//
// Structure of arrays, indexed by critical element in descending total order (0 = highest). An element refers to the extrema that its
// neighbourhood leads to ("representatives", docs/theory/3-trees.md#only-critical-elements): above, the maxima reached from the h0 objects
// that meet there; below, the minima reached from the l0 low components. Equal representatives of a pair are allowed: they may or may not
// be one component.
//
// In the literature: an extremum graph, saddles with the extrema that they lead to; merge trees from it: Lukasczyk et al., ExTreeM, 2023.
#pragma once

#include <cstddef>
#include <cstdint>

#include "critical/ids.h"

namespace isoatlas {

template <class Number>
struct CriticalSet {
    ByElement<Number, double> value;
    ByElement<Number, std::uint64_t> code;                ///< ElementCode bits; the tree reads h0, l0 only
    ByElement<Number, MaximumIdOf<Number>> up_a, up_b;    ///< equal when h0 < 2; a maximum is its own representative
    ByElement<Number, MinimumIdOf<Number>> low_a, low_b;  ///< 0 = outside; a minimum is its own representative
    std::int64_t maxima = 0;                              ///< maxima are numbered 0 .. maxima-1
    std::int64_t minima = 0;                              ///< minima are numbered 1 .. minima; 0 is the outside
    int rank = 3;

    [[nodiscard]] std::size_t size() const { return value.size(); }
};

}  // namespace isoatlas

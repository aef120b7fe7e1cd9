// What the engine asks of a domain: all that analyse_domain() (analysis/analyse_domain.h) needs to know of a grid, a mesh or a graph.
//
// In the literature: an extremum graph with a basin for every vertex (Lukasczyk et al., ExTreeM, 2023).
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <span>

#include "base/phase.h"
#include "critical/critical_set.h"

namespace isoatlas {

/// The critical elements by rank, and for every vertex the number of a maximum above it (Basins::number).
template <class Number>
struct Criticals {
    CriticalSet<Number> set;
    ByVoxel<Number, Number> basin;  ///< empty when it was not to be kept
};

/// Per maximum: its element.
template <class Number>
using ElementsOfMaxima = IdArray<MaximumIdOf<Number>, ElementIdOf<Number>>;

/// critical(keep_basins, context)      elements in descending total order, with the extrema around them
/// samples()                           one per vertex
/// elements_of_maxima(code)            code: of the set
/// for_parts(context, phase, work)     calls work(first, count) for parts that cover all vertices, from several threads
template <class D>
concept Domain = requires(D& domain, const D& known, const Context& context, ByElementView<typename D::Number, std::uint64_t> code,
                          const Phase& phase, const std::function<void(std::size_t, std::size_t)>& work) {
    typename D::Number;
    typename D::Sample;
    { domain.critical(true, context) } -> std::same_as<Criticals<typename D::Number>>;
    { known.samples() } -> std::same_as<std::span<const typename D::Sample>>;
    { known.elements_of_maxima(code) } -> std::same_as<ElementsOfMaxima<typename D::Number>>;
    known.for_parts(context, phase, work);
};

}  // namespace isoatlas

// Critical elements partitioned into parts (tiles of a grid), for trees in bounded memory: every pass works on one part, or on all parts at
// once in the order of ranks.
//
// Elements lie part after part, descending within a part. As in critical_set.h an element refers to its representatives; the extrema of a
// part have consecutive numbers.
//
// In the literature: domain decomposition for merge trees (Morozov, Weber, Distributed merge trees, 2013).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/big_vector.h"
#include "critical/ids.h"

namespace isoatlas {

/// Representatives of the components that meet at an element, above and below. On its empty side an extremum is its own.
template <class Number>
struct Representatives {
    std::array<MaximumIdOf<Number>, 2> above;
    std::array<MinimumIdOf<Number>, 2> below;
};

/// How many components: above (low two bits) and below.
constexpr std::uint8_t branches_of(int above, int below) { return static_cast<std::uint8_t>(above | below << 2); }
constexpr int branches_above(std::uint8_t branches) { return branches & 3; }
constexpr int branches_below(std::uint8_t branches) { return branches >> 2; }

/// Elements in descending order.
template <class Number>
struct RepresentedSet {
    ByElement<Number, std::uint8_t> branches;
    ByElement<Number, Representatives<Number>> representatives;
    std::size_t maxima = 0, minima = 0;  ///< above: 0 .. maxima-1; below: 0 .. minima, 0 = outside

    [[nodiscard]] std::size_t size() const { return representatives.size(); }
};

/// An element of a part. Side by side, because it is read in the order of ranks: from all parts alternately.
template <class Number>
struct PartitionedElement {
    Representatives<Number> representatives;
    std::uint8_t branches;
};
constexpr std::uint8_t kRemoved = 0xff;  ///< for branches: tree/reduce.h

template <class Number>
struct PartitionedSet {
    BigVector<PartitionedElement<Number>> elements;  ///< part after part
    std::vector<std::size_t> first;                  ///< element of each part, and of the end
    /// Of each part, and of the end. The outside is minimum 0 and belongs to no part.
    std::vector<MaximumIdOf<Number>> first_maximum;
    std::vector<MinimumIdOf<Number>> first_minimum;

    [[nodiscard]] std::size_t parts() const { return first.size() - 1; }
    [[nodiscard]] std::size_t size() const { return elements.size(); }
    /// The part's own piece of an array with an entry per element.
    template <class Array>
    [[nodiscard]] auto of(std::size_t part, Array& array) const {
        return std::span(array).subspan(first[part], first[part + 1] - first[part]);
    }
};

}  // namespace isoatlas

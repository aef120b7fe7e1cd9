// Isovalues at which methods can be compared on random volumes.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "oracle/mesh_checks.h"

namespace oracle {

/// An isovalue between samples and saddles, and not so near one that rounding decides; nothing where there is none.
inline std::optional<double> generic_tau(const Grid& grid) {
    const Elements elements = elements_of(grid, isoatlas::Interpolant::trilinear);
    std::vector<double> values = interesting_values(elements);
    const double range = values.back() - values.front();
    std::erase_if(values, [&](double tau) {
        return std::ranges::any_of(elements.all, [&](const Element& e) { return std::abs(e.value - tau) < 1e-7 * range; });
    });
    if (values.empty()) return std::nullopt;
    return values[*rc::gen::inRange<std::size_t>(0, values.size())];
}

}  // namespace oracle

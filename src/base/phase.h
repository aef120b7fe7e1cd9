// Phases of a long call, as its progress reports them: declared once for each call, so that names, order and number agree.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "isoatlas/context.h"

namespace isoatlas {

struct Phase {
    std::string_view name;
    int index, count;
};

inline void report(const Context& context, const Phase& phase, double fraction) {
    context.report(phase.name, phase.index, phase.count, fraction);
}

/// The phases of one call in their order.
template <std::size_t N>
struct PhasePlan {
    std::array<std::string_view, N> names;

    /// A name that is not in the plan does not compile.
    consteval Phase operator[](std::string_view name) const {
        for (std::size_t i = 0; i < N; ++i) {
            if (names[i] == name) return {names[i], static_cast<int>(i), static_cast<int>(N)};
        }
        throw "no such phase";  // NOLINT: never at run time
    }
    [[nodiscard]] static constexpr int count() { return static_cast<int>(N); }
};

/// The phase of a call that has no other.
constexpr Phase only_phase(std::string_view name) { return {name, 0, 1}; }

// Plans of calls that several rooms work on.
inline constexpr PhasePlan<5> kAnalysisPhases{{"classify", "basins", "sort", "trees", "zones"}};
inline constexpr PhasePlan<3> kCutPhases{{"classify", "objects", "contours"}};
inline constexpr PhasePlan<3> kLabelPhases{{"classify", "objects", "labels"}};
inline constexpr PhasePlan<3> kSelectPhases{{"classify", "cells", "ids"}};
inline constexpr PhasePlan<3> kSurfacePhases{{"classify", "count", "points"}};
inline constexpr PhasePlan<3> kTrianglePhases{{"classify", "count", "triangles"}};

}  // namespace isoatlas

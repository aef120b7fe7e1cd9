#include "methods/surfaces/marching_cubes_33.h"

#include <algorithm>

namespace isoatlas {
namespace {

/// Faces of a cell that contain an edge, a bit each.
constexpr std::array<unsigned, 12> kFacesOfEdge = [] {
    std::array<unsigned, 12> faces{};
    for (std::size_t edge = 0; edge < 12; ++edge) {
        for (unsigned face = 0; face < 6; ++face) {
            const auto has = [&](int corner) { return std::ranges::find(kFaceCorners[face], corner) != kFaceCorners[face].end(); };
            if (has(kEdgeCorners[edge][0]) && has(kEdgeCorners[edge][1])) faces[edge] |= 1U << face;
        }
    }
    return faces;
}();

/// Regions of a cell on both sides of a loop.
struct Sides {
    std::uint8_t high, low;
};

Sides sides_of(std::span<const std::uint8_t> loop, int pattern, const std::array<std::uint8_t, 8>& region) {
    const auto [from, to] = kEdgeCorners[loop.front()];
    const bool is_first_high = (pattern >> from & 1) != 0;
    return {region[static_cast<std::size_t>(is_first_high ? from : to)], region[static_cast<std::size_t>(is_first_high ? to : from)]};
}

}  // namespace

std::optional<TwoLoops> loops_of_tube(const std::array<double, 8>& values, int pattern, int joined, const CellLoops& loops) {
    if (loops.count < 2) return std::nullopt;
    const std::array<std::uint8_t, 8> region = cell_regions(pattern, joined);
    std::array<Sides, 4> sides{};
    for (int loop = 0; loop < loops.count; ++loop) sides[static_cast<std::size_t>(loop)] = sides_of(edges_of(loops, loop), pattern, region);
    const CellSections sections(values, 2);  // any axis will do
    for (const std::size_t diagonal : {0, 1}) {
        const std::optional<JoinedCorners> corners = sections.joins(diagonal);
        if (!corners) continue;
        const std::uint8_t a = region[static_cast<std::size_t>(corners->a)], b = region[static_cast<std::size_t>(corners->b)];
        for (int one = 0; one < loops.count && a != b; ++one) {  // the two with a and b on one side, and a region of its own on the other
            for (int other = 0; other < loops.count; ++other) {
                const Sides &p = sides[static_cast<std::size_t>(one)], &q = sides[static_cast<std::size_t>(other)];
                if ((p.high == a && q.high == b && p.low == q.low) || (p.low == a && q.low == b && p.high == q.high))
                    return TwoLoops{one, other};
            }
        }
    }
    return std::nullopt;
}

int start_of_fan(std::span<const std::uint8_t> loop) {
    const std::size_t count = loop.size();
    for (std::size_t start = 0; start < count; ++start) {
        bool is_good = true;
        for (std::size_t i = 2; i + 1 < count; ++i)
            is_good = is_good && (kFacesOfEdge[loop[start]] & kFacesOfEdge[loop[(start + i) % count]]) == 0;
        if (is_good) return static_cast<int>(start);
    }
    return -1;
}

}  // namespace isoatlas

// Marching Cubes 33: the asymptotic decider on faces, and a test of what the inside of a cell joins (docs/methods.md).
//
// The loops of the cell are those of the asymptotic decider. Where the interior test joins two regions, the two loops between them and the
// region around are the ends of a tube; every other loop has a disk. Disks are fans without chords in faces of the cell; loops that have
// none get a point in their middle, as do cases 7.3, 10.2, 12.2 and 13.3 of the paper. Nothing here is a table of the paper: the 33 cases
// follow from loops, regions and the test.
//
// In the literature: Chernyaev, Marching Cubes 33: construction of topologically correct isosurfaces, 1995; Custodio, Etiene, Pesco, Silva,
// Practical considerations on Marching Cubes 33 topological correctness, 2013.
#pragma once

#include <optional>

#include "methods/surfaces/interior_test.h"
#include "methods/surfaces/loops.h"
#include "methods/surfaces/tube.h"

namespace isoatlas {

struct TwoLoops {
    int one, other;
};

/// The loops that a tube joins, of a cell with these loops.
[[nodiscard]] std::optional<TwoLoops> loops_of_tube(const std::array<double, 8>& values, int pattern, int joined, const CellLoops& loops);

/// The place in a loop where a fan has no chord in a face; -1: there is none.
[[nodiscard]] int start_of_fan(std::span<const std::uint8_t> loop);

/// Adds the triangles of an active cell.
template <class T>
void add_cell_of_33(const Index3& cell, EdgePoints<T>& points) {
    const int pattern = points.pattern(cell), joined = joined_faces(cell, pattern, FaceRule::asymptotic_decider, points);
    const CellLoops& loops = cell_loops(pattern, joined);
    std::array<double, 8> values;
    for (int corner = 0; corner < 8; ++corner)
        values[static_cast<std::size_t>(corner)] = points.value(corner_of(cell, corner)) - points.tau();
    const auto hit = [&](std::size_t edge) { return hit_of(cell, pattern, edge, points); };
    const std::optional<TwoLoops> two = loops_of_tube(values, pattern, joined, loops);
    if (two) {
        std::array<Vec3, 12> at{};
        for (const int loop : {two->one, two->other}) {
            for (const std::uint8_t edge : edges_of(loops, loop)) at[edge] = points.position(hit(edge));
        }
        for (const HitTriangle& t : tube(edges_of(loops, two->one), edges_of(loops, two->other), at))
            points.add_triangle(hit(t[0]), hit(t[1]), hit(t[2]));
    }
    for (int loop = 0; loop < loops.count; ++loop) {
        if (two && (loop == two->one || loop == two->other)) continue;
        const std::span<const std::uint8_t> edges = edges_of(loops, loop);
        const std::size_t count = edges.size();
        if (const int start = start_of_fan(edges); start >= 0) {
            const auto at = [&](std::size_t i) { return hit(edges[(static_cast<std::size_t>(start) + i) % count]); };
            for (std::size_t i = 1; i + 1 < count; ++i) points.add_triangle(at(0), at(i), at(i + 1));
            continue;
        }
        std::vector<std::int64_t> hits;
        for (const std::uint8_t edge : edges) hits.push_back(hit(edge));
        const std::int64_t middle = points.middle_of(hits);
        for (std::size_t i = 0; i < count; ++i) points.add_triangle(middle, hits[i], hits[(i + 1) % count]);
    }
}

}  // namespace isoatlas

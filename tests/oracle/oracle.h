// Brute force: docs/theory read aloud. For small volumes. It shares no code with src/, and prefers being obvious to being fast:
// every cut of the total order is built from nothing (flood the objects and the low components, pair the hits on every face,
// count vertices, edges and loops of every contour); trees, levels and events are read off the sequence of cuts.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace oracle {

using Index = std::int64_t;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Samples, x fastest. rank 2: size[2] == 1.
struct Grid {
    int rank = 3;
    std::array<Index, 3> size{1, 1, 1};
    std::vector<double> value;

    Index voxels() const { return size[0] * size[1] * size[2]; }
    Index index(Index x, Index y, Index z) const { return x + size[0] * (y + size[1] * z); }
    std::array<Index, 3> voxel(Index i) const { return {i % size[0], i / size[0] % size[1], i / size[0] / size[1]}; }
    bool contains(const std::array<Index, 3>& p) const;
    /// Voxel next to v in direction d (-x +x -y +y -z +z), or -1: outside.
    Index neighbour(Index v, int d) const;
    int directions() const { return 2 * rank; }
};

enum class Type { vertex, face, body };

/// A vertex, the point of an ambiguous face, or a body point. Elements 0..voxels-1 are the vertices.
struct Element {
    double value = 0;
    std::array<double, 2> tie{};  ///< second and third part of the key
    std::array<double, 3> position{};
    Type type = Type::vertex;
    std::array<Index, 4> corner{};       ///< face: a b c d, around
    std::array<Index, 2> high{}, low{};  ///< face: the diagonals
    Index face = -1;                     ///< body: its F
    bool joins_highs = false;            ///< body: B1; else B2
    Index cell = -1;                     ///< body: the voxel of corner 0 of its cell
    std::vector<Index> tunnel;           ///< body: corners of the two regions that its tunnel joins, as they are beside F
    std::array<Index, 2> ring{};         ///< body: the corners of F that lie around the tunnel
};

/// A body point (docs/theory/6-interior.md#body-points). The oracle is told where they are (tests/unit/critical/bodies_test.cpp checks that
/// alone) and finds out what they do.
struct Body {
    Index cell;        ///< voxel of corner 0
    int face;          ///< its F: 2 * orientation (xy, xz, yz) + side
    bool joins_highs;  ///< B1 above F; else B2 below F
    double value;
};

/// All elements and their total order. rank_of: 0 = lowest. face_at[3 * corner a + orientation] = element or -1.
struct Elements {
    Grid grid;
    std::vector<Element> all;
    std::vector<Index> by_rank;  ///< element of each rank
    std::vector<Index> rank_of;  ///< rank of each element
    std::vector<Index> face_at;
    explicit Elements(Grid g, const std::vector<Body>& bodies = {});
    Index count() const { return static_cast<Index>(all.size()); }
    /// The cut of an isovalue: the lowest rank whose value is at least tau.
    Index cut_at(double tau) const;
    bool is_high(Index element, Index cut) const { return element >= 0 && rank_of[element] >= cut; }  // -1, the outside, is Low
    /// Is the tunnel of a body point open at a cut? Between the point and its F.
    bool is_open(Index body, Index cut) const;
    /// Corners of one cell (by the voxel of corner 0) in one piece with a corner of it, as far as the border of the cell joins them.
    std::vector<Index> region(Index cell, Index corner, Index cut) const;
    /// Edges (High voxel, Low voxel) of the cell of a body point between what its tunnel joins and the region around it.
    std::vector<std::pair<Index, Index>> edges_at_tunnel(Index body, Index cut) const;

private:
    void sort();
};

struct Contour {
    Index object = -1, low = -1;  ///< low 0: the outside
    Index hits = 0, segments = 0, loops = 0;
    bool consistent = true;  ///< touches one object and one low component only
    Index chi() const { return hits - segments + loops; }
    Index genus = 0;  ///< 2D: 0
};

struct Object {
    Index chi = 0, b1 = 0, b2 = 0, voxels = 0;
    Index highest = -1;  ///< voxel of the highest rank
    std::vector<Index> contours;
};

struct LowComponent {
    Index lowest = -1;  ///< voxel of the lowest rank; -1: the outside
};

/// Everything at one cut: High are the elements of rank >= cut.
struct Snapshot {
    std::vector<Index> object_of;  ///< of each element; -1: Low
    std::vector<Index> low_of;     ///< of each element; -1: High; 0: the outside
    std::vector<Object> objects;
    std::vector<LowComponent> lows;
    std::vector<Contour> contours;
    std::vector<Index> contour_of_hit;  ///< hit 6 * High voxel + direction; -1: none
    Index active_cells = 0;
    Index chi_by_cells = 0;  ///< Euler number of the High set counted cell by cell, not from contours
};
Snapshot snapshot(const Elements& elements, Index cut);

struct CriticalElement {
    Index element;
    double value;
    std::array<double, 3> position;
    int h0, l0, delta_chi;
    Type type;
};

/// Contour while it lives: ids are positions in Result::critical; lower == critical.size(): the outside.
struct Arc {
    Index upper, lower;
    double value_high, value_low;
    Index genus;
};

struct Level {
    double value;
    std::vector<Index> in, out;  ///< genera, sorted
    Index event;
    Index top;  ///< highest critical element (position in Result::critical)
};

enum class Kind { maximum, minimum, merge, split, genus, complex };

struct Event {
    double value;
    std::array<double, 3> position;
    Kind kind;
    Index parent = -1;
    std::vector<Index> children;
    Index lows_out, delta_chi, chi, b1, b2;
    std::vector<Index> genera;  ///< of the contours of its object in its zone, sorted
    double tau_low = -kInfinity;
    Index zone_voxels = 0, object_voxels = 0;
};

struct Result {
    std::vector<CriticalElement> critical;  ///< descending
    std::vector<Arc> arcs;                  ///< of different values at both ends
    std::vector<Level> levels;              ///< non-trivial, by highest critical element
    std::vector<Event> events;              ///< descending
    std::vector<Index> zone;                ///< event of each voxel
    bool consistent = true;                 ///< T1 and T2 held at every cut; no element did what docs/theory excludes
};
/// Cost: one snapshot per element.
Result analyse(const Elements& elements);

}  // namespace oracle

// One cut, from nothing: flood, pair, count (docs/theory/1-elements-and-order.md).
#include <algorithm>
#include <numeric>

#include "oracle/oracle.h"

namespace oracle {
namespace {

/// Disjoint sets, the plainest way.
struct Sets {
    std::vector<Index> up;
    explicit Sets(Index n) : up(static_cast<std::size_t>(n)) { std::iota(up.begin(), up.end(), Index{0}); }
    Index find(Index x) {
        while (up[x] != x) x = up[x] = up[up[x]];
        return x;
    }
    void join(Index a, Index b) { up[find(a)] = find(b); }
};

struct Builder {
    const Elements& elements;
    const Grid& grid;
    const Index cut;
    Snapshot result{};
    Index open_tunnels = 0;

    bool is_high(Index element) const { return elements.is_high(element, cut); }

    // --- objects and low components: connected components of the graph G ------------------------------------------------------
    void flood() {
        const Index outside = elements.count();
        Sets sets(outside + 1);
        const auto link = [&](Index p, Index q) {
            if (is_high(p) == is_high(q)) sets.join(p, q);
        };
        for (Index v = 0; v < grid.voxels(); ++v) {
            for (int d = 0; d < grid.directions(); ++d) {
                const Index w = grid.neighbour(v, d);
                if (w >= 0) link(v, w);
                if (w < 0 && !is_high(v)) sets.join(v, outside);
            }
        }
        for (Index e = grid.voxels(); e < elements.count(); ++e) {
            const Element& element = elements.all[e];
            if (element.type == Type::face) {
                for (const Index corner : element.corner) link(e, corner);
            } else if (is_high(e) == element.joins_highs) {  // the class it joins
                for (const Index corner : element.tunnel) link(e, corner);
            } else {
                link(e, element.ring[0]);
            }
        }
        number(sets, outside);
    }

    void number(Sets& sets, Index outside) {
        std::vector<Index> name(static_cast<std::size_t>(outside + 1), -1);
        result.lows.push_back({});
        name[sets.find(outside)] = 0;
        result.object_of.assign(elements.all.size(), -1);
        result.low_of.assign(elements.all.size(), -1);
        for (Index r = 0; r < elements.count(); ++r) {  // ascending: the first voxel of a low component is its lowest
            const Index e = elements.by_rank[r];
            Index& label = name[sets.find(e)];
            const bool is_vertex = e < grid.voxels();
            if (is_high(e)) {
                if (label < 0) label = add_object();
                result.object_of[e] = label;
                if (is_vertex) {
                    result.objects[label].highest = e;
                    ++result.objects[label].voxels;
                }
            } else {
                if (label < 0) label = add_low();
                result.low_of[e] = label;
                LowComponent& low = result.lows[label];
                if (is_vertex && label > 0 && low.lowest < 0) low.lowest = e;
            }
        }
    }
    Index add_object() {
        result.objects.emplace_back();
        return static_cast<Index>(result.objects.size()) - 1;
    }
    Index add_low() {
        result.lows.emplace_back();
        return static_cast<Index>(result.lows.size()) - 1;
    }

    // --- contours: hits paired on faces, loops in cells ----------------------------------------------------------------------------
    using Point = std::array<Index, 3>;
    Index at(const Point& p) const { return grid.contains(p) ? grid.index(p[0], p[1], p[2]) : -1; }

    /// The hit between two neighbouring points, -1 when both are of one class.
    Index hit(const Point& p, const Point& q) const {
        const bool p_high = is_high(at(p)), q_high = is_high(at(q));
        if (p_high == q_high) return -1;
        const Point& from = p_high ? p : q;
        const Point& to = p_high ? q : p;
        int d = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (to[axis] < from[axis]) d = 2 * axis;
            if (to[axis] > from[axis]) d = 2 * axis + 1;
        }
        return 6 * at(from) + d;
    }

    struct Segment {
        Index first, second;
    };
    /// The segments on the face with base point a (it may lie outside).
    std::vector<Segment> segments(const Point& a, int orientation) const {
        constexpr int axis1[3] = {0, 0, 1}, axis2[3] = {1, 2, 2};
        Point b = a, c = a, d = a;
        ++b[axis1[orientation]], ++c[axis1[orientation]], ++c[axis2[orientation]], ++d[axis2[orientation]];
        const Index ab = hit(a, b), bc = hit(b, c), cd = hit(c, d), da = hit(d, a);
        std::vector<Index> hits;
        for (const Index h : {ab, bc, cd, da}) {
            if (h >= 0) hits.push_back(h);
        }
        if (hits.size() == 2) return {{hits[0], hits[1]}};
        if (hits.size() != 4) return {};
        const Index face = elements.face_at[3 * at(a) + orientation];  // four hits: all corners are voxels and the face is ambiguous
        const bool highs_joined = is_high(face);
        const bool cut_off_a_and_c = is_high(at(a)) != highs_joined;  // joined: the Low corners are cut off
        if (cut_off_a_and_c) return {{da, ab}, {bc, cd}};
        return {{ab, bc}, {cd, da}};
    }

    void contours() {
        Sets sets(6 * grid.voxels());
        std::vector<Segment> every;
        std::vector<Segment> cell_loops;  // (a hit of the loop, number of loops = 1)
        const Index z_first = grid.rank == 2 ? 0 : -1;
        const int orientations = grid.rank == 2 ? 1 : 3;
        for (Index z = z_first; z < grid.size[2]; ++z) {
            for (Index y = -1; y < grid.size[1]; ++y) {
                for (Index x = -1; x < grid.size[0]; ++x) {
                    for (int orientation = 0; orientation < orientations; ++orientation) {
                        for (const Segment& s : segments({x, y, z}, orientation)) every.push_back(s);
                    }
                    add_loops({x, y, z}, cell_loops);
                }
            }
        }
        for (const Segment& s : every) sets.join(s.first, s.second);
        const std::vector<Index> tunnels = join_at_tunnels(sets);
        collect(sets, every, cell_loops);
        for (const Index h : tunnels) result.contours[result.contour_of_hit[h]].loops -= 2;
        describe_objects();
    }

    /// An open tunnel joins two loops of its cell: an annulus instead of two disks. One hit of each tunnel.
    std::vector<Index> join_at_tunnels(Sets& sets) {
        std::vector<Index> tunnels;
        for (Index e = grid.voxels(); e < elements.count(); ++e) {
            if (elements.all[e].type != Type::body || !elements.is_open(e, cut)) continue;
            std::vector<Index> hits;
            for (const auto& [high, low] : elements.edges_at_tunnel(e, cut)) hits.push_back(hit(grid.voxel(high), grid.voxel(low)));
            if (count_loops(elements.all[e].cell, hits) != 2) {  // cannot be: an annulus has two ends
                result.contours.push_back({-1, -1, 0, 0, 0, false, 0});
                continue;
            }
            for (const Index h : hits) sets.join(h, hits.front());
            tunnels.push_back(hits.front());
        }
        open_tunnels = static_cast<Index>(tunnels.size());
        return tunnels;
    }

    /// Through how many loops of a cell do these hits run?
    Index count_loops(Index cell, const std::vector<Index>& hits) const {
        Sets sets(6 * grid.voxels());
        for (const Segment& s : segments_of_cell(grid.voxel(cell))) sets.join(s.first, s.second);
        std::vector<Index> loops;
        for (const Index h : hits) loops.push_back(sets.find(h));
        std::sort(loops.begin(), loops.end());
        return std::unique(loops.begin(), loops.end()) - loops.begin();
    }

    std::vector<Segment> segments_of_cell(const Point& base) const {
        std::vector<Segment> own;
        for (int orientation = 0; orientation < 3; ++orientation) {
            for (int side = 0; side < 2; ++side) {
                Point a = base;
                a[2 - orientation] += side;
                for (const Segment& s : segments(a, orientation)) own.push_back(s);
            }
        }
        return own;
    }

    /// Loops of one cell: components of its hits under the segments of its six faces (2D: a cell is one face).
    void add_loops(const Point& base, std::vector<Segment>& loops) {
        if (grid.rank == 2) {
            if (!segments(base, 0).empty()) ++result.active_cells;
            return;
        }
        std::vector<Segment> own = segments_of_cell(base);
        if (!own.empty()) ++result.active_cells;
        while (!own.empty()) {  // walk along a loop until it closes
            loops.push_back(own.back());
            const Index start = own.back().first;
            Index end = own.back().second;
            own.pop_back();
            while (end != start) {
                const auto next =
                    std::find_if(own.begin(), own.end(), [end](const Segment& s) { return s.first == end || s.second == end; });
                if (next == own.end()) {  // cannot be: every hit has two segments in its cell
                    result.contours.push_back({-1, -1, 0, 0, 0, false, 0});
                    break;
                }
                end = next->first == end ? next->second : next->first;
                own.erase(next);
            }
        }
    }

    void collect(Sets& sets, const std::vector<Segment>& every, const std::vector<Segment>& loops) {
        std::vector<Index> name(sets.up.size(), -1);
        result.contour_of_hit.assign(sets.up.size(), -1);
        for (Index v = 0; v < grid.voxels(); ++v) {
            if (!is_high(v)) continue;
            for (int d = 0; d < grid.directions(); ++d) {
                const Index w = grid.neighbour(v, d);
                if (is_high(w)) continue;
                const Index h = 6 * v + d;
                const Index object = result.object_of[v], low = w < 0 ? 0 : result.low_of[w];
                Index& label = name[sets.find(h)];
                if (label < 0) {
                    label = static_cast<Index>(result.contours.size());
                    result.contours.push_back({object, low, 0, 0, 0, true, 0});
                }
                Contour& contour = result.contours[label];
                contour.consistent = contour.consistent && contour.object == object && contour.low == low;
                ++contour.hits;
                result.contour_of_hit[h] = label;
            }
        }
        for (const Segment& s : every) ++result.contours[result.contour_of_hit[s.first]].segments;
        for (const Segment& s : loops) ++result.contours[result.contour_of_hit[s.first]].loops;
    }

    void describe_objects() {
        for (Index c = 0; c < static_cast<Index>(result.contours.size()); ++c) {
            Contour& contour = result.contours[c];
            if (contour.object < 0) continue;
            if (grid.rank == 3) contour.genus = (2 - contour.chi()) / 2;
            result.objects[contour.object].contours.push_back(c);
        }
        for (Object& object : result.objects) {
            const auto shells = static_cast<Index>(object.contours.size());
            if (grid.rank == 2) {
                object.chi = 2 - shells;
                object.b1 = shells - 1;
                continue;
            }
            for (const Index c : object.contours) object.chi += result.contours[c].chi();
            object.chi /= 2;  // the Euler number of a solid is half of its surface's
            object.b2 = shells - 1;
            object.b1 = 1 + object.b2 - object.chi;
        }
    }

    // --- Euler number of the High set, cell by cell: sum of (-1)^dim (1 - number of low components of the cell) ----------------------
    void count_chi() {
        for (Index v = 0; v < grid.voxels(); ++v) {
            for (int axes = 0; axes < 1 << grid.rank; ++axes) count_cell(v, axes);
        }
        result.chi_by_cells -= open_tunnels;  // a tunnel of Highs is a handle; one of Lows drills a hole
    }

    void count_cell(Index base, int axes) {
        std::vector<Index> corner;
        const Point p = grid.voxel(base);
        int dimension = 0;
        for (int axis = 0; axis < 3; ++axis) dimension += axes >> axis & 1;
        for (int k = 0; k < 8; ++k) {
            if ((k & ~axes) != 0) continue;
            const Point q{p[0] + (k & 1), p[1] + (k >> 1 & 1), p[2] + (k >> 2 & 1)};
            if (!grid.contains(q)) return;
            corner.push_back(at(q));
        }
        std::vector<Index> lows;
        for (const Index v : corner) {
            if (!is_high(v)) lows.push_back(v);
        }
        Sets sets(static_cast<Index>(lows.size()));
        for (std::size_t i = 0; i < lows.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (lows_touch(lows[i], lows[j])) sets.join(static_cast<Index>(i), static_cast<Index>(j));
            }
        }
        Index components = 0;
        for (Index i = 0; i < static_cast<Index>(lows.size()); ++i) components += sets.find(i) == i ? 1 : 0;
        result.chi_by_cells += (dimension % 2 == 0 ? 1 : -1) * (1 - components);
    }

    /// Two Lows of one cell: neighbours, or the Lows of an ambiguous face whose point is Low.
    bool lows_touch(Index v, Index w) const {
        const Point p = grid.voxel(v), q = grid.voxel(w);
        Point base = p;
        int differing = 0, same_axis = 2;
        for (int axis = 0; axis < 3; ++axis) {
            base[axis] = std::min(p[axis], q[axis]);
            differing += p[axis] == q[axis] ? 0 : 1;
            if (p[axis] == q[axis]) same_axis = axis;
        }
        if (differing != 2) return differing == 1;
        const Index face = elements.face_at[3 * at(base) + (2 - same_axis)];
        if (face < 0 || is_high(face)) return false;
        const std::array<Index, 2>& low = elements.all[face].low;
        return (low[0] == v && low[1] == w) || (low[0] == w && low[1] == v);
    }
};

}  // namespace

Snapshot snapshot(const Elements& elements, Index cut) {
    Builder builder{elements, elements.grid, cut, {}, 0};
    builder.flood();
    builder.contours();
    builder.count_chi();
    return builder.result;
}

}  // namespace oracle

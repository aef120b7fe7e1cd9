// Proof by cases that the triangles of two loops of one cell never meet, wherever the hits lie on their edges.
//
// A hit moves along its edge with a parameter 0 < t < 1 of its own; an articulation point is the mean of the hits of its loop. So the
// determinant that tells on which side of three such points a fourth one lies is affine in each parameter alone, also when articulation
// points are among them (it is a mean of determinants of hits; those that name a hit twice are 0). What is affine in each parameter and
// nowhere negative at the corners of the cube of all parameters is positive inside, unless it is 0 everywhere. So a plane through three of
// the six points of two triangles that parts the triangles at all corners, none of the determinants being 0 everywhere, parts them always:
// with fewer than three points of one triangle on it, that they met on it would make a determinant 0. Where no such plane is found, one
// that does not move does it. All in integers.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mesh/cell_triangles.h"
#include "oracle/mesh_checks.h"

namespace isoatlas {
namespace {

using Integer = std::int64_t;
using Point = std::array<Integer, 3>;

constexpr Integer kUnit = 27720;  // a multiple of 1..12: means of hits at corners of the cell are integers

Integer side(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]},
        w{d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/// Least and greatest value of something over all corners of the cube of parameters.
struct Range {
    Integer min = 0, greatest = 0;
    bool is_new = true;
    void add(Integer value) {
        min = is_new ? value : std::min(min, value);
        greatest = is_new ? value : std::max(greatest, value);
        is_new = false;
    }
    [[nodiscard]] bool is_positive_inside() const { return min >= 0 && greatest > 0; }
    [[nodiscard]] bool is_negative_inside() const { return greatest <= 0 && min < 0; }
};

/// The six points of two triangles of different loops, as their hits move.
class Pair {
public:
    Pair(const CellLoops& loops, const CellTriangles& cell, int triangle, int other) : loops_(loops) {
        for (int i = 0; i < 3; ++i) {
            add_point(cell, cell.corner[3 * triangle + i]);
            add_point(cell, cell.corner[3 * other + i]);
        }
        std::ranges::sort(hits_);
        hits_.erase(std::unique(hits_.begin(), hits_.end()), hits_.end());
    }

    [[nodiscard]] bool has_moving_plane() const {
        std::vector<std::array<Point, 6>> corners;
        for (unsigned bits = 0; bits < 1U << hits_.size(); ++bits) corners.push_back(at(bits));
        for (int a = 0; a < 6; ++a) {
            for (int b = a + 1; b < 6; ++b) {
                for (int c = b + 1; c < 6; ++c) {
                    if (parts(corners, a, b, c)) return true;
                }
            }
        }
        return false;
    }

    /// A plane normal * x = constant, for a normal of small integers.
    [[nodiscard]] bool has_fixed_plane() const {
        for (Integer x = -1; x <= 1; ++x) {
            for (Integer y = -1; y <= 1; ++y) {
                for (Integer z = -1; z <= 1; ++z) {
                    if (parts({x, y, z})) return true;
                }
            }
        }
        return false;
    }

private:
    /// Points 0, 2, 4 are those of the first triangle, 1, 3, 5 those of the other. Each is the mean of some hits: of one, or of a loop.
    void add_point(const CellTriangles& cell, int corner) {
        std::vector<int> mean_of{corner};
        if (corner >= 12) {
            const int loop = cell.articulation_loop[corner - 12];
            mean_of.assign(loops_.edge.begin() + loops_.begin[loop], loops_.edge.begin() + loops_.begin[loop + 1]);
        }
        hits_.insert(hits_.end(), mean_of.begin(), mean_of.end());
        points_.push_back(std::move(mean_of));
    }

    [[nodiscard]] std::array<Point, 6> at(unsigned bits) const {
        std::array<Point, 6> position{};
        for (std::size_t i = 0; i < 6; ++i) {
            for (const int hit : points_[i]) {
                const auto number = static_cast<unsigned>(std::ranges::find(hits_, hit) - hits_.begin());
                const int corner = kEdgeCorners[hit][bits >> number & 1];
                for (int axis = 0; axis < 3; ++axis) position[i][axis] += (corner >> axis & 1) * kUnit / std::ssize(points_[i]);
            }
        }
        return position;
    }

    static bool parts(const std::vector<std::array<Point, 6>>& corners, int a, int b, int c) {
        bool one_way = true, other_way = true;
        for (int d = 0; d < 6; ++d) {
            if (d == a || d == b || d == c) continue;
            Range range;
            for (const std::array<Point, 6>& p : corners) {
                range.add(side(p[a], p[b], p[c], p[d]));
                if (range.min < 0 && range.greatest > 0) return false;
            }
            const bool positive = range.is_positive_inside(), negative = range.is_negative_inside();
            one_way = one_way && (d % 2 == 0 ? positive : negative);
            other_way = other_way && (d % 2 == 0 ? negative : positive);
            if (!one_way && !other_way) return false;
        }
        return true;
    }

    /// Range of normal * x for a point.
    [[nodiscard]] Range range_of(const std::vector<int>& mean_of, const Point& normal) const {
        Integer min = 0, greatest = 0;
        for (const int hit : mean_of) {
            std::array<Integer, 2> ends{};
            for (int end = 0; end < 2; ++end) {
                for (int axis = 0; axis < 3; ++axis) ends[end] += normal[axis] * (kEdgeCorners[hit][end] >> axis & 1);
            }
            min += std::min(ends[0], ends[1]) * kUnit / std::ssize(mean_of);
            greatest += std::max(ends[0], ends[1]) * kUnit / std::ssize(mean_of);
        }
        return {min, greatest, false};
    }

    /// Is the first triangle always below the other along the normal? Both ends of a range are reached at corners only, unless it is a
    /// point.
    [[nodiscard]] bool parts(const Point& normal) const {
        for (std::size_t i = 0; i < 6; i += 2) {
            for (std::size_t j = 1; j < 6; j += 2) {
                const Range below = range_of(points_[i], normal), above = range_of(points_[j], normal);
                const bool neither_moves = below.min == below.greatest && above.min == above.greatest;
                if (below.greatest > above.min || (below.greatest == above.min && neither_moves)) return false;
            }
        }
        return true;
    }

    const CellLoops& loops_;
    std::vector<std::vector<int>> points_;
    std::vector<int> hits_;
};

/// The loop whose disk a triangle belongs to.
int loop_of(const CellLoops& loops, const CellTriangles& cell, int triangle) {
    const int corner = cell.corner[3 * triangle];
    if (corner >= 12) return cell.articulation_loop[corner - 12];
    int loop = 0;
    while (std::find(&loops.edge[loops.begin[loop]], loops.edge.data() + loops.begin[loop + 1], corner) ==
           loops.edge.data() + loops.begin[loop + 1])
        ++loop;
    return loop;
}

TEST(LoopsOfACell, StayApartWhereverTheHitsAre) {
    int pairs = 0, fixed = 0;
    for (const SurfaceStyle style : {SurfaceStyle::compact, SurfaceStyle::full}) {
        for (int number = 0; number < kCellCases; ++number) {
            const CellLoops& loops = cell_cases().loops[number];
            const CellTriangles& cell = cell_triangles(style)[number];
            for (int t = 0; t < cell.triangles; ++t) {
                for (int s = 0; s < t; ++s) {
                    if (loop_of(loops, cell, s) == loop_of(loops, cell, t)) continue;
                    const Pair pair(loops, cell, s, t);
                    ++pairs;
                    if (pair.has_moving_plane()) continue;
                    ++fixed;
                    EXPECT_TRUE(pair.has_fixed_plane()) << "case " << number << ", triangles " << s << " and " << t;
                }
            }
        }
    }
    EXPECT_EQ(pairs, 8688);
    EXPECT_EQ(fixed, 864);
}

/// May the loop be spanned from this hit, as far as chords in faces are concerned?
bool is_centre(const CellLoops& loops, int loop, int centre) {
    const int n = loops.size(loop);
    const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
    for (int step = 2; step <= n - 2; ++step) {
        if (edges_share_face(hits[centre], hits[(centre + step) % n])) return false;
    }
    return true;
}

/// Adds the fan around one hit of a loop.
void add_fan(const CellLoops& loops, int loop, int centre, CellTriangles& cell) {
    const int n = loops.size(loop);
    const std::uint8_t* hits = loops.edge.data() + loops.begin[loop];
    for (int step = 1; step + 1 < n; ++step) {
        for (const int hit : {centre, centre + step, centre + step + 1})
            cell.corner[cell.triangles * 3 + (hit == centre ? 0 : hit - centre - step + 1)] = hits[hit % n];
        ++cell.triangles;
    }
}

/// Do two triangles of hits cross somewhere? Hits close to the ends of their edges, at random.
bool are_seen_to_cross(const CellTriangles& cell, int triangle, int other, std::mt19937& random) {
    Surface surface;
    surface.points.assign(12, {0, 0, 0});
    surface.triangles = {{cell.corner[3 * triangle], cell.corner[3 * triangle + 1], cell.corner[3 * triangle + 2]},
                         {cell.corner[3 * other], cell.corner[3 * other + 1], cell.corner[3 * other + 2]}};
    for (int trial = 0; trial < 200; ++trial) {
        for (int e = 0; e < 12; ++e) {
            const double t = (random() % 2 == 0 ? 0.02 : 0.88) + 0.1 * static_cast<double>(random() % 1000) / 1000;
            for (int axis = 0; axis < 3; ++axis) {
                const int from = kEdgeCorners[e][0] >> axis & 1, to = kEdgeCorners[e][1] >> axis & 1;
                surface.points[e][axis] = from + t * (to - from);
            }
        }
        if (oracle::count_crossings(surface) > 0) return true;
    }
    return false;
}

// Why two large loops of a cell both keep their articulation points: the second condition of the compact style. And where triangles cross
// there is no proof that they do not.
TEST(LoopsOfACell, ChordsOfTwoLargeLoopsCross) {
    std::mt19937 random(7);
    int crossing = 0;
    for (int number = 0; number < kCellCases; ++number) {
        const CellLoops& loops = cell_cases().loops[number];
        if (loops.count != 2 || loops.size(0) == 3 || loops.size(1) == 3) continue;
        for (int first = 0; first < loops.size(0); ++first) {
            for (int second = 0; second < loops.size(1); ++second) {
                if (!is_centre(loops, 0, first) || !is_centre(loops, 1, second)) continue;
                CellTriangles cell;
                add_fan(loops, 0, first, cell);
                const int begin = cell.triangles;
                add_fan(loops, 1, second, cell);
                for (int t = begin; t < cell.triangles; ++t) {
                    for (int s = 0; s < begin; ++s) {
                        if (!are_seen_to_cross(cell, s, t, random)) continue;
                        ++crossing;
                        const Pair pair(loops, cell, s, t);
                        EXPECT_FALSE(pair.has_moving_plane() || pair.has_fixed_plane()) << "case " << number;
                    }
                }
            }
        }
    }
    EXPECT_GT(crossing, 0);
}

}  // namespace
}  // namespace isoatlas

// Notation: an edge (gone, kept) is collapsed into `kept`; the fan of a point is the list of its triangles, linked through their corners
// (corner 3 t + k of triangle t). The quadric of a point (Garland and Heckbert 1997) sums the squared distances to the planes of its
// triangles, weighted by area.
#include "preview/collapse_edges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "base/cancel.h"
#include "geometry/vectors.h"

namespace isoatlas {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kMinCosine = 0.25;  ///< between the normals of a triangle before and after

/// p -> p A p + 2 b p + c. A is symmetric.
struct Quadric {
    std::array<double, 6> a{};
    Vec3 b{};
    double c = 0;

    void add_plane(const Vec3& normal, double offset, double weight) {
        const auto& [x, y, z] = normal;
        const std::array<double, 6> products{x * x, y * y, z * z, x * y, x * z, y * z};
        for (std::size_t i = 0; i < 6; ++i) a[i] += weight * products[i];
        for (std::size_t i = 0; i < 3; ++i) b[i] += weight * offset * normal[i];
        c += weight * offset * offset;
    }
    void add(const Quadric& other) {
        for (std::size_t i = 0; i < 6; ++i) a[i] += other.a[i];
        for (std::size_t i = 0; i < 3; ++i) b[i] += other.b[i];
        c += other.c;
    }
    double at(const Vec3& p) const {
        const auto& [x, y, z] = p;
        return a[0] * x * x + a[1] * y * y + a[2] * z * z + 2 * (a[3] * x * y + a[4] * x * z + a[5] * y * z + dot(b, p)) + c;
    }
};

struct Candidate {
    float cost;
    std::uint32_t gone, kept;
};

/// Costs between two powers of two count as equal: then in the order of the points, in which those near each other in space are near in
/// memory.
bool is_cheaper(const Candidate& p, const Candidate& q) {
    constexpr int kMantissa = 23;
    const auto power = [](float cost) { return std::bit_cast<std::uint32_t>(cost) >> kMantissa; };
    return std::tuple(power(p.cost), p.gone, p.kept) < std::tuple(power(q.cost), q.gone, q.kept);
}

class Collapser {
public:
    Collapser(const Surface& surface, const Context& context) : context_(context), triangles_left_(surface.triangles.size()) {
        corners_.reserve(3 * surface.triangles.size());
        for (const auto& triangle : surface.triangles) {
            for (const std::int64_t corner : triangle) corners_.push_back(static_cast<std::uint32_t>(corner));
        }
        const Vec3 origin = surface.points.empty() ? Vec3{} : surface.points[0];  // close to the points: quadrics are exact enough
        points_.reserve(surface.points.size());
        for (const Vec3& point : surface.points) points_.push_back(minus(point, origin));
        next_.assign(corners_.size(), kNone);
        fan_.assign(points_.size(), kNone);
        seen_.assign(points_.size(), 0);
        quadrics_.resize(points_.size());
        for (std::uint32_t corner = 0; corner < corners_.size(); ++corner) put_in_fan(corners_[corner], corner);
        for (std::uint32_t t = 0; t < triangles_left_; ++t) add_plane(t);
    }

    void reduce(std::size_t max) {
        std::size_t part = 3;  // of the candidates: a third of them at a time, in the order of their cost
        while (triangles_left_ > max) {
            stop_if_cancelled(context_);
            std::vector<Candidate> candidates = all_candidates();
            const std::size_t wanted = std::min(candidates.size(), std::max<std::size_t>(candidates.size() / part, 64));
            const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(wanted);
            if (end != candidates.end()) std::ranges::nth_element(candidates, end, is_cheaper);
            std::sort(candidates.begin(), end, is_cheaper);
            const std::size_t before = triangles_left_;
            for (auto candidate = candidates.begin(); candidate != end && triangles_left_ > max; ++candidate) collapse(*candidate);
            if (before - triangles_left_ >= wanted / 64 + 1) continue;
            if (wanted == candidates.size() && before == triangles_left_) return;
            part = 1;
        }
    }

    std::vector<std::uint32_t> corners() && {
        std::erase(corners_, kNone);
        return std::move(corners_);
    }

private:
    static std::uint32_t after(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    const Vec3& place(std::uint32_t corner) const { return points_[corners_[corner]]; }

    void put_in_fan(std::uint32_t point, std::uint32_t corner) {
        next_[corner] = fan_[point];
        fan_[point] = corner;
    }
    void add_plane(std::uint32_t t) {
        const Vec3 &p = place(3 * t), &q = place(3 * t + 1), &r = place(3 * t + 2);
        Vec3 normal = cross(minus(q, p), minus(r, p));
        const double twice_area = std::sqrt(dot(normal, normal));
        if (!(twice_area > 0)) return;
        for (double& coordinate : normal) coordinate /= twice_area;
        for (std::uint32_t k = 0; k < 3; ++k) quadrics_[corners_[3 * t + k]].add_plane(normal, -dot(normal, p), twice_area);
    }

    /// Calls use(corner) for the triangles around a point; removed ones leave its list.
    template <class Use>
    void for_fan(std::uint32_t point, const Use& use) {
        std::uint32_t* link = &fan_[point];
        while (*link != kNone) {
            const std::uint32_t corner = *link;
            if (corners_[corner] == kNone) {
                *link = next_[corner];
                continue;
            }
            link = &next_[corner];
            use(corner);
        }
    }

    /// Each edge once, towards the point where its error is smaller.
    std::vector<Candidate> all_candidates() const {
        std::vector<Candidate> candidates;
        candidates.reserve(triangles_left_ * 3 / 2);
        for (std::uint32_t corner = 0; corner < corners_.size(); ++corner) {
            if (corners_[corner] == kNone) continue;
            const std::uint32_t p = corners_[corner], q = corners_[after(corner)];
            if (p > q) continue;  // the other triangle of the edge has it the other way round
            Quadric sum = quadrics_[p];
            sum.add(quadrics_[q]);
            const auto into_p = static_cast<float>(std::max(0.0, sum.at(points_[p])));
            const auto into_q = static_cast<float>(std::max(0.0, sum.at(points_[q])));
            candidates.push_back(into_q < into_p ? Candidate{into_q, p, q} : Candidate{into_p, q, p});
        }
        return candidates;
    }

    /// Link(gone) and Link(kept) share the two points opposite of the edge and nothing else.
    bool link_condition_holds(std::uint32_t gone, std::uint32_t kept) {
        if (++stamp_ == 0) {
            std::ranges::fill(seen_, 0);
            stamp_ = 1;
        }
        int triangles = 0, shared = 0, fan_of_kept = 0, fan_of_gone = 0;
        for_fan(kept, [&](std::uint32_t corner) {
            seen_[corners_[after(corner)]] = stamp_;
            ++fan_of_kept;
        });
        for_fan(gone, [&](std::uint32_t corner) {
            const std::uint32_t next = corners_[after(corner)], last = corners_[after(after(corner))];
            triangles += next == kept || last == kept;
            shared += seen_[next] == stamp_;
            ++fan_of_gone;
        });
        return triangles == 2 && shared == 2 && (fan_of_kept > 3 || fan_of_gone > 3);  // both 3: a tetrahedron
    }

    /// The triangles around `gone` that stay do not turn over.
    bool keeps_normals(std::uint32_t gone, std::uint32_t kept) {
        bool keeps = true;
        for_fan(gone, [&](std::uint32_t corner) {
            const std::uint32_t b = after(corner), c = after(b);
            if (!keeps || corners_[b] == kept || corners_[c] == kept) return;
            const Vec3 side = minus(place(c), place(b));
            const Vec3 before = cross(side, minus(points_[gone], place(b)));
            const Vec3 now = cross(side, minus(points_[kept], place(b)));
            const double lengths = std::sqrt(dot(before, before) * dot(now, now));
            keeps = lengths > 0 ? dot(before, now) > kMinCosine * lengths : dot(before, before) == 0;
        });
        return keeps;
    }

    void collapse(const Candidate& candidate) {
        const auto [cost, gone, kept] = candidate;
        if (fan_[gone] == kNone || fan_[kept] == kNone) return;
        if (!link_condition_holds(gone, kept) || !keeps_normals(gone, kept)) return;
        std::uint32_t corner = fan_[gone];
        fan_[gone] = kNone;
        while (corner != kNone) {
            const std::uint32_t following = next_[corner];
            if (corners_[corner] != kNone) move_corner(corner, kept);
            corner = following;
        }
        quadrics_[kept].add(quadrics_[gone]);
    }
    void move_corner(std::uint32_t corner, std::uint32_t kept) {
        if (corners_[after(corner)] == kept || corners_[after(after(corner))] == kept) {
            for (std::uint32_t k = 0; k < 3; ++k) corners_[corner / 3 * 3 + k] = kNone;
            --triangles_left_;
            return;
        }
        corners_[corner] = kept;
        put_in_fan(kept, corner);
    }

    const Context& context_;
    std::size_t triangles_left_;
    std::vector<std::uint32_t> corners_;  ///< three a triangle; kNone: removed
    std::vector<std::uint32_t> next_;     ///< of a corner: the next one in the fan of its point
    std::vector<std::uint32_t> fan_;      ///< of a point: its first corner
    std::vector<std::uint32_t> seen_;     ///< of a point: the last stamp
    std::vector<Vec3> points_;
    std::vector<Quadric> quadrics_;
    std::uint32_t stamp_ = 0;
};

/// The points that the triangles use, in their order.
Surface with_triangles(const Surface& surface, std::span<const std::uint32_t> corners) {
    Surface result;
    result.tau = surface.tau, result.reported_tau = surface.reported_tau;
    result.space = surface.space, result.unit = surface.unit;
    result.closed = surface.closed, result.interpolant = surface.interpolant, result.polarity = surface.polarity;
    std::vector<std::int64_t> place(surface.points.size(), -1);
    for (const std::uint32_t corner : corners) place[corner] = 0;
    std::int64_t used = 0;
    for (std::int64_t& of_point : place) of_point = of_point < 0 ? -1 : used++;
    result.points.resize(static_cast<std::size_t>(used));
    if (!surface.normals.empty()) result.normals.resize(static_cast<std::size_t>(used));
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] < 0) continue;
        result.points[static_cast<std::size_t>(place[i])] = surface.points[i];
        if (!surface.normals.empty()) result.normals[static_cast<std::size_t>(place[i])] = surface.normals[i];
    }
    result.triangles.resize(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i) result.triangles[i / 3][i % 3] = place[corners[i]];
    return result;
}

}  // namespace

Surface collapse_edges(const Surface& surface, std::size_t max, const Context& context) {
    if (surface.triangles.size() <= max) return surface;
    Collapser collapser(surface, context);
    collapser.reduce(max);
    return with_triangles(surface, std::move(collapser).corners());
}

bool has_same_topology(const Surface& before, const Surface& after) {
    SurfaceReport first = inspect(before.points, before.triangles), second = inspect(after.points, after.triangles);
    std::ranges::sort(first.component_chi);
    std::ranges::sort(second.component_chi);
    return first.component_chi == second.component_chi && first.boundary_edges == second.boundary_edges &&
           first.is_manifold() == second.is_manifold();
}

}  // namespace isoatlas

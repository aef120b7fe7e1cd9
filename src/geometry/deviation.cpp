#include "geometry/deviation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"

namespace isoatlas {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double distance_of(const NearTriangle& near) { return std::sqrt(near.nearest.squared_distance); }

/// A point of the one mesh and the triangle of the other that is nearest to it.
struct Measured {
    Vec3 point;
    NearTriangle near;
};

/// Part of a triangle of the one mesh.
using Part = std::array<Measured, 3>;

Vec3 middle_of(const Vec3& a, const Vec3& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

double distance_between(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// One triangle of the one mesh after the other. What is found in one lets parts of the next be left out.
class Search {
public:
    Search(const TriangleTree& other, const DeviationOptions& options, double lower, double upper) : other_(other), options_(options) {
        found_.lower = lower, found_.upper = upper;
    }

    void triangle(std::int64_t number, const Part& whole) {
        open_.push_back(whole);
        for (parts_ = 0; !open_.empty(); ++parts_) {
            const Part part = open_.back();
            open_.pop_back();
            for (const Measured& corner : part) reach(number, corner);
            const double bound = upper_bound(part);
            if (is_settled(bound)) {
                found_.upper = std::max(found_.upper, bound);
            } else {
                halve(part, bound);
            }
        }
    }
    [[nodiscard]] const OneSidedDistance& found() const { return found_; }

private:
    void reach(std::int64_t number, const Measured& measured) {
        const double distance = distance_of(measured.near);
        if (distance <= found_.lower && !(distance == found_.lower && found_.triangle < 0)) return;
        found_.lower = distance, found_.place = measured.point, found_.triangle = number;
        found_.upper = std::max(found_.upper, distance);
    }

    /// Would halving a part with this bound tell nothing that was asked for?
    [[nodiscard]] bool is_settled(double bound) const {
        const double limit = options_.limit, fine = 1e-6 * limit;
        constexpr std::int64_t kPartsToDecide = 10'000;  // of a triangle; one that is exactly as far as the limit would have no end
        const bool may_decide = limit > 0 && found_.lower <= limit && bound > limit && parts_ < kPartsToDecide;
        return bound <= found_.lower + (may_decide ? std::min(fine, options_.tolerance) : options_.tolerance);
    }

    [[nodiscard]] double distance(const Vec3& p, std::int64_t triangle) const { return distance_of(other_.near(p, triangle)); }

    /// No point of the part is farther from the other mesh.
    [[nodiscard]] double upper_bound(const Part& part) const {
        double bound = kInfinite;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &p = part[i].point, &q = part[(i + 1) % 3].point, &r = part[(i + 2) % 3].point;
            const double reach = std::max(distance_between(p, q), distance_between(p, r));  // no point is farther from p
            bound = std::min({bound, distance_of(part[i].near) + reach, bound_against(part, part[i].near.triangle)});
        }
        if (is_settled(bound)) return bound;
        const Vec3 side = middle_of(part[0].point, part[1].point);
        const std::int64_t inside = measure(middle_of(side, part[2].point), part[2].near.triangle).near.triangle;
        bound = std::min(bound, bound_against(part, inside));
        for (std::size_t i = 0; i < 3; ++i)
            for (const std::int64_t far : {inside, part[(i + 1) % 3].near.triangle, part[(i + 2) % 3].near.triangle})
                if (!is_settled(bound)) bound = std::min(bound, bound_cut_off(part, i, far));
        return bound;
    }

    [[nodiscard]] double bound_against(const Part& part, std::int64_t triangle) const {
        return std::max({distance(part[0].point, triangle), distance(part[1].point, triangle), distance(part[2].point, triangle)});
    }

    /// Of the part cut in two, where the way from corner i to the others comes as near to the triangle `far` as to that nearest to i: one
    /// piece against each. Infinite: no cut would settle the part.
    [[nodiscard]] double bound_cut_off(const Part& part, std::size_t i, std::int64_t far) const {
        const std::int64_t own = part[i].near.triangle;
        const std::array<std::size_t, 2> others{(i + 1) % 3, (i + 2) % 3};
        double bound = std::max(distance(part[others[0]].point, far), distance(part[others[1]].point, far));
        if (own == far || !is_settled(bound)) return kInfinite;
        bound = std::max(bound, distance_of(part[i].near));
        for (const std::size_t other : others) bound = std::max(bound, bound_at_cut(part[i].point, part[other].point, own, far));
        return bound;
    }

    /// The distance of a point between two others from the farther of two triangles, where both are about as far.
    [[nodiscard]] double bound_at_cut(Vec3 from, Vec3 to, std::int64_t own, std::int64_t far) const {
        constexpr int kHalvings = 16;
        double bound = kInfinite;
        for (int i = 0; i < kHalvings && !is_settled(bound); ++i) {
            const Vec3 middle = middle_of(from, to);
            const double to_own = distance(middle, own), to_far = distance(middle, far);
            bound = std::min(bound, std::max(to_own, to_far));
            (to_own <= to_far ? from : to) = middle;
        }
        return bound;
    }

    [[nodiscard]] Measured measure(const Vec3& p, std::int64_t guess) const { return {p, other_.nearest(p, other_.near(p, guess))}; }

    /// The longest side.
    void halve(const Part& part, double bound) {
        std::size_t longest = 0;
        double length = -1;
        for (std::size_t i = 0; i < 3; ++i) {
            const double side = distance_between(part[i].point, part[(i + 1) % 3].point);
            if (side > length) length = side, longest = i;
        }
        const Measured &a = part[longest], &b = part[(longest + 1) % 3], &c = part[(longest + 2) % 3];
        const Measured middle = measure(middle_of(a.point, b.point), a.near.triangle);
        if (middle.point == a.point || middle.point == b.point) {  // as short as doubles get
            found_.upper = std::max(found_.upper, bound);
            return;
        }
        open_.push_back({a, middle, c});
        open_.push_back({middle, b, c});
    }

    const TriangleTree& other_;
    const DeviationOptions& options_;
    OneSidedDistance found_;
    std::vector<Part> open_;
    std::int64_t parts_ = 0;  ///< of the triangle at hand
};

/// The triangle nearest to each point of a mesh; -1: of points that no triangle uses.
BigVector<std::int64_t> nearest_triangles(const MeshView& mesh, const TriangleTree& other, const Context& context) {
    BigVector<std::int64_t> nearest(mesh.points.size());
    std::fill(nearest.begin(), nearest.end(), -1);
    for (const TriangleCorners& triangle : mesh.triangles)
        for (const std::int64_t corner : triangle) nearest[static_cast<std::size_t>(corner)] = 0;
    constexpr std::size_t kPointsOfABlock = 4096;
    const CallerLooks stop(context);
    const std::size_t blocks = (nearest.size() + kPointsOfABlock - 1) / kPointsOfABlock;
    for_each_block(context.threads, static_cast<std::int64_t>(blocks), [&](std::int64_t block) {
        stop();
        const std::size_t begin = static_cast<std::size_t>(block) * kPointsOfABlock;
        std::int64_t guess = 0;  // neighbours in the list are often neighbours in space
        for (std::size_t i = begin; i < std::min(begin + kPointsOfABlock, nearest.size()); ++i)
            if (nearest[i] >= 0) guess = nearest[i] = other.nearest(mesh.points[i], other.near(mesh.points[i], guess)).triangle;
    });
    return nearest;
}

void add(OneSidedDistance& all, const OneSidedDistance& part) {
    if (part.triangle >= 0 && (all.triangle < 0 || part.lower > all.lower)) {
        all.lower = part.lower, all.place = part.place, all.triangle = part.triangle;
    }
    all.upper = std::max(all.upper, part.upper);
}

/// Rounds of blocks: what a round finds lets the next ones leave out more, whatever the number of threads.
OneSidedDistance one_sided(const MeshView& mesh, const TriangleTree& other, const DeviationOptions& options, const Context& context) {
    const BigVector<std::int64_t> nearest = nearest_triangles(mesh, other, context);
    const auto measured = [&](std::int64_t point) {
        const Vec3& p = mesh.points[static_cast<std::size_t>(point)];
        return Measured{p, other.near(p, nearest[static_cast<std::size_t>(point)])};
    };
    OneSidedDistance all;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::int64_t corner : mesh.triangles[i]) {
            const Measured at = measured(corner);
            const double distance = distance_of(at.near);
            add(all, {distance, distance, at.point, static_cast<std::int64_t>(i)});
        }
    constexpr std::size_t kTrianglesOfABlock = 256, kBlocksOfARound = 64;
    const CallerLooks stop(context);
    for (std::size_t round = 0; round < mesh.triangles.size(); round += kTrianglesOfABlock * kBlocksOfARound) {
        std::vector<OneSidedDistance> found(kBlocksOfARound);
        for_each_block(context.threads, static_cast<std::int64_t>(kBlocksOfARound), [&](std::int64_t block) {
            Search search(other, options, all.lower, all.upper);
            const std::size_t begin = round + static_cast<std::size_t>(block) * kTrianglesOfABlock;
            for (std::size_t i = begin; i < std::min(begin + kTrianglesOfABlock, mesh.triangles.size()); ++i) {
                stop();
                const TriangleCorners& t = mesh.triangles[i];
                search.triangle(static_cast<std::int64_t>(i), {measured(t[0]), measured(t[1]), measured(t[2])});
            }
            found[static_cast<std::size_t>(block)] = search.found();
        });
        for (const OneSidedDistance& part : found) add(all, part);
    }
    return all;
}

OneSidedDistance from_to(const MeshView& mesh, const MeshView& other, const DeviationOptions& options, const Context& context) {
    if (mesh.triangles.empty()) return {};
    if (other.triangles.empty()) return {kInfinite, kInfinite, mesh.points[static_cast<std::size_t>(mesh.triangles[0][0])], 0};
    const TriangleTree tree(other.points, other.triangles, context.threads);
    return one_sided(mesh, tree, options, context);
}

}  // namespace

Deviation measure_deviation(const MeshView& first, const MeshView& second, const DeviationOptions& options, const Context& context) {
    if (!(options.tolerance > 0))
        throw Error(ErrorKind::usage,
                    {.what = "the tolerance of a distance is " + std::to_string(options.tolerance), .expected = "a number above 0"});
    return {from_to(first, second, options, context), from_to(second, first, options, context)};
}

}  // namespace isoatlas

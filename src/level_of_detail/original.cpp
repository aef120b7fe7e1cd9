#include "level_of_detail/original.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "level_of_detail/quadric.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kBin = 8;  ///< cells of a bin along an axis
constexpr std::int64_t kCellsOfBin = kBin * kBin * kBin;
constexpr std::int64_t kMaxBins = std::int64_t{1} << 26;

Vec3 middle_of(const Vec3& a, const Vec3& b) { return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}; }

}  // namespace

Ball ball_of(const TrianglePoints& triangle) {
    Ball ball{};
    for (std::size_t axis = 0; axis < 3; ++axis) ball.centre[axis] = (triangle[0][axis] + triangle[1][axis] + triangle[2][axis]) / 3;
    for (const Vec3& corner : triangle) {
        const Vec3 d = minus(corner, ball.centre);
        ball.radius = std::max(ball.radius, dot(d, d));
    }
    ball.radius = std::sqrt(ball.radius);
    return ball;
}

TrianglePoints quarter_of(const TrianglePoints& triangle, std::uint32_t k) {
    const auto& [a, b, c] = triangle;
    if (k == 0) return {a, middle_of(a, b), middle_of(c, a)};
    if (k == 1) return {middle_of(a, b), b, middle_of(b, c)};
    if (k == 2) return {middle_of(c, a), middle_of(b, c), c};
    return {middle_of(a, b), middle_of(b, c), middle_of(c, a)};
}

std::array<TrianglePoints, 4> quarters_of(const TrianglePoints& triangle) {
    return {quarter_of(triangle, 0), quarter_of(triangle, 1), quarter_of(triangle, 2), quarter_of(triangle, 3)};
}

/// Ericson, Real-time collision detection, 2005, 5.1.5: the region of the triangle in which p lies.
double squared_distance_bound(const Vec3& p, const TrianglePoints& triangle) {
    const auto& [a, b, c] = triangle;
    const Vec3 ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return dot(ap, ap);
    const Vec3 bp = minus(p, b);
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return dot(bp, bp);
    const auto from = [&](double along_b, double along_c) {
        double squared = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double difference = ap[i] - along_b * ab[i] - along_c * ac[i];
            squared += difference * difference;
        }
        return squared;
    };
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return from(d1 / (d1 - d3), 0);
    const Vec3 cp = minus(p, c);
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return dot(cp, cp);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return from(0, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return from(1 - w, w);
    }
    const double sum = va + vb + vc;
    return sum > 0 ? from(vb / sum, vc / sum) : dot(ap, ap);
}

OriginalSurface::OriginalSurface(std::span<const Vec3> points, std::span<const std::array<std::int64_t, 3>> triangles, double cell)
    : points_(points), triangles_(triangles), per_cell_(1 / cell) {
    Vec3 high{};
    low_.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (const Vec3& p : points) {
        for (std::size_t axis = 0; axis < 3; ++axis) low_[axis] = std::min(low_[axis], p[axis]), high[axis] = std::max(high[axis], p[axis]);
    }
    if (points.empty()) low_ = high = {};
    for (;;) {  // the bins of a large sparse surface are larger
        std::int64_t count = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bins_[axis] = static_cast<std::int64_t>((high[axis] - low_[axis]) * per_cell_) / kBin + 1;
            count *= bins_[axis];
        }
        if (count <= kMaxBins) break;
        per_cell_ /= 2;
    }
    fill();
}

OriginalSurface::Cell OriginalSurface::cell_of(const Vec3& p) const {
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto place = static_cast<std::int64_t>(std::floor((p[axis] - low_[axis]) * per_cell_));
        cell[axis] = std::clamp<std::int64_t>(place, 0, bins_[axis] * kBin - 1);
    }
    return cell;
}

void OriginalSurface::fill() {
    const auto bin_at = [&](const Cell& cell) {
        return static_cast<std::size_t>((cell[2] / kBin * bins_[1] + cell[1] / kBin) * bins_[0] + cell[0] / kBin);
    };
    const auto for_cells = [&](std::size_t t, const auto& use) {
        Vec3 low = points_[static_cast<std::size_t>(triangles_[t][0])], high = low;
        for (std::size_t k = 1; k < 3; ++k) {
            const Vec3& p = points_[static_cast<std::size_t>(triangles_[t][k])];
            for (std::size_t axis = 0; axis < 3; ++axis)
                low[axis] = std::min(low[axis], p[axis]), high[axis] = std::max(high[axis], p[axis]);
        }
        const Cell first = cell_of(low), last = cell_of(high);
        Cell cell{};
        for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2]) {
            for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1]) {
                for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0]) use(cell);
            }
        }
    };
    bin_.assign(static_cast<std::size_t>(bins_[0] * bins_[1] * bins_[2]), 0);
    std::uint32_t used = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for_cells(t, [&](const Cell& cell) {
            std::uint32_t& bin = bin_[bin_at(cell)];
            if (bin == 0) bin = ++used;
        });
    }
    first_.assign(used * static_cast<std::size_t>(kCellsOfBin) + 1, 0);
    const auto place = [&](const Cell& cell) {
        const std::int64_t inside = (cell[2] % kBin * kBin + cell[1] % kBin) * kBin + cell[0] % kBin;
        return (bin_[bin_at(cell)] - 1) * static_cast<std::size_t>(kCellsOfBin) + static_cast<std::size_t>(inside);
    };
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        for_cells(t, [&](const Cell& cell) { ++first_[place(cell)]; });
    }
    std::uint64_t sum = 0;
    for (std::uint64_t& first : first_) first = sum += first;  // now where each cell ends; filled from there backwards
    found_.resize(sum);
    for (std::size_t t = triangles_.size(); t-- > 0;) {
        for_cells(t, [&](const Cell& cell) { found_[--first_[place(cell)]] = static_cast<std::uint32_t>(t); });
    }
}

std::span<const std::uint32_t> OriginalSurface::triangles_in(const Cell& cell) const {
    const std::uint32_t bin = bin_[static_cast<std::size_t>((cell[2] / kBin * bins_[1] + cell[1] / kBin) * bins_[0] + cell[0] / kBin)];
    if (bin == 0) return {};
    const std::int64_t inside = (cell[2] % kBin * kBin + cell[1] % kBin) * kBin + cell[0] % kBin;
    const std::size_t place = (bin - 1) * static_cast<std::size_t>(kCellsOfBin) + static_cast<std::size_t>(inside);
    return std::span(found_).subspan(first_[place], first_[place + 1] - first_[place]);
}

void OriginalSurface::find_in(const Cell& cell, const Vec3& p, Nearest& best) const {
    for (const std::uint32_t t : triangles_in(cell)) {
        const double squared = squared_distance_bound(p, corners(t));
        if (std::tie(squared, t) < std::tie(best.squared_distance, best.triangle)) best = {t, squared};
    }
}

/// Calls use(cell), the cell of p first, until it returns true.
template <class Use>
void OriginalSurface::for_cells_near(const Vec3& p, double distance, const Use& use) const {
    const Cell own = cell_of(p);
    if (use(own)) return;
    const Cell first = cell_of({p[0] - distance, p[1] - distance, p[2] - distance});
    const Cell last = cell_of({p[0] + distance, p[1] + distance, p[2] + distance});
    Cell cell{};
    for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2]) {
        for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1]) {
            for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0]) {
                if (cell != own && use(cell)) return;
            }
        }
    }
}

OriginalSurface::Nearest OriginalSurface::nearest(const Vec3& p, double limit) const {
    Nearest best{kNone, limit * limit};
    for_cells_near(p, limit, [&](const Cell& cell) {
        find_in(cell, p, best);
        return false;
    });
    return best;
}

/// Parts of the triangle: one is near a single original triangle, or is divided into four.
bool OriginalSurface::covers(const TrianglePoints& triangle, double distance) const {
    const double squared = distance * distance;
    std::array<TrianglePoints, 64> parts;  // three more a level
    std::size_t count = 0;
    parts[count++] = triangle;
    std::uint32_t near = kNone;  // the one that covered the part before
    while (count > 0) {
        const TrianglePoints part = parts[--count];
        const Ball ball = ball_of(part);
        if (ball.radius < distance + 0.5 / per_cell_) {  // else too large for a single one
            if (near != kNone && is_near_all(part, corners(near), squared)) continue;
            const auto is_covered = [&](std::uint32_t t, double squared_distance) {
                near = t;
                return std::sqrt(squared_distance) + ball.radius <= distance || is_near_all(part, corners(t), squared);
            };
            Nearest best{kNone, squared};
            bool covered = false;
            for_cells_near(ball.centre, distance, [&](const Cell& cell) {
                const std::uint32_t before = best.triangle;
                find_in(cell, ball.centre, best);
                covered = best.triangle != before && is_covered(best.triangle, best.squared_distance);
                return covered;
            });
            if (covered) continue;
            if (best.triangle == kNone) return false;
        }
        if (ball.radius < distance / 16 || count + 4 > parts.size()) return false;
        for (const TrianglePoints& quarter : quarters_of(part)) parts[count++] = quarter;
    }
    return true;
}

}  // namespace isoatlas

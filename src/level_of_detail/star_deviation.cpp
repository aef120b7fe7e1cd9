#include "level_of_detail/star_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoatlas {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Twice the area of the triangle seen along the direction.
double twice_area(const auto& a, const auto& b, const auto& c) { return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u); }

}  // namespace

/// False where a triangle does not face the direction, or the triangles after go around their apex more than once.
bool StarDeviation::project(const Star& star, const SurfaceState& state) {
    constexpr double kMinFacing = 0.05;  ///< cosine to the direction: leaves room for rounding
    Vec3 n{};
    for (const StarTriangle& t : star.triangles) {
        if (t.disappears) continue;
        n = plus(n, cross(minus(state.scaled[t.b], star.new_scaled), minus(state.scaled[t.c], star.new_scaled)));
    }
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0)) return false;
    for (double& coordinate : n) coordinate /= length;
    Vec3 u = std::abs(n[0]) < 0.6 ? Vec3{0, n[2], -n[1]} : Vec3{-n[2], 0, n[0]};
    const double length_of_u = std::sqrt(dot(u, u));
    for (double& coordinate : u) coordinate /= length_of_u;
    const Vec3 v = cross(n, u);
    const auto place = [&](const Vec3& p) {
        const Vec3 d = minus(p, star.new_scaled);
        return Place{dot(d, u), dot(d, v), dot(d, n)};
    };
    gone_ = place(star.gone_scaled), kept_ = place(star.kept_scaled), new_ = place(star.new_scaled);
    const auto place_before = [&](std::uint32_t point) {
        return point == star.gone ? gone_ : point == star.kept ? kept_ : place(state.scaled[point]);
    };
    const auto faces = [&](const Triangle& t) {
        const double area = twice_area(t.a, t.b, t.c);
        const double x = t.b.u - t.a.u, y = t.b.v - t.a.v, z = t.b.height - t.a.height;
        const double p = t.c.u - t.a.u, q = t.c.v - t.a.v, r = t.c.height - t.a.height;
        const double nx = y * r - z * q, ny = z * p - x * r;
        return area > 0 && area * area > kMinFacing * kMinFacing * (nx * nx + ny * ny + area * area);
    };
    before_.clear(), after_.clear(), sides_before_.clear(), sides_after_.clear();
    int turns = 0;
    for (const StarTriangle& t : star.triangles) {
        const Place b = place_before(t.b), c = place_before(t.c);
        before_.push_back({t.apex == star.gone ? gone_ : kept_, b, c});
        if (!faces(before_.back())) return false;
        sides_before_.push_back({before_.back().a, b});
        if (t.disappears) {
            sides_before_.push_back({b, c});  // from the kept point: no other triangle begins with one of them
            continue;
        }
        after_.push_back({new_, b, c});
        if (!faces(after_.back())) return false;
        sides_after_.push_back({new_, b});
        turns += b.v < 0 && c.v >= 0 ? 1 : 0;
    }
    return turns == 1 && after_.size() == star.ring.size();  // else it is at a rim, which moves
}

double StarDeviation::height_difference(const Place& p, const std::vector<Triangle>& triangles) {
    for (const Triangle& t : triangles) {
        const double a = twice_area(t.b, t.c, p), b = twice_area(t.c, t.a, p), c = twice_area(t.a, t.b, p);
        if (a < 0 || b < 0 || c < 0) continue;
        return std::abs((a * t.a.height + b * t.b.height + c * t.c.height) / (a + b + c) - p.height);
    }
    return kInfinity;
}

double StarDeviation::at_crossings() const {
    double largest = 0;
    for (const auto& [p, q] : sides_before_) {
        for (const auto& [r, s] : sides_after_) {
            const double from_p = twice_area(r, s, p), from_q = twice_area(r, s, q);
            if ((from_p > 0) == (from_q > 0)) continue;
            const double from_r = twice_area(p, q, r), from_s = twice_area(p, q, s);
            if ((from_r > 0) == (from_s > 0)) continue;
            const double along = from_p / (from_p - from_q), other = from_r / (from_r - from_s);
            largest = std::max(largest, std::abs(p.height + along * (q.height - p.height) - r.height - other * (s.height - r.height)));
        }
    }
    return largest;
}

/// Does a side of t have the other triangle beyond it?
bool StarDeviation::is_separated(const Triangle& t, const Triangle& other) {
    const auto is_beyond = [&](const Place& p, const Place& q) {
        return twice_area(p, q, other.a) <= 0 && twice_area(p, q, other.b) <= 0 && twice_area(p, q, other.c) <= 0;
    };
    return is_beyond(t.a, t.b) || is_beyond(t.b, t.c) || is_beyond(t.c, t.a);
}

bool StarDeviation::overlap(std::size_t i, std::size_t j) const {
    return !is_separated(before_[i], after_[j]) && !is_separated(after_[j], before_[i]);
}

double StarDeviation::find(const Star& star, const SurfaceState& state) {
    if (!project(star, state)) return kInfinity;
    double largest = std::max(height_difference(gone_, after_), height_difference(kept_, after_));
    if (largest < kInfinity) largest = std::max(largest, height_difference(new_, before_));
    return largest < kInfinity ? std::max(largest, at_crossings()) : kInfinity;
}

}  // namespace isoatlas

#include "formats/common/precision.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace isoatlas {

namespace {

using Point = std::array<double, 3>;

Point rounded(const Point& p) {
    const std::array<float, 3> f = to_float(p);
    return {f[0], f[1], f[2]};
}

std::uint64_t mix(std::uint64_t h) {  // finaliser of splitmix64 (Steele et al. 2014)
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9U;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebU;
    return h ^ (h >> 31);
}

std::uint64_t hash_of(const Point& p) {
    std::uint64_t h = 0;
    for (const double x : p) h = mix(h * 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(x + 0.0));  // -0.0 equals 0.0
    return h;
}

std::int64_t distinct(std::vector<std::uint64_t>& hashes) {
    std::sort(hashes.begin(), hashes.end());
    return std::unique(hashes.begin(), hashes.end()) - hashes.begin();
}

bool has_area(const Point& a, const Point& b, const Point& c) {
    const Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

double length(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double mean_edge(const Surface& surface) {
    double sum = 0;
    for (const auto& t : surface.triangles) {
        const Point &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
        sum += length(a, b) + length(b, c) + length(c, a);
    }
    for (const auto& s : surface.segments) sum += length(surface.points[s[0]], surface.points[s[1]]);
    return sum / static_cast<double>(3 * surface.triangles.size() + surface.segments.size());
}

}  // namespace

std::int64_t points_merged_by_float32(std::span<const std::array<double, 3>> points) {
    std::vector<std::uint64_t> hashes(points.size());
    std::transform(points.begin(), points.end(), hashes.begin(), hash_of);
    const std::int64_t before = distinct(hashes);
    std::transform(points.begin(), points.end(), hashes.begin(), [](const Point& p) { return hash_of(rounded(p)); });
    return std::max<std::int64_t>(before - distinct(hashes), 0);
}

Real position_precision(const Surface& surface) {
    if (surface.triangles.empty() && surface.segments.empty()) return Real::f32;
    double largest = 0;
    for (const Point& p : surface.points) largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    if (largest > 0x1p11 * mean_edge(surface) || largest > 0x1p126) return Real::f64;
    for (const auto& t : surface.triangles) {
        const Point &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
        if (has_area(a, b, c) && !has_area(rounded(a), rounded(b), rounded(c))) return Real::f64;
    }
    return points_merged_by_float32(surface.points) > 0 ? Real::f64 : Real::f32;
}

}  // namespace isoatlas

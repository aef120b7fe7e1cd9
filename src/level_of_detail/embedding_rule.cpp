#include "level_of_detail/embedding_rule.h"

#include <algorithm>
#include <cmath>

#include "geometry/triangles.h"

namespace isoatlas {

BoundingBox EmbeddingRule::triangle_box(std::uint32_t t) const {
    const auto [a, b, c] = state_.mesh.triangle(t);
    return box_of(state_.points[a], state_.points[b], state_.points[c]);
}

void EmbeddingRule::set_triangles(std::span<const std::uint32_t> inside, std::span<const std::uint32_t> crossing) {
    constexpr double kEdgesOfCell = 1.5;
    if (inside.empty()) return;
    BoundingBox all;
    double lengths = 0;
    for (const std::uint32_t t : inside) {
        const auto [a, b, c] = state_.mesh.triangle(t);
        for (const std::uint32_t point : {a, b, c}) all.add(state_.points[point]);
        const Vec3 side = minus(state_.points[a], state_.points[b]);
        lengths += std::sqrt(dot(side, side));
    }
    grid_.clear(all, kEdgesOfCell * lengths / static_cast<double>(inside.size()));
    for (const std::uint32_t t : inside) grid_.add(t, triangle_box(t));
    for (const std::uint32_t t : crossing) grid_.add(t, triangle_box(t));
}

void EmbeddingRule::make_parts(const Star& star) {
    parts_.clear();
    swept_ = {};
    swept_.add(star.new_point);
    swept_.add(star.gone_point);
    swept_.add(star.kept_point);
    for (const std::uint32_t point : star.ring) swept_.add(state_.points[point]);
    for (const StarTriangle& t : star.triangles) {
        if (t.disappears) continue;
        const Vec3 &b = state_.points[t.b], &c = state_.points[t.c];
        parts_.push_back({t.number,
                          {star.kept, t.b, t.c},
                          box_of(star.new_point, b, c),
                          box_of(t.apex == star.gone ? star.gone_point : star.kept_point, b, c)});
    }
}

bool EmbeddingRule::meets_itself() const {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (is_on_one_side(parts_[i].corners, parts_[j].corners) || is_on_one_side(parts_[j].corners, parts_[i].corners)) continue;
            if (triangles_cross<std::uint32_t>(state_.points, parts_[i].corners, parts_[j].corners)) return true;
        }
    }
    return false;
}

bool EmbeddingRule::holds(const Star& star) {
    make_parts(star);
    outside_.clear();
    if (meets_itself()) return false;
    return grid_.for_each(swept_, [&](std::uint32_t t) {
        if (!state_.mesh.has_triangle(t)) return true;
        const std::array<std::uint32_t, 3> other = state_.mesh.triangle(t);
        for (const std::uint32_t point : other) {
            if (point == star.gone || point == star.kept) return true;  // of the star itself
        }
        const BoundingBox box = triangle_box(t);
        if (!box.meets(swept_)) return true;
        for (const Part& part : parts_) {
            if (!box.meets(part.box) || is_on_one_side(part.corners, other) || is_on_one_side(other, part.corners)) continue;
            if (triangles_cross<std::uint32_t>(state_.points, part.corners, other)) return false;
        }
        return std::ranges::none_of(other, [&](std::uint32_t point) { return is_swept(star, point); });
    });
}

/// Do the points of the other triangle that are not of this one lie on one side of its plane, certainly? Then the triangles do not cross.
bool EmbeddingRule::is_on_one_side(const std::array<std::uint32_t, 3>& triangle, const std::array<std::uint32_t, 3>& other) const {
    const auto [a, b, c] = triangle;
    int side = 0;
    for (const std::uint32_t point : other) {
        if (point == a || point == b || point == c) continue;
        const int of_point = quick_orientation(state_.points[a], state_.points[b], state_.points[c], state_.points[point]);
        if (of_point == kUnsure || of_point == 0 || of_point == -side) return false;
        side = of_point;
    }
    return side != 0;
}

/// Every triangle before sweeps a tetrahedron: with the new place of its apex, or, where both points of the edge are its own, of the edge.
bool EmbeddingRule::is_swept(const Star& star, std::uint32_t point) {
    const Vec3& p = state_.points[point];
    if (swept_.squared_distance(p) > 0 || std::ranges::find(star.ring, point) != star.ring.end()) return false;
    if (std::ranges::find(outside_, point) != outside_.end()) return false;
    const auto is_apart = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& top) {
        const int of_point = quick_orientation(a, b, c, p), of_top = quick_orientation(a, b, c, top);
        return of_point != kUnsure && of_top != kUnsure && of_point == -of_top && of_top != 0;
    };
    for (const StarTriangle& t : star.triangles) {
        const auto place = [&](std::uint32_t i) {
            return i == star.gone ? star.gone_point : i == star.kept ? star.kept_point : state_.points[i];
        };
        const Vec3 apex = place(t.apex), b = place(t.b), c = place(t.c);
        if (is_apart(star.new_point, b, c, apex) || is_apart(apex, b, c, star.new_point)) continue;
        if (tetrahedron_contains({star.new_point, apex, b, c}, p)) return true;
    }
    outside_.push_back(point);
    return false;
}

void EmbeddingRule::commit() {
    for (const Part& part : parts_) grid_.move(part.number, part.before, part.box);
}

}  // namespace isoatlas

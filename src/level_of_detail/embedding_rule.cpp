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
            if (triangles_cross<std::uint32_t>(state_.points, parts_[i].corners, parts_[j].corners)) return true;
        }
    }
    return false;
}

bool EmbeddingRule::holds(const Star& star) {
    make_parts(star);
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
            if (box.meets(part.box) && triangles_cross<std::uint32_t>(state_.points, part.corners, other)) return false;
        }
        return std::ranges::none_of(other, [&](std::uint32_t point) { return is_swept(star, point); });
    });
}

/// Every triangle before sweeps a tetrahedron: with the new place of its apex, or, where both points of the edge are its own, of the edge.
bool EmbeddingRule::is_swept(const Star& star, std::uint32_t point) const {
    const Vec3& p = state_.points[point];
    if (swept_.squared_distance(p) > 0 || std::ranges::find(star.ring, point) != star.ring.end()) return false;
    return std::ranges::any_of(star.triangles, [&](const StarTriangle& t) {
        const auto place = [&](std::uint32_t i) {
            return i == star.gone ? star.gone_point : i == star.kept ? star.kept_point : state_.points[i];
        };
        return tetrahedron_contains({star.new_point, place(t.apex), place(t.b), place(t.c)}, p);
    });
}

void EmbeddingRule::commit() {
    for (const Part& part : parts_) grid_.move(part.number, part.before, part.box);
}

}  // namespace isoatlas

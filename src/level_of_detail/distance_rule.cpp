#include "level_of_detail/distance_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoatlas {
namespace {

constexpr double kNearEnough = 0.01;  ///< of the squared greatest distance: no nearer part is looked for

}  // namespace

void DistanceRule::make_parts(const Star& star, const SurfaceState& state) {
    parts_.clear();
    part_of_.assign(star.triangles.size(), 0);
    for (std::size_t i = 0; i < star.triangles.size(); ++i) {
        const StarTriangle& t = star.triangles[i];
        if (t.disappears) continue;
        part_of_[i] = parts_.size();
        const std::array<Vec3, 3> corners{star.new_scaled, state.scaled[t.b], state.scaled[t.c]};
        parts_.push_back({t.number, t.b, t.c, parts_.size(), parts_.size(), corners, 0});
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        for (std::size_t j = 0; j < parts_.size(); ++j) {
            if (parts_[i].c == parts_[j].b) parts_[i].after = j, parts_[j].before = i;
        }
    }
    for (std::size_t i = 0; i < star.triangles.size(); ++i) {
        const StarTriangle& t = star.triangles[i];
        if (!t.disappears) continue;
        const std::uint32_t opposite = t.b == star.kept ? t.c : t.b;
        for (std::size_t part = 0; part < parts_.size(); ++part) {
            if (parts_[part].b == opposite || parts_[part].c == opposite) part_of_[i] = part;
        }
    }
}

bool DistanceRule::holds(const Star& star, const SurfaceState& state) {
    make_parts(star, state);
    if (!tracked_stay_near(star)) return false;
    const double deviation = deviation_.find(star, state);
    for (std::size_t j = 0; j < parts_.size(); ++j) {
        Part& part = parts_[j];
        part.bound = deviation;
        for (std::size_t i = 0; part.bound <= state_.max && i < star.triangles.size(); ++i) {
            const double before = state_.to_original[star.triangles[i].number];
            if (before + deviation > part.bound && deviation_.overlap(i, j)) part.bound = before + deviation;
        }
        if (part.bound > state_.max && !measure(part)) return false;
    }
    return true;
}

/// A bound that is used up is measured: a little below the greatest distance if possible, so that it can grow again.
bool DistanceRule::measure(Part& part) {
    constexpr double kBelow = 0.9;
    for (const double part_of_max : {kBelow, 1.0}) {
        part.bound = part_of_max * state_.max;
        if (state_.original->covers(part.corners, part.bound)) return true;
    }
    return false;
}

/// Every tracked piece goes to a part that is near all of it, or is cut into quarters that do.
bool DistanceRule::tracked_stay_near(const Star& star) {
    moved_.clear();
    for (std::size_t i = 0; i < star.triangles.size(); ++i) {
        const auto moves = [&](const Piece& piece) { return move(piece, part_of_[i]); };
        if (!state_.tracked.for_each(star.triangles[i].number, moves)) return false;
    }
    return true;
}

bool DistanceRule::move(const Piece& tracked, std::size_t part) {
    std::array<Piece, 16> pieces;  // three more a level
    std::size_t count = 0;
    pieces[count++] = tracked;
    while (count > 0) {
        const Piece piece = pieces[--count];
        if (move_whole(piece, part)) continue;
        if (piece.is_smallest()) return false;
        for (std::uint32_t k = 0; k < 4; ++k) pieces[count++] = piece.quarter(k);
    }
    return true;
}

/// To the part that is nearest to the middle of the piece. First those are asked into which its triangle changes.
bool DistanceRule::move_whole(const Piece& piece, std::size_t part) {
    const TrianglePoints corners = corners_of(*state_.original, piece);
    const Ball ball = ball_of(corners);
    const double squared_max = state_.max * state_.max;
    std::size_t nearest = part;
    double least = squared_distance_bound(ball.centre, parts_[part].corners);
    const auto ask = [&](std::size_t other) {
        const double squared = squared_distance_bound(ball.centre, parts_[other].corners);
        if (squared < least) least = squared, nearest = other;
    };
    const auto is_near = [&] {
        return least <= squared_max &&
               (std::sqrt(least) + ball.radius <= state_.max || is_near_all(corners, parts_[nearest].corners, squared_max));
    };
    if (least > kNearEnough * squared_max) {
        ask(parts_[part].before);
        ask(parts_[part].after);
    }
    bool found = is_near();
    if (!found) {
        for (std::size_t other = 0; other < parts_.size(); ++other) ask(other);
        found = is_near();
    }
    if (found) moved_.push_back({piece, parts_[nearest].number});
    return found;
}

void DistanceRule::commit(const Star& star) {
    for (const StarTriangle& t : star.triangles) state_.tracked.clear(t.number);
    for (const Moved& moved : moved_) state_.tracked.add(moved.triangle, moved.piece);
    for (const Part& part : parts_) {  // rounded up
        state_.to_original[part.number] = std::nextafter(static_cast<float>(part.bound), std::numeric_limits<float>::max());
    }
}

}  // namespace isoatlas

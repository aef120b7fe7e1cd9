#include "level_of_detail/distance_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoatlas {
namespace {

constexpr double kHalf = 0.7;  ///< of the greatest distance: what is measured first when a bound is used up, so that it can grow again
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
        parts_.push_back({t.number, t.b, t.c, parts_.size(), parts_.size(), corners});
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
    double before = 0;
    for (const StarTriangle& t : star.triangles) before = std::max(before, static_cast<double>(state_.to_original[t.number]));
    bound_ = before < state_.max ? before + deviation_.find(star, state) : before;
    if (bound_ < state_.max) return true;
    const auto are_covered = [&](double distance) {
        return std::ranges::all_of(parts_, [&](const Part& part) { return state_.original->covers(part.corners, distance); });
    };
    bound_ = kHalf * state_.max;
    if (are_covered(bound_)) return true;

    bound_ = state_.max;
    return are_covered(bound_);
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
    const float rounded_up = std::nextafter(static_cast<float>(bound_), std::numeric_limits<float>::max());
    for (const Part& part : parts_) state_.to_original[part.number] = bound_ < state_.max ? rounded_up : static_cast<float>(state_.max);
}

}  // namespace isoatlas

#include "preview/distinct_places.h"

#include <algorithm>
#include <optional>
#include <unordered_set>
#include <vector>

namespace isoatlas {
namespace {

constexpr int kFarthest = 6;  ///< steps that a point may move along each axis

std::uint64_t key_of(const LatticePlace& place) {
    return std::uint64_t{place[0]} << 32 | std::uint64_t{place[1]} << 16 | std::uint64_t{place[2]};
}

std::optional<LatticePlace> moved(const LatticePlace& place, const std::array<int, 3>& by) {
    LatticePlace result{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int to = place[axis] + by[axis];
        if (to < 0 || to > 65535) return std::nullopt;
        result[axis] = static_cast<std::uint16_t>(to);
    }
    return result;
}

/// The moves, shortest first.
std::vector<std::array<int, 3>> moves() {
    std::vector<std::array<int, 3>> all;
    for (int x = -kFarthest; x <= kFarthest; ++x) {
        for (int y = -kFarthest; y <= kFarthest; ++y) {
            for (int z = -kFarthest; z <= kFarthest; ++z) {
                if (x != 0 || y != 0 || z != 0) all.push_back({x, y, z});
            }
        }
    }
    std::ranges::stable_sort(all, {}, [](const std::array<int, 3>& by) { return by[0] * by[0] + by[1] * by[1] + by[2] * by[2]; });
    return all;
}

class Lattice {
public:
    Lattice(std::span<LatticePlace> places, std::span<const unsigned> corners) : places_(places), corners_(corners) {
        taken_.reserve(2 * places.size());
        first_.resize(places.size() + 1);
        for (const unsigned corner : corners) ++first_[corner + 1];
        for (std::size_t i = 0; i < places.size(); ++i) first_[i + 1] += first_[i];
        triangles_.resize(corners.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t c = 0; c < corners.size(); ++c) triangles_[next[corners[c]]++] = c / 3;
    }

    void part() {
        std::vector<std::size_t> again;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (!taken_.insert(key_of(places_[i])).second) again.push_back(i);
        }
        for (const std::size_t i : again) move(i, false);
    }

    /// Returns how many are left.
    std::size_t unfold() {
        std::size_t left = 0;
        for (std::size_t t = 0; t < corners_.size() / 3; ++t) {
            if (!is_flat(t)) continue;
            const auto corners = corners_.subspan(3 * t, 3);
            left += std::ranges::none_of(corners, [&](unsigned corner) { return move(corner, true); });
        }
        return left;
    }

private:
    /// Area of triangle t is 0.
    [[nodiscard]] bool is_flat(std::size_t t) const {
        const auto edge = [&](std::size_t to, std::size_t axis) {
            return std::int64_t{places_[corners_[3 * t + to]][axis]} - std::int64_t{places_[corners_[3 * t]][axis]};
        };
        const auto minor = [&](std::size_t p, std::size_t q) { return edge(1, p) * edge(2, q) - edge(1, q) * edge(2, p); };
        return minor(0, 1) == 0 && minor(1, 2) == 0 && minor(2, 0) == 0;
    }

    /// To the nearest free place; needs_area: where all triangles of the point have an area. Returns whether there is one.
    bool move(std::size_t point, bool needs_area) {
        static const std::vector<std::array<int, 3>> kMoves = moves();
        const LatticePlace before = places_[point];
        for (const std::array<int, 3>& by : kMoves) {
            const std::optional<LatticePlace> to = moved(before, by);
            if (!to || taken_.contains(key_of(*to))) continue;
            places_[point] = *to;
            const auto own = std::span(triangles_).subspan(first_[point], first_[point + 1] - first_[point]);
            if (needs_area && std::ranges::any_of(own, [&](std::size_t t) { return is_flat(t); })) continue;
            if (needs_area) taken_.erase(key_of(before));  // else another point is there
            taken_.insert(key_of(*to));
            return true;
        }
        places_[point] = before;
        return false;
    }

    std::span<LatticePlace> places_;
    std::span<const unsigned> corners_;
    std::unordered_set<std::uint64_t> taken_;
    std::vector<std::size_t> first_, triangles_;  ///< of point i: triangles_[first_[i]] to triangles_[first_[i + 1]]
};

}  // namespace

std::size_t make_places_distinct(std::span<LatticePlace> places, std::span<const unsigned> corners) {
    Lattice lattice(places, corners);
    lattice.part();
    return lattice.unfold();
}

}  // namespace isoatlas

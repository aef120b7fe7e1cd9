#include "geometry/triangle_tree.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace isoatlas {
namespace {

struct Entry {
    std::array<float, 3> centre;  // decides how good the tree is, nothing else
    std::int64_t triangle;
};

/// Halves ranges of `entries`, each into a full left part of 2^k leaves and the rest, down to single leaves.
class Halving {
public:
    explicit Halving(std::span<Entry> entries) : entries_(entries) {}

    struct Range {
        std::size_t begin, end, level;  // at most kLeaf << level triangles
    };
    /// The parts of a range that are left when its levels are down to `level`.
    std::vector<Range> halve(Range whole, std::size_t level) {
        std::vector<Range> open{whole}, done;
        while (!open.empty()) {
            Range range = open.back();
            open.pop_back();
            if (range.level <= level) {
                done.push_back(range);
                continue;
            }
            const std::size_t middle = range.begin + (TriangleTree::kLeaf << (range.level - 1));
            if (middle < range.end) {
                part(range, middle);
                open.push_back({middle, range.end, range.level - 1});
                range.end = middle;
            }
            open.push_back({range.begin, range.end, range.level - 1});
        }
        return done;
    }

private:
    void part(const Range& range, std::size_t middle) {
        const std::span<Entry> here = entries_.subspan(range.begin, range.end - range.begin);
        std::array<float, 3> low = here[0].centre, high = low;
        for (const Entry& entry : here)
            for (std::size_t i = 0; i < 3; ++i) {
                low[i] = std::min(low[i], entry.centre[i]);
                high[i] = std::max(high[i], entry.centre[i]);
            }
        std::size_t axis = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (high[i] - low[i] > high[axis] - low[axis]) axis = i;
        std::nth_element(here.begin(), here.begin() + static_cast<std::ptrdiff_t>(middle - range.begin), here.end(),
                         [axis](const Entry& a, const Entry& b) {
                             return std::pair(a.centre[axis], a.triangle) < std::pair(b.centre[axis], b.triangle);
                         });
    }

    std::span<Entry> entries_;
};

float small(double x) {
    constexpr double kMax = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(x, -kMax, kMax));
}

}  // namespace

TriangleTree::TriangleTree(std::span<const Vec3> points, std::span<const TriangleCorners> triangles, int threads)
    : points_(points), triangles_(triangles), order_(triangles.size()) {
    BigVector<Entry> entries(triangles.size());
    for_each_index(threads, triangles.size(), [&](std::size_t i) {
        const std::array<Vec3, 3> t = corners(static_cast<std::int64_t>(i));
        for (std::size_t k = 0; k < 3; ++k) entries[i].centre[k] = small(t[0][k] / 3 + t[1][k] / 3 + t[2][k] / 3);
        entries[i].triangle = static_cast<std::int64_t>(i);
    });
    levels_.emplace_back((triangles.size() + kLeaf - 1) / kLeaf);
    while (levels_.back().size() > 1) levels_.emplace_back((levels_.back().size() + 1) / 2);

    constexpr std::size_t kPart = 12;  // levels of a part that one thread halves
    Halving halving(entries);
    const std::vector<Halving::Range> parts = halving.halve({0, entries.size(), levels_.size() - 1}, kPart);
    for_each_block(threads, static_cast<std::int64_t>(parts.size()), [&](std::int64_t i) { halving.halve(parts[i], 0); });

    for_each_index(threads, levels_[0].size(), [&](std::size_t leaf) {
        BoundingBox box;
        const std::size_t end = std::min(entries.size(), (leaf + 1) * kLeaf);
        for (std::size_t i = leaf * kLeaf; i < end; ++i) {
            order_[i] = entries[i].triangle;
            for (const Vec3& corner : corners(order_[i])) box.add(corner);
        }
        levels_[0][leaf] = box;
    });
    for (std::size_t level = 1; level < levels_.size(); ++level)
        for_each_index(threads, levels_[level].size(), [&](std::size_t i) {
            BoundingBox box = levels_[level - 1][2 * i];
            if (2 * i + 1 < levels_[level - 1].size()) box.add(levels_[level - 1][2 * i + 1]);
            levels_[level][i] = box;
        });
}

NearTriangle TriangleTree::nearest(const Vec3& p, NearTriangle known) const {
    struct Open {
        std::size_t level, number;
        double squared_distance;
    };
    std::array<Open, 2 * 64> open;  // at most one waits on each level
    std::size_t waiting = 0;
    if (!order_.empty()) open[waiting++] = {levels_.size() - 1, 0, 0};
    while (waiting > 0) {
        const Open node = open[--waiting];
        if (node.squared_distance >= known.nearest.squared_distance) continue;
        if (node.level == 0) {
            for (const std::int64_t triangle : leaf(node.number)) {
                const NearestPoint nearest = nearest_point(p, corners(triangle));
                if (nearest.squared_distance < known.nearest.squared_distance) known = {triangle, nearest};
            }
            continue;
        }
        const BigVector<BoundingBox>& below = levels_[node.level - 1];
        Open first{node.level - 1, 2 * node.number, below[2 * node.number].squared_distance(p)};
        if (first.number + 1 < below.size()) {
            Open second{first.level, first.number + 1, below[first.number + 1].squared_distance(p)};
            if (second.squared_distance < first.squared_distance) std::swap(first, second);
            open[waiting++] = second;
        }
        open[waiting++] = first;
    }
    return known;
}

}  // namespace isoatlas

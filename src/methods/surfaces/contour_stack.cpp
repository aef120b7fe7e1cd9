#include "methods/surfaces/contour_stack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "methods/surfaces/tiling.h"

namespace isoatlas {
namespace {

/// The edges of a polygon by rows of squares: few are looked at to tell what lies in it. An edge has the number of its first corner.
class EdgeRows {
public:
    EdgeRows() = default;
    explicit EdgeRows(const std::vector<Vec3>& corners) {
        const auto [low, high] = std::ranges::minmax(corners, {}, [](const Vec3& p) { return p[1]; });
        first_row_ = row_of(low[1]);
        first_.assign(static_cast<std::size_t>(row_of(high[1]) - first_row_) + 2, 0);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for_rows(corners, i, [&](std::size_t row) { ++first_[row + 1]; });
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        edges_.resize(first_.back());
        std::vector<std::size_t> next = first_;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for_rows(corners, i, [&](std::size_t row) { edges_[next[row]++] = i; });
        }
    }
    /// Those that reach the rows of y between two values; several rows: some more than once.
    [[nodiscard]] std::span<const std::size_t> between(double low, double high) const {
        const auto rows = std::ssize(first_) - 1;
        const std::int64_t begin = std::max<std::int64_t>(row_of(low) - first_row_, 0), end = std::min(row_of(high) - first_row_ + 1, rows);
        if (begin >= end) return {};
        const std::size_t first = first_[static_cast<std::size_t>(begin)], last = first_[static_cast<std::size_t>(end)];
        return std::span(edges_).subspan(first, last - first);
    }
    [[nodiscard]] std::int64_t bytes() const { return static_cast<std::int64_t>((first_.size() + edges_.size()) * sizeof(std::size_t)); }

private:
    static std::int64_t row_of(double y) { return static_cast<std::int64_t>(std::floor(y)); }
    template <class Visit>
    void for_rows(const std::vector<Vec3>& corners, std::size_t edge, const Visit& visit) const {
        const std::int64_t p = row_of(corners[edge][1]), q = row_of(corners[(edge + 1) % corners.size()][1]);
        for (std::int64_t row = std::min(p, q); row <= std::max(p, q); ++row) visit(static_cast<std::size_t>(row - first_row_));
    }

    std::int64_t first_row_ = 0;
    std::vector<std::size_t> first_, edges_;
};

/// A closed polygon with the High side on its left.
struct Contour {
    std::vector<Vec3> corners;         ///< voxel positions
    std::vector<std::int64_t> points;  ///< of the surface
    std::array<double, 2> low, high;   ///< bounding box in x and y
    bool is_hole;                      ///< turns clockwise
    EdgeRows rows;
};

double turning(const std::vector<Vec3>& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
        sum += p[0] * q[1] - p[1] * q[0];
    }
    return sum;
}

Contour contour_of(std::vector<Vec3> corners) {
    Contour contour{std::move(corners), {}, {}, {}, false, {}};
    contour.is_hole = turning(contour.corners) < 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto [low, high] = std::ranges::minmax(contour.corners, {}, [axis](const Vec3& p) { return p[axis]; });
        contour.low[axis] = low[axis], contour.high[axis] = high[axis];
    }
    contour.rows = EdgeRows(contour.corners);
    return contour;
}

/// Of slice z; samples outside of it are Low, so that all are closed.
std::vector<Contour> contours_of(const Volume& volume, std::int64_t z, double tau, const Context& context, ExtractionCost& cost) {
    const Extent& extent = volume.info.extent;
    const Surface curves = visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const auto slice = samples.subspan(static_cast<std::size_t>(z * extent.slice()), static_cast<std::size_t>(extent.slice()));
        ExtractOptions options;
        options.surface.normals = options.surface.ids = false;
        return extract(make_volume<T>({2, {extent.size[0], extent.size[1], 1}}, slice), tau, options, context);
    });
    cost.cells += (extent.size[0] + 1) * (extent.size[1] + 1);
    cost.active += std::ssize(curves.segments);  // a square with two counts twice
    std::vector<std::int64_t> next(curves.points.size(), -1);
    for (const auto& [from, to] : curves.segments) next[static_cast<std::size_t>(from)] = to;
    std::vector<Contour> contours;
    for (std::size_t first = 0; first < next.size(); ++first) {
        std::vector<Vec3> corners;
        for (std::size_t at = first; next[at] >= 0;) {
            corners.push_back({curves.points[at][0], curves.points[at][1], static_cast<double>(z)});
            at = static_cast<std::size_t>(std::exchange(next[at], -1));
        }
        if (corners.size() >= 3) contours.push_back(contour_of(std::move(corners)));
    }
    return contours;
}

std::int64_t bytes_of(const std::vector<Contour>& contours) {
    std::size_t bytes = 0;
    for (const Contour& one : contours)
        bytes += sizeof(Contour) + one.corners.size() * (sizeof(Vec3) + sizeof(std::int64_t)) + static_cast<std::size_t>(one.rows.bytes());
    return static_cast<std::int64_t>(bytes);
}

bool is_inside(const Vec3& p, const Contour& polygon) {
    bool inside = false;
    for (const std::size_t i : polygon.rows.between(p[1], p[1])) {
        const Vec3 &q = polygon.corners[i], &r = polygon.corners[(i + 1) % polygon.corners.size()];
        if ((q[1] > p[1]) != (r[1] > p[1]) && p[0] < q[0] + (p[1] - q[1]) / (r[1] - q[1]) * (r[0] - q[0])) inside = !inside;
    }
    return inside;
}

bool is_in_box(const Vec3& p, const Contour& contour) {
    return contour.low[0] <= p[0] && p[0] <= contour.high[0] && contour.low[1] <= p[1] && p[1] <= contour.high[1];
}

bool overlap(const Contour& p, const Contour& q) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        if (p.low[axis] > q.high[axis] || q.low[axis] > p.high[axis]) return false;
    }
    const auto lies_in = [](const Contour& one, const Contour& other) {
        return std::ranges::any_of(one.rows.between(other.low[1], other.high[1]),
                                   [&](std::size_t i) { return is_in_box(one.corners[i], other) && is_inside(one.corners[i], other); });
    };
    return lies_in(p, q) || lies_in(q, p);
}

/// Numbers of a polygon of the lower slice, and of one of the upper slice.
using ContourPair = std::array<std::size_t, 2>;

/// All that turn the same way and overlap, in order. A sweep along y: in memory are those that reach it.
std::vector<ContourPair> overlapping(const std::vector<Contour>& lower, const std::vector<Contour>& upper) {
    const std::array<const std::vector<Contour>*, 2> both{&lower, &upper};
    struct Begin {
        double low;
        std::size_t slice, number;
        auto operator<=>(const Begin&) const = default;
    };
    std::vector<Begin> order;
    for (const std::size_t slice : {0, 1}) {
        for (std::size_t i = 0; i < both[slice]->size(); ++i) order.push_back({(*both[slice])[i].low[1], slice, i});
    }
    std::ranges::sort(order);
    std::array<std::array<std::vector<std::size_t>, 2>, 2> reached;  // of each slice, of each turn
    std::vector<ContourPair> pairs;
    for (const Begin& at : order) {
        const Contour& one = (*both[at.slice])[at.number];
        const std::vector<Contour>& others = *both[1 - at.slice];
        std::vector<std::size_t>& open = reached[1 - at.slice][one.is_hole ? 1 : 0];
        std::erase_if(open, [&](std::size_t other) { return others[other].high[1] < at.low; });
        for (const std::size_t other : open) {
            if (overlap(one, others[other])) pairs.push_back(at.slice == 0 ? ContourPair{at.number, other} : ContourPair{other, at.number});
        }
        reached[at.slice][one.is_hole ? 1 : 0].push_back(at.number);
    }
    std::ranges::sort(pairs);
    return pairs;
}

/// Of each polygon those with the kMostBranches largest: first of each of the lower slice, of these then of each of the upper one.
std::vector<ContourPair> largest_branches(std::vector<ContourPair> pairs, const std::vector<Contour>& lower,
                                          const std::vector<Contour>& upper) {
    for (const std::size_t side : {0, 1}) {
        const std::vector<Contour>& partners = side == 0 ? upper : lower;
        const auto size = [&](const ContourPair& pair) { return partners[pair[1 - side]].corners.size(); };
        std::ranges::sort(pairs, [&](const ContourPair& p, const ContourPair& q) {
            return std::tuple(p[side], size(q), p[1 - side]) < std::tuple(q[side], size(p), q[1 - side]);
        });
        std::vector<ContourPair> kept;
        std::int64_t branches = 0;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            branches = i > 0 && pairs[i][side] == pairs[i - 1][side] ? branches + 1 : 0;
            if (branches < kMostBranches) kept.push_back(pairs[i]);
        }
        pairs = std::move(kept);
    }
    std::ranges::sort(pairs);
    return pairs;
}

void add_points(std::vector<Contour>& contours, const Geometry& geometry, Surface& surface) {
    for (Contour& contour : contours) {
        for (const Vec3& corner : contour.corners) {
            contour.points.push_back(std::ssize(surface.points));
            surface.points.push_back(to_physical(geometry, corner));
        }
    }
}

/// Seen from outside the High side lies behind the strip: the lower polygon runs forwards along it.
void add_strip(const Contour& lower, const Contour& upper, Surface& surface) {
    const Strip strip = tile(lower.corners, upper.corners);
    std::size_t i = static_cast<std::size_t>(strip.start), j = 0;
    const std::size_t m = lower.points.size(), n = upper.points.size();
    for (const bool is_lower : strip.is_lower) {
        if (is_lower)
            surface.triangles.push_back({lower.points[i % m], lower.points[(i + 1) % m], upper.points[j % n]});
        else
            surface.triangles.push_back({lower.points[i % m], upper.points[(j + 1) % n], upper.points[j % n]});
        ++(is_lower ? i : j);
    }
}

}  // namespace

Extraction ConnectedContours::extract(double tau, const Context& context) const {
    Extraction result;
    std::vector<Contour> below;
    for (std::int64_t z = 0; z < volume_.info.extent.size[2]; ++z) {
        stop_if_cancelled(context);
        std::vector<Contour> contours = contours_of(volume_, z, tau, context, result.cost);
        add_points(contours, volume_.info.geometry, result.surface);
        for (const auto& [lower, upper] : largest_branches(overlapping(below, contours), below, contours))
            add_strip(below[lower], contours[upper], result.surface);
        result.cost.bytes = std::max(result.cost.bytes, bytes_of(below) + bytes_of(contours));
        below = std::move(contours);
    }
    return result;
}

}  // namespace isoatlas

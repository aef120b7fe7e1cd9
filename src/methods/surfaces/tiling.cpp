#include "methods/surfaces/tiling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace isoatlas {
namespace {

double triangle_area(const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 u{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v{r[0] - p[0], r[1] - p[1], r[2] - p[2]};
    const Vec3 normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]) / 2;  // std::hypot takes five times as long
}

double squared_distance(const Vec3& p, const Vec3& q) {
    return (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]);
}

/// A path through the grid. Rows go on behind the last corner: row m is corner 0 again.
struct Path {
    std::vector<std::int64_t> first, last;  ///< rows in each column
    Strip strip;
    double area = 0;

    [[nodiscard]] Path shifted(std::int64_t rows) const {
        Path path = *this;
        for (std::int64_t& row : path.first) row += rows;
        for (std::int64_t& row : path.last) row += rows;
        return path;
    }
};

/// Areas of all triangles with an edge of one polygon and a corner of the other.
class TriangleAreas {
public:
    TriangleAreas(std::span<const Vec3> lower, std::span<const Vec3> upper) : columns_(upper.size()) {
        on_lower_.reserve(lower.size() * upper.size()), on_upper_.reserve(lower.size() * upper.size());
        for (std::size_t i = 0; i < lower.size(); ++i) {
            const Vec3 &p = lower[i], &q = lower[(i + 1) % lower.size()];
            for (std::size_t j = 0; j < upper.size(); ++j) {
                const Vec3 &r = upper[j], &s = upper[(j + 1) % upper.size()];
                on_lower_.push_back(triangle_area(p, q, r));
                on_upper_.push_back(triangle_area(p, r, s));
            }
        }
    }
    /// Of the edge from corner i, and corner j of the upper polygon.
    [[nodiscard]] double on_lower(std::size_t i, std::size_t j) const { return on_lower_[i * columns_ + j]; }
    /// Of corner i of the lower polygon, and the edge from corner j.
    [[nodiscard]] double on_upper(std::size_t i, std::size_t j) const { return on_upper_[i * columns_ + j]; }

private:
    std::size_t columns_;
    std::vector<double> on_lower_, on_upper_;
};

class Grid {
public:
    Grid(std::span<const Vec3> lower, std::span<const Vec3> upper)
        : areas_(lower, upper), m_(std::ssize(lower)), n_(std::ssize(upper)), columns_(upper.size() + 1) {}

    [[nodiscard]] Strip best() {
        const auto first = std::make_shared<const Path>(path(0, nullptr, nullptr));
        struct Between {
            std::int64_t begin, end;  ///< starts
            std::shared_ptr<const Path> below, above;
        };
        Strip strip = first->strip;
        double area = first->area;
        std::vector<Between> open{{0, m_, first, std::make_shared<const Path>(first->shifted(m_))}};
        while (!open.empty()) {
            const Between between = open.back();
            open.pop_back();
            if (between.end - between.begin < 2) continue;
            const std::int64_t middle = (between.begin + between.end) / 2;
            const auto found = std::make_shared<const Path>(path(middle, between.below.get(), between.above.get()));
            if (found->area < area) strip = found->strip, area = found->area;
            open.push_back({between.begin, middle, between.below, found});
            open.push_back({middle, between.end, found, between.above});
        }
        return strip;
    }

private:
    [[nodiscard]] std::size_t corner_of(std::int64_t row) const { return static_cast<std::size_t>(row % m_); }

    /// Costs of a column: rows from `first` on, and whether the step to each came from the row before.
    struct Column {
        std::int64_t first = 0;
        std::vector<double> cost{};
        std::vector<char> from_row{};

        [[nodiscard]] bool has(std::int64_t row) const { return row >= first && row < first + std::ssize(cost); }
        [[nodiscard]] double at(std::int64_t row) const { return cost[static_cast<std::size_t>(row - first)]; }
    };

    /// The cheapest one from a start, between two others.
    [[nodiscard]] Path path(std::int64_t start, const Path* below, const Path* above) {
        for (std::int64_t j = 0; j <= n_; ++j) fill(j, start, below, above);
        return walk_back(start);
    }

    void fill(std::int64_t j, std::int64_t start, const Path* below, const Path* above) {
        const auto at = static_cast<std::size_t>(j);
        Column& column = columns_[at];
        column.cost.clear(), column.from_row.clear();
        const std::int64_t last = std::min(start + m_, above == nullptr ? start + m_ : above->last[at]);
        column.first = std::max(start, below == nullptr ? start : below->first[at]);
        for (std::int64_t row = column.first; row <= last; ++row) {
            double cost = j == 0 && row == start ? 0 : std::numeric_limits<double>::infinity();
            bool from_row = false;
            if (j > 0 && columns_[at - 1].has(row)) cost = columns_[at - 1].at(row) + areas_.on_upper(corner_of(row), at - 1);
            if (row > column.first) {
                const double along = column.cost.back() + areas_.on_lower(corner_of(row - 1), at < columns_.size() - 1 ? at : 0);
                if (along < cost) cost = along, from_row = true;
            }
            column.cost.push_back(cost);
            column.from_row.push_back(from_row ? 1 : 0);
        }
    }

    [[nodiscard]] Path walk_back(std::int64_t start) const {
        Path path;
        path.first.resize(columns_.size());
        path.last.resize(columns_.size());
        path.strip.start = start % m_;
        std::int64_t row = start + m_, j = n_;
        path.area = columns_.back().at(row);
        path.last.back() = row;
        while (row > start || j > 0) {
            const auto at = static_cast<std::size_t>(j);
            const bool from_row = columns_[at].from_row[static_cast<std::size_t>(row - columns_[at].first)] != 0;
            path.strip.is_lower.push_back(from_row);
            if (from_row) {
                --row;
                continue;
            }
            path.first[at] = row;
            path.last[at - 1] = row;
            --j;
        }
        path.first[0] = start;
        std::reverse(path.strip.is_lower.begin(), path.strip.is_lower.end());
        return path;
    }

    TriangleAreas areas_;
    std::int64_t m_, n_;
    std::vector<Column> columns_;  ///< of the path that is being found
};

/// From the closest pair of corners with corner 0 of the upper polygon.
Strip by_shorter_diagonals(std::span<const Vec3> lower, std::span<const Vec3> upper) {
    Strip strip;
    const auto m = std::ssize(lower), n = std::ssize(upper);
    const auto closest = std::ranges::min_element(lower, {}, [&](const Vec3& p) { return squared_distance(p, upper[0]); });
    strip.start = closest - lower.begin();
    for (std::int64_t i = 0, j = 0; i < m || j < n;) {
        const auto at = [&](std::int64_t row) -> const Vec3& { return lower[static_cast<std::size_t>((strip.start + row) % m)]; };
        const auto above = [&](std::int64_t column) -> const Vec3& { return upper[static_cast<std::size_t>(column % n)]; };
        const bool is_lower = j == n || (i < m && squared_distance(at(i + 1), above(j)) <= squared_distance(at(i), above(j + 1)));
        strip.is_lower.push_back(is_lower);
        ++(is_lower ? i : j);
    }
    return strip;
}

}  // namespace

Strip tile(std::span<const Vec3> lower, std::span<const Vec3> upper) {
    if (std::ssize(lower) * std::ssize(upper) > kMaxOptimalGrid) return by_shorter_diagonals(lower, upper);
    return Grid(lower, upper).best();
}

double area_of(const Strip& strip, std::span<const Vec3> lower, std::span<const Vec3> upper) {
    double sum = 0;
    std::size_t i = static_cast<std::size_t>(strip.start), j = 0;
    for (const bool is_lower : strip.is_lower) {
        const Vec3 &p = lower[i % lower.size()], &q = upper[j % upper.size()];
        sum += is_lower ? triangle_area(p, lower[(i + 1) % lower.size()], q) : triangle_area(p, q, upper[(j + 1) % upper.size()]);
        ++(is_lower ? i : j);
    }
    return sum;
}

}  // namespace isoatlas

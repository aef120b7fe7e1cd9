#include "isoatlas/print.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "isoatlas/error.h"

namespace isoatlas {
namespace {

using Point = std::array<double, 3>;

/// Piece of every point: points that triangles join.
class Pieces {
public:
    explicit Pieces(const Surface& surface) : parent_(surface.points.size()) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        for (const auto& t : surface.triangles) {
            unite(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]));
            unite(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[2]));
        }
    }
    [[nodiscard]] std::size_t of(std::size_t point) {
        while (parent_[point] != point) point = parent_[point] = parent_[parent_[point]];
        return point;
    }

private:
    void unite(std::size_t a, std::size_t b) {
        a = of(a), b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    std::vector<std::size_t> parent_;
};

/// Six times the volume between a triangle and a point.
double signed_volume(const Point& a, const Point& b, const Point& c, const Point& from) {
    Point u, v, w;
    for (std::size_t i = 0; i < 3; ++i) u[i] = a[i] - from[i], v[i] = b[i] - from[i], w[i] = c[i] - from[i];
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

void check(const Surface& surface, const PrintOptions& options) {
    const bool is_solid = surface.segments.empty() && surface.closed;
    if (!is_solid)
        throw Error(ErrorKind::usage, {.where = "the surface",
                                       .what = surface.closed ? "curves cannot be printed" : "an open surface encloses nothing to print",
                                       .expected = "closed triangles"});
    if (!(options.millimetres > 0) || !std::isfinite(options.millimetres) || !(options.speck >= 0 && options.speck <= 1))
        throw Error(ErrorKind::usage, {.where = "PrintOptions", .what = "a length or a part that is not possible"});
}

/// Volume of every piece, at its first point.
std::vector<double> volumes(const Surface& surface, Pieces& pieces) {
    std::vector<double> volume(surface.points.size(), 0);
    for (const auto& t : surface.triangles) {
        const std::size_t piece = pieces.of(static_cast<std::size_t>(t[0]));
        const auto point = [&](std::size_t c) -> const Point& { return surface.points[static_cast<std::size_t>(t[c])]; };
        volume[piece] += signed_volume(point(0), point(1), point(2), surface.points[piece]) / 6;
    }
    for (double& v : volume) v = std::abs(v);
    return volume;
}

template <class Values>
void keep(Values& values, const std::vector<std::int64_t>& place) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] >= 0) values[static_cast<std::size_t>(place[i])] = values[i];
    }
    values.resize(static_cast<std::size_t>(std::ranges::count_if(place, [](std::int64_t p) { return p >= 0; })));
}

void drop(Surface& surface, Pieces& pieces, const std::vector<double>& volume, double min) {
    std::vector<std::int64_t> place(surface.points.size(), -1);
    std::int64_t next = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (volume[pieces.of(i)] >= min) place[i] = next++;
    }
    std::size_t kept = 0;
    for (const auto& t : surface.triangles) {
        if (place[static_cast<std::size_t>(t[0])] < 0) continue;
        surface.triangles[kept++] = {place[static_cast<std::size_t>(t[0])], place[static_cast<std::size_t>(t[1])],
                                     place[static_cast<std::size_t>(t[2])]};
    }
    surface.triangles.resize(kept);
    keep(surface.points, place);
    keep(surface.normals, place);
    keep(surface.object, place);
    keep(surface.contour, place);
}

}  // namespace

PrintReport prepare_for_print(Surface& surface, const PrintOptions& options) {
    check(surface, options);
    PrintReport report;
    if (surface.triangles.empty()) return report;
    Pieces pieces(surface);
    const std::vector<double> volume = volumes(surface, pieces);
    const double min = options.speck * *std::ranges::max_element(volume), cube = std::pow(options.millimetres, 3);
    for (std::size_t i = 0; i < volume.size(); ++i) {
        if (pieces.of(i) != i) continue;
        if (volume[i] >= min) {
            ++report.pieces, report.volume += volume[i] * cube;
        } else {
            ++report.specks, report.largest_speck = std::max(report.largest_speck, volume[i] * cube);
        }
    }
    drop(surface, pieces, volume, min);
    constexpr double far = std::numeric_limits<double>::infinity();
    Point low{far, far, far}, high{-far, -far, -far};
    for (Point& p : surface.points) {
        for (std::size_t a = 0; a < 3; ++a) {
            p[a] *= options.millimetres;
            low[a] = std::min(low[a], p[a]), high[a] = std::max(high[a], p[a]);
        }
    }
    for (std::size_t a = 0; a < 3; ++a) report.size_mm[a] = high[a] - low[a];
    surface.unit = "mm";
    return report;
}

}  // namespace isoatlas

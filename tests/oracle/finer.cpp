#include "oracle/finer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "isoatlas/analysis.h"
#include "oracle/compare.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::Interpolant;

double interpolated(const Grid& grid, const std::array<Index, 3>& cell, const std::array<double, 3>& t) {
    double sum = 0;
    for (int k = 0; k < 8; ++k) {
        double weight = 1;
        for (int a = 0; a < 3; ++a) weight *= (k >> a & 1) != 0 ? t[a] : 1 - t[a];
        sum += weight * grid.value[grid.index(cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2))];
    }
    return sum;
}

/// Objects, chi, tunnels and cavities at an isovalue.
std::array<Index, 4> numbers_at(const Analysis& analysis, double tau) {
    std::array<Index, 4> sum{};
    for (const isoatlas::EventId e : isoatlas::ids<isoatlas::EventId>(analysis.event_count())) {
        const isoatlas::Event event = analysis.event(e);
        if (!(event.zone.tau_low < tau && tau <= event.zone.tau_high)) continue;
        const std::array<Index, 4> object{1, event.chi, event.b1, event.b2};
        for (int i = 0; i < 4; ++i) sum[i] += object[i];
    }
    return sum;
}

std::string text(const std::array<Index, 4>& numbers) {
    std::string result;
    for (const Index n : numbers) result += " " + std::to_string(n);
    return result;
}

/// Samples at planes between those of the grid: plane p of an axis lies in cell p.cell at p.t.
struct Plane {
    Index cell;
    double t;
};
using Planes = std::array<std::vector<Plane>, 3>;

Grid sampled(const Grid& grid, const Planes& planes) {
    Grid result{3, {}, {}};
    for (int a = 0; a < 3; ++a) result.size[a] = static_cast<Index>(planes[a].size());
    for (const Plane& z : planes[2]) {
        for (const Plane& y : planes[1]) {
            for (const Plane& x : planes[0]) result.value.push_back(interpolated(grid, {x.cell, y.cell, z.cell}, {x.t, y.t, z.t}));
        }
    }
    return result;
}

std::vector<Plane> regular_planes(Index cells, Index steps) {
    std::vector<Plane> planes{{0, 0}};
    for (Index cell = 0; cell < cells; ++cell) {
        for (Index i = 1; i <= steps; ++i) planes.push_back({cell, static_cast<double>(i) / static_cast<double>(steps)});
    }
    return planes;
}

/// Where in a cell the planes x = constant have a bilinear saddle whose value is stationary: the saddles of the cell are there.
/// f = k0 + k1 x + k2 y + k3 z + k4 xy + k5 xz + k6 yz + k7 xyz; the saddle's value is k0 + k1 x - (k2 + k4 x)(k3 + k5 x) / (k6 + k7 x).
std::vector<double> saddle_planes(const Grid& grid, const std::array<Index, 3>& cell) {
    const auto at = [&](int k) -> long double {
        return grid.value[grid.index(cell[0] + (k & 1), cell[1] + (k >> 1 & 1), cell[2] + (k >> 2))];
    };
    const long double k1 = at(1) - at(0), k2 = at(2) - at(0), k3 = at(4) - at(0), k4 = at(3) - at(1) - at(2) + at(0),
                      k5 = at(5) - at(1) - at(4) + at(0), k6 = at(6) - at(2) - at(4) + at(0),
                      k7 = at(7) - at(6) - at(5) - at(3) + at(4) + at(2) + at(1) - at(0);
    const long double p = k7 * (k1 * k7 - k4 * k5), q = k6 * (k1 * k7 - k4 * k5), r = k6 * (k1 * k6 - k3 * k4 - k2 * k5) + k7 * k2 * k3;
    std::vector<double> planes;  // p x^2 + 2 q x + r = 0
    const auto add = [&](long double x) {
        if (x > 0 && x < 1) planes.push_back(static_cast<double>(x));
    };
    if (q * q - p * r < 0) return planes;
    const long double root = -(q + std::copysign(std::sqrt(q * q - p * r), q));
    if (p != 0) add(root / p);
    if (root != 0) add(r / root);
    return planes;
}

}  // namespace

Grid finer(const Grid& grid, Index steps) {
    Planes planes;
    for (int a = 0; a < 3; ++a) planes[a] = regular_planes(grid.size[a] - 1, steps);
    return sampled(grid, planes);
}

Grid cut_at_saddles(const Grid& grid) {
    Planes planes;
    for (int a = 0; a < 3; ++a) planes[a] = regular_planes(grid.size[a] - 1, 1);
    for (Index z = 0; z + 1 < grid.size[2]; ++z) {
        for (Index y = 0; y + 1 < grid.size[1]; ++y) {
            for (Index x = 0; x + 1 < grid.size[0]; ++x) {
                for (const double t : saddle_planes(grid, {x, y, z})) planes[0].push_back({x, t});
            }
        }
    }
    const auto key = [](const Plane& p) { return std::pair(p.cell, p.t); };
    std::sort(planes[0].begin(), planes[0].end(), [&](const Plane& p, const Plane& q) { return key(p) < key(q); });
    const auto equal = [&](const Plane& p, const Plane& q) { return key(p) == key(q); };
    planes[0].erase(std::unique(planes[0].begin(), planes[0].end(), equal), planes[0].end());
    return sampled(grid, planes);
}

FinerComparison compare_with_finer(const Grid& grid, const Grid& fine_grid, double gap) {
    isoatlas::Context context;
    context.threads = 1;
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    const Analysis trilinear = isoatlas::analyse(volume, {.interpolant = Interpolant::trilinear}, context);
    const Analysis faces = isoatlas::analyse(volume, {.interpolant = Interpolant::faces}, context);
    const isoatlas::Volume fine_volume = to_volume(fine_grid, isoatlas::ValueType::f64);
    const Analysis fine = isoatlas::analyse(fine_volume, {.interpolant = Interpolant::faces}, context);
    std::vector<double> critical;
    for (const isoatlas::ElementId e : isoatlas::ids<isoatlas::ElementId>(fine.element_count())) critical.push_back(fine.element(e).value);
    std::sort(critical.begin(), critical.end());
    FinerComparison result;
    for (std::size_t c = 0; c + 1 < critical.size(); ++c) {
        if (critical[c + 1] - critical[c] < gap) continue;
        const double tau = (critical[c] + critical[c + 1]) / 2;
        const std::array<Index, 4> truth = numbers_at(fine, tau), found = numbers_at(trilinear, tau);
        ++result.isovalues;
        result.faces_differ += numbers_at(faces, tau) != truth;
        if (found != truth && result.difference.empty()) {
            result.difference =
                "objects, chi, tunnels, cavities at " + std::to_string(tau) + ":" + text(found) + ", in truth" + text(truth);
        }
    }
    return result;
}

}  // namespace oracle

#include "oracle/finer.h"

#include <algorithm>

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
    for (Index e = 0; e < analysis.event_count(); ++e) {
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

}  // namespace

Grid finer(const Grid& grid, Index steps) {
    Grid result{3, {}, {}};
    for (int a = 0; a < 3; ++a) result.size[a] = (grid.size[a] - 1) * steps + 1;
    for (Index v = 0; v < result.voxels(); ++v) {
        const std::array<Index, 3> p = result.voxel(v);
        std::array<Index, 3> cell{};
        std::array<double, 3> t{};
        for (int a = 0; a < 3; ++a) {
            cell[a] = std::min(p[a] / steps, grid.size[a] - 2);
            t[a] = static_cast<double>(p[a] - cell[a] * steps) / static_cast<double>(steps);
        }
        result.value.push_back(interpolated(grid, cell, t));
    }
    return result;
}

FinerComparison compare_with_finer(const Grid& grid, Index steps, double gap) {
    isoatlas::Context context;
    context.threads = 1;
    const isoatlas::Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    const Analysis trilinear = isoatlas::analyse(volume, {.interpolant = Interpolant::trilinear}, context);
    const Analysis faces = isoatlas::analyse(volume, {.interpolant = Interpolant::faces}, context);
    const isoatlas::Volume fine_volume = to_volume(finer(grid, steps), isoatlas::ValueType::f64);
    const Analysis fine = isoatlas::analyse(fine_volume, {.interpolant = Interpolant::faces}, context);
    std::vector<double> critical;
    for (Index e = 0; e < fine.element_count(); ++e) critical.push_back(fine.element(e).value);
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

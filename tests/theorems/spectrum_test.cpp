// The spectrum is what a cut finds at every isovalue, and its sizes are those of the surfaces.
#include "isoatlas/spectrum.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <set>

#include "isoatlas/active.h"
#include "isoatlas/objects.h"
#include "isoatlas/phantom.h"
#include "oracle/difference.h"
#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::Analysis;
using isoatlas::Cut;
using isoatlas::LevelCounts;
using isoatlas::Spectrum;
using isoatlas::SpectrumInterval;
using isoatlas::SpectrumSize;
using isoatlas::Surface;
using isoatlas::Volume;

LevelCounts sum_of(const Cut& cut, const std::set<Index>& chosen) {
    LevelCounts counts;
    for (const Index i : chosen) {
        const isoatlas::CutObject& object = cut.objects[static_cast<std::size_t>(i)];
        ++counts.objects;
        counts.contours += object.contour_count, counts.tunnels += object.b1, counts.cavities += object.b2;
    }
    return counts;
}

LevelCounts all_of(const Cut& cut) {
    std::set<Index> all;
    for (std::size_t i = 0; i < cut.objects.size(); ++i) all.insert(static_cast<Index>(i));
    return sum_of(cut, all);
}

/// The objects that contain the maximum at which a branch of the table begins, while the branch is there.
LevelCounts significant_of(const Cut& cut, const Volume& volume, const Analysis& analysis, const isoatlas::ObjectTable& table) {
    std::set<Index> objects;
    std::map<isoatlas::EventId, bool> alive;
    for (const isoatlas::ObjectEntry& entry : table.entries) {
        const isoatlas::Event top = analysis.event(entry.branch_top);
        RC_ASSERT(top.value == entry.appears);
        const Index voxel = volume.info.extent.index(static_cast<Index>(top.position[0]), static_cast<Index>(top.position[1]),
                                                     static_cast<Index>(top.position[2]));
        if (!(entry.merges < cut.tau && cut.tau <= entry.appears)) continue;
        objects.insert(cut.label[static_cast<std::size_t>(voxel)]);
        alive[entry.branch_top] = true;
    }
    RC_ASSERT(objects.size() == alive.size());  // no two branches in one object
    return sum_of(cut, objects);
}

void check_intervals(const Spectrum& spectrum) {
    for (std::size_t i = 0; i + 1 < spectrum.intervals.size(); ++i) {
        RC_ASSERT(spectrum.intervals[i].low == spectrum.intervals[i + 1].high);
        RC_ASSERT(spectrum.intervals[i].low < spectrum.intervals[i].high);
    }
    RC_ASSERT(spectrum.intervals.back().low == -kInfinity);
}

void the_spectrum_is_what_a_cut_finds_at_every_isovalue() {
    const Grid grid = *arbitrary_grid(7, 160);
    const isoatlas::Interpolant interpolant = *arbitrary_interpolant();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const Analysis analysis = isoatlas::analyse(volume, {.interpolant = interpolant});
    std::optional<isoatlas::Selection> selection;
    if (*rc::gen::arbitrary<bool>()) selection = isoatlas::Selection{.keep = *rc::gen::inRange<std::int64_t>(1, 6)};
    const Spectrum spectrum = isoatlas::spectrum(volume, analysis, {.samples = 0, .selection = selection});
    const isoatlas::ObjectTable table = isoatlas::rank_objects(volume, analysis, {.top = 0, .selection = selection});
    RC_ASSERT(spectrum.sizes.empty());
    RC_ASSERT(spectrum.selected == selection.has_value());
    RC_ASSERT(spectrum.advice.size() == table.isovalues.size());
    for (const isoatlas::SpectrumAdvice& advice : spectrum.advice) {
        const std::vector<isoatlas::ActiveObject> there = isoatlas::ActiveIndex(analysis).at(advice.tau).objects;
        RC_ASSERT(std::ranges::any_of(there, [&](const isoatlas::ActiveObject& object) { return object.id == advice.object; }));
    }
    check_intervals(spectrum);
    for (const double tau : interesting_values(elements_of(grid, interpolant))) {
        const Cut cut = isoatlas::cut(volume, tau, {.interpolant = interpolant, .label = true});
        const SpectrumInterval at = isoatlas::counts_at(spectrum, tau);
        RC_ASSERT(at.low < tau);
        RC_ASSERT(tau <= at.high);
        RC_ASSERT(at.all == all_of(cut));
        RC_ASSERT(at.significant == significant_of(cut, volume, analysis, table));
    }
}

double length(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Heron's formula; segments have a length.
double area_of(const Surface& surface) {
    const auto distance = [&](Index p, Index q) {
        std::array<double, 3> d{};
        for (std::size_t a = 0; a < 3; ++a)
            d[a] = surface.points[static_cast<std::size_t>(p)][a] - surface.points[static_cast<std::size_t>(q)][a];
        return length(d);
    };
    double area = 0;
    for (const auto& t : surface.triangles) {
        const double a = distance(t[0], t[1]), b = distance(t[1], t[2]), c = distance(t[2], t[0]), s = (a + b + c) / 2;
        area += std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
    }
    for (const auto& s : surface.segments) area += distance(s[0], s[1]);
    return area;
}

RC_GTEST_FIXTURE_PROP(Stores, MeasureTheSpectrumOfTheirVolume, ()) {
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    isoatlas::build_atlas(path_, volume);
    const Analysis analysis = isoatlas::analyse(volume);
    const Spectrum direct = isoatlas::spectrum(volume, analysis, {.samples = 4}, arbitrary_context());
    const Spectrum stored = isoatlas::spectrum(isoatlas::Atlas(path_), {.samples = 4}, arbitrary_context());
    RC_ASSERT(direct.sizes.size() == stored.sizes.size());
    RC_ASSERT(direct.intervals.size() == stored.intervals.size());
    for (std::size_t i = 0; i < direct.intervals.size(); ++i) {
        RC_ASSERT(direct.intervals[i].all == stored.intervals[i].all);
        RC_ASSERT(direct.intervals[i].significant == stored.intervals[i].significant);
    }
    for (std::size_t i = 0; i < direct.sizes.size(); ++i) {
        const SpectrumSize &size = direct.sizes[i], &other = stored.sizes[i];
        const Cut cut = isoatlas::cut(volume, size.tau);
        const Surface surface = isoatlas::extract(volume, size.tau);
        Index voxels = 0;
        for (const auto& object : cut.objects) voxels += object.voxels;
        RC_ASSERT(size.voxels.min == voxels);
        RC_ASSERT(size.voxels.max == voxels);
        RC_ASSERT(other.voxels.min <= voxels);
        RC_ASSERT(voxels <= other.voxels.max);
        RC_ASSERT(size.cells == cut.active_cells);
        RC_ASSERT(size.facets == static_cast<Index>(surface.triangles.size() + surface.segments.size()));
        RC_ASSERT(std::abs(size.area - area_of(surface)) <= 1e-6 * (1 + size.area));
        RC_ASSERT(size.measure >= 0);
        RC_ASSERT(size.tau == other.tau);
        RC_ASSERT(size.cells == other.cells);
        RC_ASSERT(size.facets == other.facets);
        RC_ASSERT(size.area == other.area);
        RC_ASSERT(size.measure == other.measure);
    }
}

TEST(TheSpectrum, MeasuresABall) {
    Volume volume = isoatlas::make_volume({3, {41, 41, 41}}, isoatlas::ValueType::f32, {});
    volume.info.geometry.spacing = {0.5, 0.5, 0.5};
    auto* samples = reinterpret_cast<float*>(volume.bytes.data());
    for (Index v = 0; v < volume.info.extent.voxels(); ++v) {
        const auto p = volume.info.extent.voxel(v);
        samples[v] = static_cast<float>(20 - std::sqrt(std::pow(p[0] - 20, 2) + std::pow(p[1] - 20, 2) + std::pow(p[2] - 20, 2)));
    }
    const Spectrum spectrum = isoatlas::spectrum(volume, isoatlas::analyse(volume), {.samples = 50});
    int measured = 0;
    for (const SpectrumSize& size : spectrum.sizes) {
        const double radius = (20 - size.tau) / 2, pi = std::acos(-1);
        if (radius < 3 || radius > 9.5) continue;  // few samples; cut off by the border
        EXPECT_NEAR(size.area / (4 * pi * radius * radius), 1, 0.02) << radius;
        EXPECT_NEAR(size.measure / (4 * pi / 3 * radius * radius * radius), 1, 0.02) << radius;
        ++measured;
    }
    EXPECT_GT(measured, 10);
}

RC_GTEST_PROP(TheSpectrum, IsWhatACutFindsAtEveryIsovalue, ()) { the_spectrum_is_what_a_cut_finds_at_every_isovalue(); }

}  // namespace
}  // namespace oracle

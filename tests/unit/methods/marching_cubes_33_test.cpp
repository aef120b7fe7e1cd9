// Marching Cubes 33 joins in every cell what the trilinear interpolant joins; its triangles may meet where they should not.
#include "methods/surfaces/marching_cubes_33.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>

#include "isoatlas/surface_defects.h"
#include "isoatlas/surface_methods.h"
#include "oracle/mesh_checks.h"
#include "oracle/tunnels.h"
#include "unit/methods/generic_tau.h"

namespace oracle {
namespace {

using isoatlas::CellSections;
using isoatlas::Surface;
using isoatlas::SurfaceMethod;
using isoatlas::SurfaceReport;
using Corners = std::array<double, 8>;

isoatlas::Volume volume_of(std::array<Index, 3> size, const std::vector<double>& values) {
    return isoatlas::make_volume<double>({3, {size[0], size[1], size[2]}}, values);
}
isoatlas::Volume cell_of(const Corners& values) { return volume_of({2, 2, 2}, {values.begin(), values.end()}); }

Surface extract_by(SurfaceMethod method, const isoatlas::Volume& volume, double tau) {
    return isoatlas::make_extractor(method, volume)->extract(tau).surface;
}
SurfaceReport report_of(const Surface& surface) { return isoatlas::inspect(surface.points, surface.triangles); }
std::vector<Index> euler_numbers(const SurfaceReport& report) {
    std::vector<Index> chi = report.component_chi;
    std::ranges::sort(chi);
    return chi;
}

/// How corners lie beside the isovalue 0: at random, many near it, few values, orders of magnitude apart.
enum class Spread { even, near, few, wide };

Corners random_cell(int pattern, Spread spread, std::mt19937_64& random) {
    std::uniform_real_distribution<double> part(0, 1);
    Corners values;
    for (std::size_t k = 0; k < 8; ++k) {
        double away = part(random);
        if (spread == Spread::near) away = away * away * away * away;
        if (spread == Spread::few) away = std::floor(4 * away);
        if (spread == Spread::wide) away = std::exp(20 * away);
        const bool is_high = (pattern >> k & 1) != 0;
        values[k] = is_high ? away : -away - (spread == Spread::few ? 1 : 0);  // 0 is High
    }
    return values;
}

/// All 256 patterns: the same components with the same Euler numbers and rims; a manifold.
TEST(MarchingCubes33, HasTheTopologyOfTheTrilinearInterpolantInEveryCell) {
    std::mt19937_64 random(33);
    Index tubes = 0, otherwise = 0;
    for (const Spread spread : {Spread::even, Spread::near, Spread::few, Spread::wide}) {
        for (int trial = 0; trial < 40 * 256; ++trial) {
            const isoatlas::Volume cell = cell_of(random_cell(trial % 256, spread, random));
            const SurfaceReport found = report_of(extract_by(SurfaceMethod::marching_cubes_33, cell, 0));
            const SurfaceReport expected = report_of(extract_by(SurfaceMethod::trilinear, cell, 0));
            ASSERT_EQ(euler_numbers(found), euler_numbers(expected)) << trial;
            ASSERT_EQ(found.boundary_edges, expected.boundary_edges) << trial;
            ASSERT_TRUE(found.is_manifold() && found.is_oriented()) << trial;
            tubes += std::ranges::count(found.component_chi, 0);
            const SurfaceReport decider = report_of(extract_by(SurfaceMethod::asymptotic_decider, cell, 0));
            otherwise += euler_numbers(decider) != euler_numbers(expected) ? 1 : 0;
        }
    }
    EXPECT_GT(tubes, 300);
    EXPECT_EQ(otherwise, tubes);  // the decider alone misses exactly these
}

/// The proof in interior_test.h: one axis is enough, and no other one says anything else. A tunnel of Highs closes at the highest isovalue
/// of its life, one of Lows at the lowest; at the other end a face joins what it joins.
TEST(MarchingCubes33, TheInteriorTestIsTheSameAlongEveryAxis) {
    std::mt19937_64 random(34);
    for (int shape = 0; shape < 6; ++shape) {
        for (int trial = 0; trial < 100; ++trial) {
            const bool joins_highs = trial % 2 == 0;
            const TunnelSample sample = random_tunnel(shape, joins_highs, random);
            for (const double part : {0.001, 0.1, 0.5, 0.9, 0.999, 1.001}) {
                const double life = sample.high - sample.low;
                const double tau = joins_highs ? sample.low + part * life : sample.high - part * life;
                Corners values = sample.value;
                for (double& value : values) value -= tau;
                for (int axis = 0; axis < 3; ++axis) {
                    const CellSections sections(values, axis);
                    const bool is_joined = sections.joins(0).has_value() || sections.joins(1).has_value();
                    ASSERT_EQ(is_joined, part < 1) << kTunnelShapes[static_cast<std::size_t>(shape)] << " " << part;
                }
            }
        }
    }
}

/// Two Highs at the ends of a diagonal of the cell: the decider keeps them apart, the inside joins them (case 4.1.2).
TEST(MarchingCubes33, SeesATunnelThatFacesDoNotShow) {
    const isoatlas::Volume cell = cell_of({9, -1, -1, -1, -1, -1, -1, 9});
    EXPECT_EQ(report_of(extract_by(SurfaceMethod::asymptotic_decider, cell, 0)).component_chi, (std::vector<Index>{1, 1}));
    EXPECT_EQ(report_of(extract_by(SurfaceMethod::marching_cubes_33, cell, 0)).component_chi, std::vector<Index>{0});
    EXPECT_EQ(report_of(extract_by(SurfaceMethod::trilinear, cell, 0)).component_chi, std::vector<Index>{0});
}

/// What it leaves: tubes of neighbours with triangles in their common face. The product gives tubes points of their own.
TEST(MarchingCubes33, TubesOfTwoCellsMayHaveEdgesWithFourTriangles) {
    const isoatlas::Volume cells = volume_of({3, 2, 2}, {1, 1, 1, 1, 0, 1, -1, 0, -1, 0, 1, 0});
    const Surface surface = extract_by(SurfaceMethod::marching_cubes_33, cells, 0.5);
    EXPECT_EQ(report_of(surface).non_manifold_edges, 2);
    EXPECT_EQ(std::ssize(isoatlas::find_defects(surface, cells.info).hole_edges), 0);
    EXPECT_EQ(report_of(extract_by(SurfaceMethod::trilinear, cells, 0.5)).non_manifold_edges, 0);
}

/// What it leaves: a tube whose triangles cross.
TEST(MarchingCubes33, TrianglesOfATubeMayCross) {
    const isoatlas::Volume cell = cell_of({0, 2, 2, 0, -1, -1, -1, 1});
    EXPECT_GT(count_crossings(extract_by(SurfaceMethod::marching_cubes_33, cell, 0.5)), 0);
    EXPECT_EQ(count_crossings(extract_by(SurfaceMethod::trilinear, cell, 0.5)), 0);
}

RC_GTEST_PROP(MarchingCubes33Of, AnyVolumeHasTheComponentsOfTheTrilinearInterpolant, ()) {
    Grid grid = *arbitrary_grid(5, 60);
    grid.rank = 3;
    const isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    const std::optional<double> tau = generic_tau(grid);
    if (!tau) return;
    const Surface surface = extract_by(SurfaceMethod::marching_cubes_33, volume, *tau);
    const SurfaceReport found = report_of(surface), expected = report_of(extract_by(SurfaceMethod::trilinear, volume, *tau));
    RC_ASSERT(std::ssize(isoatlas::find_defects(surface, volume.info).hole_edges) == 0);
    RC_ASSERT(found.component_chi.size() == expected.component_chi.size());
    if (found.non_manifold_edges == 0) RC_ASSERT(euler_numbers(found) == euler_numbers(expected));
}

}  // namespace
}  // namespace oracle

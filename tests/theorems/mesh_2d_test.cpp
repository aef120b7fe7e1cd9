// 2D: level curves are closed, oriented polylines, one per contour of the cut, Highs on the left.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "isoatlas/cut.h"
#include "isoatlas/surface.h"
#include "oracle/mesh_checks.h"

namespace oracle {
namespace {

using isoatlas::Boundary;
using isoatlas::Surface;

Grid arbitrary_image() {
    const std::array<Index, 3> size{*rc::gen::inRange<Index>(1, 9), *rc::gen::inRange<Index>(1, 9), 1};
    const auto raw = *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(size[0] * size[1]),
                                                           rc::gen::resize(100, rc::gen::inRange(0, 10000)));
    return make_grid(2, size, static_cast<Texture>(*rc::gen::inRange(0, kTextures)), raw);
}

/// How many segments start and end at every point.
std::vector<std::array<int, 2>> ends_of(const Surface& surface) {
    std::vector<std::array<int, 2>> ends(surface.points.size());
    for (const auto& s : surface.segments) {
        ++ends[s[0]][0];
        ++ends[s[1]][1];
    }
    return ends;
}

void mesh2d_curves_are_the_contours_of_the_cut() {
    const Grid grid = arbitrary_image();
    const Elements elements(grid);
    isoatlas::Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    volume.info.geometry.origin[2] = 0;
    const double tau = arbitrary_tau(elements);
    const Surface surface = isoatlas::extract(volume, tau, {}, arbitrary_context());
    const isoatlas::Cut cut = isoatlas::cut(volume, tau);
    RC_ASSERT(surface.triangles.empty());
    RC_ASSERT(surface.normals.size() == surface.points.size());
    for (const auto& [out, in] : ends_of(surface)) RC_ASSERT(out == 1 && in == 1);
    for (const isoatlas::Vec3& p : surface.points) RC_ASSERT(p[2] == 0);

    std::vector<Index> next(surface.points.size());
    for (const auto& s : surface.segments) next[s[0]] = s[1];
    std::map<Index, double> area;
    std::map<Index, Index> first, hits, curves, object_of;
    std::vector<bool> seen(next.size());
    for (std::size_t start = 0; start < next.size(); ++start) {
        if (seen[start]) continue;
        ++curves[surface.contour[start]];
        for (auto i = static_cast<Index>(start); !seen[i]; i = next[i]) {
            seen[i] = true;
            RC_ASSERT(surface.contour[i] == surface.contour[start] && surface.object[i] == surface.object[start]);
            const Vector p = between(surface.points[start], surface.points[i]), q = between(surface.points[start], surface.points[next[i]]);
            area[surface.contour[start]] += p.x * q.y - p.y * q.x;
            ++hits[surface.contour[start]];
        }
    }
    for (const isoatlas::CutContour& contour : cut.contours) {
        RC_ASSERT(curves[contour.id] == 1);
        RC_ASSERT(hits[contour.id] == contour.hits);
        RC_ASSERT((contour.shell == isoatlas::Shell::outer ? area[contour.id] : -area[contour.id]) > 0);
        object_of[contour.id] = contour.object;
    }
    RC_ASSERT(curves.size() == cut.contours.size());
    for (std::size_t i = 0; i < next.size(); ++i) RC_ASSERT(object_of[surface.contour[i]] == surface.object[i]);
}

void mesh2d_open_curves_end_at_the_border() {
    const Grid grid = arbitrary_image();
    const Elements elements(grid);
    const isoatlas::ExtractOptions options{.surface = {.boundary = Boundary::open, .objects = {}, .contours = {}}};
    const Surface surface = isoatlas::extract(to_volume(grid), arbitrary_tau(elements), options, arbitrary_context());
    if (grid.size[0] == 1 || grid.size[1] == 1) {
        RC_ASSERT(surface.points.empty() && surface.segments.empty());
        return;
    }
    const std::vector<std::array<int, 2>> ends = ends_of(surface);
    for (std::size_t i = 0; i < ends.size(); ++i) {
        bool on_border = false;
        for (int a = 0; a < 2; ++a) on_border |= surface.points[i][a] == 0 || surface.points[i][a] == static_cast<double>(grid.size[a] - 1);
        RC_ASSERT(ends[i][0] + ends[i][1] == (on_border ? 1 : 2));
    }
}

RC_GTEST_PROP(Mesh2d, CurvesAreTheContoursOfTheCut, ()) { mesh2d_curves_are_the_contours_of_the_cut(); }
RC_GTEST_PROP(Mesh2d, OpenCurvesEndAtTheBorder, ()) { mesh2d_open_curves_end_at_the_border(); }

}  // namespace
}  // namespace oracle

// Every front of an octree mesh, of cells of any levels and of eighths of them, is a surface with the contours of the exact one, embedded,
// within its distance.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "isoatlas/error.h"
#include "isoatlas/octree_mesh.h"
#include "oracle/coarse_surfaces.h"

namespace oracle {
namespace {

using isoatlas::OctreeFragment;
using isoatlas::OctreeMesh;
using isoatlas::OctreeOptions;
using isoatlas::Vec3;
using Place = std::array<std::int64_t, 3>;

/// What a viewer shows: cells, or eighths of them, of any levels, every place once.
class Front {
public:
    Front(const OctreeMesh& mesh, const CoarseCase& c, std::mt19937_64& random) : mesh_(mesh), case_(c), random_(random) {
        surface.closed = c.exact.closed;
        const std::size_t top = mesh.levels.size() - 1;
        for (const OctreeFragment& fragment : mesh.levels[top].fragments) show(top, fragment.place);
    }
    Surface surface;
    double distance = 0;

private:
    bool chance(double probability) { return static_cast<double>(random_() >> 11) * 0x1p-53 < probability; }

    [[nodiscard]] const OctreeFragment* find(std::size_t level, const Place& place) const {
        const auto& fragments = mesh_.levels[level].fragments;
        const auto found = std::ranges::find(fragments, place, &OctreeFragment::place);
        return found == fragments.end() ? nullptr : &*found;
    }

    void show(std::size_t level, const Place& place) {
        const OctreeFragment* const fragment = find(level, place);
        if (fragment == nullptr) return;
        if (level == 0 || chance(0.4)) {
            for (const auto& t : fragment->triangles) add(level, *fragment, t);
            return;
        }
        for (std::int64_t i = 0; i < 8; ++i) {
            const Place child{2 * place[0] + i % 2, 2 * place[1] + i / 2 % 2, 2 * place[2] + i / 4};
            if (chance(0.7)) {
                show(level - 1, child);
                continue;
            }
            for (const auto& t : fragment->triangles) {
                if (eighth_of(level, *fragment, t) == child) add(level, *fragment, t);
            }
        }
    }

    /// The cell of the level below in which a triangle lies.
    [[nodiscard]] Place eighth_of(std::size_t level, const OctreeFragment& fragment, const std::array<std::uint32_t, 3>& t) const {
        const double edge = static_cast<double>(mesh_.edge << level) / 2;
        Place place{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double middle = (fragment.points[t[0]][axis] + fragment.points[t[1]][axis] + fragment.points[t[2]][axis]) / 3;
            const std::int64_t least = 2 * fragment.place[axis];
            const std::int64_t last =
                std::max<std::int64_t>(0, (case_.volume.info.extent.size[axis] - 2) / static_cast<std::int64_t>(edge));
            place[axis] = std::clamp(static_cast<std::int64_t>(std::floor((middle + 5e-6) / edge)), least,
                                     std::max(least, std::min(least + 1, last)));
            for (const std::uint32_t corner : t) {  // no triangle crosses a face between cells of the level below
                const double at = fragment.points[corner][axis] / edge - static_cast<double>(place[axis]);
                RC_ASSERT(at > -1e-5 || place[axis] == 0);
                RC_ASSERT(at < 1 + 1e-5 || place[axis] == last);
            }
        }
        return place;
    }

    void add(std::size_t level, const OctreeFragment& fragment, const std::array<std::uint32_t, 3>& t) {
        std::array<std::int64_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& p = fragment.points[t[i]];
            const auto [found, is_new] = points_.try_emplace(p, static_cast<std::int64_t>(surface.points.size()));
            if (is_new) surface.points.push_back(to_physical(case_.volume.info.geometry, p));
            corners[i] = found->second;
        }
        surface.triangles.push_back(corners);
        distance = std::max(distance, mesh_.levels[level].distance);
    }

    const OctreeMesh& mesh_;
    const CoarseCase& case_;
    std::mt19937_64& random_;
    std::map<Vec3, std::int64_t> points_;
};

OctreeOptions arbitrary_octree() {
    OctreeOptions options;
    options.edge = *rc::gen::element(1, 2, 3, 4);
    options.first_distance = *rc::gen::element(0.01, 0.1, 1.0);
    return options;
}

bool is_even(const CoarseCase& c) {
    return std::ranges::all_of(c.volume.info.geometry.coordinates, [](const auto& axis) { return axis.empty(); });
}

OctreeMesh octree_of(const CoarseCase& c, const OctreeOptions& options, const isoatlas::Context& context = {}) {
    return make_octree_mesh(c.exact, c.volume.info.geometry, c.volume.info.extent, options, context);
}

void every_front_has_the_same_contours_within_its_distance() {
    const CoarseCase c;
    RC_PRE(is_even(c) && !c.exact.triangles.empty());
    const OctreeMesh mesh = octree_of(c, arbitrary_octree(), arbitrary_context());
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    for (int i = 0; i < 3; ++i) {
        const Front front(mesh, c, random);
        const std::string failure = coarse_failure(front.surface, c.exact, c.volume.info, {front.distance});
        if (!failure.empty()) RC_FAIL(failure);
    }
}

void octrees_have_the_same_bytes_for_any_threads() {
    const CoarseCase c;
    RC_PRE(is_even(c));
    const OctreeOptions options = arbitrary_octree();
    const OctreeMesh one = octree_of(c, options, {.threads = 1}), two = octree_of(c, options, {.threads = 2});
    RC_ASSERT(one.levels.size() == two.levels.size());
    for (std::size_t k = 0; k < one.levels.size(); ++k) {
        RC_ASSERT(one.levels[k].distance == two.levels[k].distance);
        RC_ASSERT(one.levels[k].fragments.size() == two.levels[k].fragments.size());
        for (std::size_t i = 0; i < one.levels[k].fragments.size(); ++i) {
            const OctreeFragment &a = one.levels[k].fragments[i], &b = two.levels[k].fragments[i];
            RC_ASSERT((a.place == b.place && a.points == b.points && a.triangles == b.triangles));
        }
    }
}

TEST(OctreeMeshes, GetCoarserWithEachLevel) {
    const isoatlas::Volume volume = volume_of(kShapes[5]);
    const Surface exact = isoatlas::extract(volume, kShapes[5].tau);
    const OctreeMesh mesh = make_octree_mesh(exact, volume.info.geometry, volume.info.extent, {.edge = 16});
    ASSERT_GE(mesh.levels.size(), 3U);
    EXPECT_EQ(mesh.levels.back().fragments.size(), 1U);
    std::size_t before = 2 * exact.triangles.size();
    for (const isoatlas::OctreeLevel& level : mesh.levels) {
        std::size_t triangles = 0;
        for (const OctreeFragment& fragment : level.fragments) triangles += fragment.triangles.size();
        EXPECT_LT(triangles, before);
        before = triangles;
    }
    EXPECT_LT(before, exact.triangles.size() / 8);
}

TEST(OctreeMeshes, RefuseWhatHasNoOctree) {
    const isoatlas::Volume volume = volume_of(kShapes[5]);
    const Surface exact = isoatlas::extract(volume, kShapes[5].tau);
    const auto refused = [&](const Surface& surface, const isoatlas::Geometry& geometry, const OctreeOptions& options) {
        try {
            (void)make_octree_mesh(surface, geometry, volume.info.extent, options);
        } catch (const isoatlas::Error& error) {
            return error.kind();
        }
        return isoatlas::ErrorKind::cancelled;
    };
    EXPECT_EQ(refused(exact, volume.info.geometry, {.edge = 0}), isoatlas::ErrorKind::usage);
    EXPECT_EQ(refused(exact, volume.info.geometry, {.first_distance = 0}), isoatlas::ErrorKind::usage);
    isoatlas::Geometry uneven = volume.info.geometry;
    for (int i = 0; i < 40; ++i) uneven.coordinates[0].push_back(i * i);
    EXPECT_EQ(refused(exact, uneven, {}), isoatlas::ErrorKind::unsupported);
    const isoatlas::SimplifiedSurface simplified = simplify_surface(exact, volume.info.geometry, volume.info.extent, {.max_distance = 1});
    EXPECT_EQ(refused(simplified.surface, volume.info.geometry, {.edge = 8}), isoatlas::ErrorKind::usage);
}

RC_GTEST_PROP(OctreeMeshes, EveryFrontHasTheSameContoursWithinItsDistance, ()) { every_front_has_the_same_contours_within_its_distance(); }
RC_GTEST_PROP(OctreeMeshes, HaveTheSameBytesForAnyThreads, ()) { octrees_have_the_same_bytes_for_any_threads(); }

}  // namespace
}  // namespace oracle

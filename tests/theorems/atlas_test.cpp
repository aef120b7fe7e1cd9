// From a store come the same answers as from the volume, to the last byte, whatever was read before; and only what is needed is read.
#include "isoatlas/atlas.h"
#include "isoatlas/build.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "atlas/access.h"
#include "bricks/stored_samples.h"
#include "field/brick_grid.h"
#include "isoatlas/phantom.h"
#include "mesh/extract_level.h"
#include "oracle/difference.h"
#include "oracle/stores.h"
#include "store/brick_writer.h"

namespace oracle {
namespace {

using isoatlas::Atlas;
using isoatlas::Surface;
using isoatlas::Volume;

std::string text(const isoatlas::Cut& cut) {
    std::ostringstream out;
    out.precision(17);
    out << cut.tau << ' ' << cut.active_cells << '\n';
    for (const auto& o : cut.objects) {
        out << o.id << ' ' << o.chi << ' ' << o.b1 << ' ' << o.b2 << ' ' << o.voxels << ' ' << o.measure << ' ' << join(o.box_low)
            << join(o.box_high) << o.first_contour << ' ' << o.contour_count << '\n';
    }
    for (const auto& c : cut.contours)
        out << c.id << ' ' << c.object << ' ' << static_cast<int>(c.shell) << ' ' << c.genus << ' ' << c.hits << '\n';
    for (const auto label : cut.label) out << label << ' ';
    return out.str();
}

RC_GTEST_FIXTURE_PROP(Stores, GiveTheSameCutsAndSurfaces, ()) {
    const Grid grid = arbitrary_volume();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant()};
    isoatlas::build_atlas(path_, volume, options, arbitrary_context());
    const Atlas atlas(path_, {.cache_bytes = *rc::gen::element<std::int64_t>(0, 1, 9000, 100000)});
    for (int query = 0; query < 6; ++query) {
        double tau = grid.value[*rc::gen::inRange<std::size_t>(0, grid.value.size())];
        if (*rc::gen::inRange(0, 2) == 0) tau += 0.25;
        const isoatlas::CutOptions cut{.interpolant = options.interpolant, .label = true};
        RC_ASSERT(text(atlas.cut(tau, {.label = true}, arbitrary_context())) == text(isoatlas::cut(volume, tau, cut)));
        isoatlas::SurfaceOptions extract;
        extract.style = *rc::gen::element(isoatlas::SurfaceStyle::compact, isoatlas::SurfaceStyle::full);
        extract.boundary = *rc::gen::element(isoatlas::Boundary::closed, isoatlas::Boundary::open);
        extract.shell = *rc::gen::element(isoatlas::ShellChoice::all, isoatlas::ShellChoice::outer, isoatlas::ShellChoice::inner);
        extract.ids = *rc::gen::inRange(0, 2) == 0;
        RC_ASSERT(same(atlas.extract(tau, extract, arbitrary_context()),
                       isoatlas::extract(volume, tau, {.interpolant = options.interpolant, .surface = extract})));
        if (*rc::gen::inRange(0, 4) == 0) atlas.clear_cache();
    }
    RC_ASSERT(atlas.volume().bytes == volume.bytes);
}

// Names come from bricks too: a store of bricks alone answers all but the trees.
TEST_F(Stores, NeedNoTreesForCutsAndSurfaces) {
    const std::vector<std::pair<const char*, isoatlas::PhantomOptions>> examples{
        {"random-field", {.size = 90, .noise = 0.1, .quantise = 8}},
        {"random-field", {.size = 90, .noise = 0.02}},
        {"nested-shells", {.size = 110}}};
    for (const auto& [name, options] : examples) {
        const Volume volume = isoatlas::make_phantom(name, options);
        isoatlas::Contents contents;
        contents.volume = volume.info;
        isoatlas::pack_store(path_, contents, isoatlas::brick_arrays(volume, {}));
        const Atlas atlas(path_);
        const std::array<double, 2> range = atlas.range();
        for (const double part : {0.0, 0.2, 0.5, 0.7, 1.0}) {
            const double tau = range[0] + part * (range[1] - range[0]);
            EXPECT_EQ(text(atlas.cut(tau)), text(isoatlas::cut(volume, tau))) << name << ' ' << tau;
            EXPECT_TRUE(same(atlas.extract(tau), isoatlas::extract(volume, tau))) << name << ' ' << tau;
        }
        EXPECT_THROW((void)atlas.analysis(), isoatlas::Error);
    }
}

// One object from the bricks around it: every object of a cut, or some of many.
void check_objects(const Atlas& atlas, const Volume& volume, double tau, isoatlas::SurfaceOptions options) {
    const isoatlas::Cut cut = isoatlas::cut(volume, tau);
    const std::size_t step = std::max<std::size_t>(1, cut.objects.size() / 6);
    for (std::size_t i = 0; i < cut.objects.size(); i += step) {
        options.objects = {cut.objects[i].id};
        ASSERT_TRUE(same(atlas.extract(tau, options), isoatlas::extract(volume, tau, {.surface = options})))
            << "object " << cut.objects[i].id;
        // Without ids others are left out, where whole bricks lie between.
        isoatlas::SurfaceOptions alone = options;
        alone.ids = false;
        for (int more = 0; more < 2; ++more) {
            ASSERT_TRUE(same(atlas.extract(tau, alone), isoatlas::extract(volume, tau, {.surface = alone})))
                << more << " beside object " << cut.objects[i].id;
            alone.objects.push_back(cut.objects[(i + step) % cut.objects.size()].id);
        }
    }
}

TEST_F(Stores, GiveTheSameObjects) {
    struct Example {
        const char* phantom;
        isoatlas::PhantomOptions options;
        std::vector<double> isovalues;
    };
    const std::vector<Example> examples{{"noise", {.size = 70}, {0.9, 0.99}},
                                        {"random-field", {.size = 90, .noise = 0.1, .quantise = 64}, {20, 40, 45.5, 60}},
                                        {"nested-shells", {.size = 80}, {0.5}}};
    for (const Example& example : examples) {
        Volume volume = isoatlas::make_phantom(example.phantom, example.options);
        volume.info.geometry.spacing = {0.7, 0.7, 1.3};
        volume.info.geometry.origin = {-100.1, 20.3, 7};
        isoatlas::build_atlas(path_, volume);
        for (const double tau : example.isovalues) {
            for (const isoatlas::ShellChoice shell : {isoatlas::ShellChoice::all, isoatlas::ShellChoice::inner}) {
                isoatlas::SurfaceOptions options;
                options.shell = shell;
                ASSERT_NO_FATAL_FAILURE(check_objects(Atlas(path_), volume, tau, options));
            }
        }
    }
}

TEST_F(Stores, ReadForASmallObjectOnlyWhatIsAroundIt) {
    const Volume volume = isoatlas::make_phantom("random-field", {.size = 128, .noise = 0.1, .quantise = 256});
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Cut cut = isoatlas::cut(volume, 200);
    ASSERT_GT(cut.objects.size(), 10U);
    const Atlas atlas(path_);
    isoatlas::SurfaceOptions options;
    options.objects = {cut.objects.back().id};  // the smallest
    EXPECT_FALSE(atlas.extract(200, options).points.empty());
    EXPECT_LE(atlas.reads().bricks, 64);  // of 512
}

/// A rod through the volume, and balls at its corners: no brick of theirs touches one of the rod.
Volume rod_and_balls(std::int64_t size) {
    std::vector<float> samples;
    const double near = static_cast<double>(size) / 6, far = 5 * near;
    for (std::int64_t i = 0; i < size * size * size; ++i) {
        const double x = static_cast<double>(i % size), y = static_cast<double>(i / size % size), z = static_cast<double>(i / size / size);
        const auto away = [&](double at_x, double at_y, double at_z) { return std::hypot(x - at_x, y - at_y, z - at_z); };
        const double along = (x + y + z) / 3;
        const double balls = std::min({away(far, near, near), away(near, far, near), away(near, near, far)});
        samples.push_back(static_cast<float>(std::max(4 - away(along, along, along), 16 - balls)));
    }
    return isoatlas::make_volume<float>({3, {size, size, size}}, samples);
}

TEST_F(Stores, ReadForALongObjectOnlyWhatIsJoinedWithIt) {
    const std::int64_t size = 96;
    const Volume volume = rod_and_balls(size);
    isoatlas::build_atlas(path_, volume);
    isoatlas::SurfaceOptions rod;
    rod.objects = {(size + 1) * size * size / 2 + size / 2};
    rod.ids = false;
    isoatlas::QueryCost whole, alone, front;
    const Surface expected = isoatlas::extract(volume, 1, {.surface = rod});
    (void)Atlas(path_).extract(1, {}, {}, &whole);
    EXPECT_TRUE(same(Atlas(path_).extract(1, rod, {}, &alone), expected));
    (void)Atlas(path_).extract_front(1, {}, rod, {}, &front);
    EXPECT_FALSE(expected.points.empty());
    EXPECT_LT(2 * alone.bricks, whole.bricks);
    EXPECT_EQ(front.bricks, alone.bricks);
}

/// A surface of some objects alone, of the bricks that region growing finds.
Surface of_region(const Atlas& atlas, double tau, const isoatlas::SurfaceOptions& options, isoatlas::ObjectBricks& bricks) {
    isoatlas::StoredSamples& samples = isoatlas::AtlasAccess::samples(atlas);
    isoatlas::LevelQuery query;
    bricks = samples.bricks_of_objects(tau, options.objects, {}, query, 0);
    isoatlas::StoredLevel level = samples.classify(tau, bricks.bricks, {}, query);
    samples.add_extremes(level.bricks, {});
    const auto sample = [&](std::int64_t voxel) { return samples.sample(voxel, query); };
    return isoatlas::extract_level({samples.view(), tau, level.high, &level.bricks, {}, sample},
                                   {.interpolant = atlas.interpolant(), .surface = options}, {});
}

RC_GTEST_FIXTURE_PROP(Stores, GiveTheSameObjectsByRegionGrowing, ()) {
    const isoatlas::PhantomOptions field{.size = *rc::gen::inRange<std::int64_t>(40, 72),
                                         .seed = *rc::gen::inRange<std::uint64_t>(1, 1000),
                                         .noise = *rc::gen::element(0.0, 0.05, 0.2),
                                         .quantise = *rc::gen::inRange<std::int64_t>(3, 40)};
    const Volume volume = isoatlas::make_phantom("random-field", field);
    const isoatlas::AnalysisOptions how{.interpolant = *arbitrary_interpolant()};
    isoatlas::build_atlas(path_, volume, how);
    const Atlas atlas(path_);
    for (int query = 0; query < 3; ++query) {
        const double tau = static_cast<double>(*rc::gen::inRange<std::int64_t>(1, field.quantise)) - *rc::gen::element(0.0, 0.5);
        const isoatlas::Cut cut = isoatlas::cut(volume, tau, {.interpolant = how.interpolant});
        if (cut.objects.empty()) continue;
        isoatlas::SurfaceOptions options;
        options.ids = false;
        options.shell = *rc::gen::element(isoatlas::ShellChoice::all, isoatlas::ShellChoice::outer, isoatlas::ShellChoice::inner);
        for (int i = *rc::gen::inRange(1, 3); i > 0; --i)
            options.objects.push_back(cut.objects[*rc::gen::inRange<std::size_t>(0, cut.objects.size())].id);
        if (*rc::gen::inRange(0, 2) == 0) atlas.clear_cache();
        isoatlas::ObjectBricks bricks;
        RC_ASSERT(same(of_region(atlas, tau, options, bricks),
                       isoatlas::extract(volume, tau, {.interpolant = how.interpolant, .surface = options})));
        RC_CLASSIFY(bricks.is_tight);
    }
}

/// A helix up to z = height among balls: every brick has a part of a ball.
Volume helix_and_balls(std::int64_t size, double height) {
    std::vector<float> samples;
    const double middle = static_cast<double>(size) / 2;
    for (std::int64_t i = 0; i < size * size * size; ++i) {
        const double x = static_cast<double>(i % size), y = static_cast<double>(i / size % size), z = static_cast<double>(i / size / size);
        const double turn = z / 40;
        const double above = std::max(z - height, 0.0);
        const double helix = std::hypot(x - middle - 0.7 * middle * std::cos(turn), y - middle - 0.7 * middle * std::sin(turn), above);
        const auto to_ball = [](double at) { return std::abs(std::remainder(at - 4, 8)); };
        const double ball = std::hypot(to_ball(x), to_ball(y), to_ball(z));
        samples.push_back(static_cast<float>(std::max(4 - helix, helix < 9 ? -9 : 3 - ball)));
    }
    return isoatlas::make_volume<float>({3, {size, size, size}}, samples);
}

TEST_F(Stores, ReadForALongObjectOnlyWhereItIs) {
    for (const double height : {144.0, 50.0}) {  // its box is the volume, or less than half of it
        const Volume volume = helix_and_balls(144, height);
        isoatlas::build_atlas(path_, volume);
        const isoatlas::Cut cut = isoatlas::cut(volume, 1.5);
        const auto helix = std::ranges::max_element(cut.objects, {}, &isoatlas::CutObject::voxels);
        isoatlas::SurfaceOptions options;
        options.objects = {helix->id};
        options.ids = false;
        isoatlas::QueryCost whole, alone;
        (void)Atlas(path_).extract(1.5, {}, {}, &whole);
        EXPECT_TRUE(same(Atlas(path_).extract(1.5, options, {}, &alone), isoatlas::extract(volume, 1.5, {.surface = options})));
        EXPECT_LT(4 * alone.bricks, whole.bricks);
    }
}

RC_GTEST_FIXTURE_PROP(Stores, GiveTheSameTrees, ()) {
    const Grid grid = *arbitrary_grid(6, 120);
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const isoatlas::AnalysisOptions options{.interpolant = *arbitrary_interpolant()};
    isoatlas::build_atlas(path_, volume, options);
    const isoatlas::Analysis expected = isoatlas::analyse(volume, options), actual = Atlas(path_).analysis();
    RC_ASSERT(canonical_text(actual) == canonical_text(expected));
    RC_ASSERT(actual.element_count() == expected.element_count());
    for (const isoatlas::EventId e : isoatlas::ids<isoatlas::EventId>(expected.event_count())) {
        RC_ASSERT(actual.event(e).zone.voxels == expected.event(e).zone.voxels);
        RC_ASSERT(actual.event(e).position == expected.event(e).position);
    }
}

TEST_F(Stores, AnswerManyQueriesAtOnce) {
    const Volume volume = isoatlas::make_phantom("random-field", {.size = 64, .noise = 0.1, .quantise = 64});
    isoatlas::build_atlas(path_, volume);
    std::vector<Surface> expected;
    for (int i = 0; i < 12; ++i) expected.push_back(isoatlas::extract(volume, 5 * i + 3));
    const Atlas atlas(path_);
    std::atomic<int> wrong = 0;
    ask_at_once([&](int asker, const isoatlas::Context& context) {
        for (int i = 0; i < 12; ++i) {
            const int which = (i * 5 + asker * 3) % 12;
            wrong += same(atlas.extract(5 * which + 3, {}, context), expected[static_cast<std::size_t>(which)]) ? 0 : 1;
        }
    });
    EXPECT_EQ(wrong, 0);
}

TEST_F(Stores, ReadOnlyTheBricksOfTheSurface) {
    const Volume volume = isoatlas::make_phantom("nested-shells", {.size = 160});
    isoatlas::build_atlas(path_, volume);
    const Atlas atlas(path_);
    EXPECT_EQ(atlas.reads().bytes, 0);
    const double tau = 0.5;
    const Surface surface = atlas.extract(tau);
    EXPECT_TRUE(same(surface, isoatlas::extract(volume, tau)));
    const isoatlas::AtlasReads first = atlas.reads();
    EXPECT_LT(first.bricks, 2400);  // of 4000
    const Surface again = atlas.extract(tau);
    EXPECT_TRUE(same(surface, again));
    EXPECT_EQ(atlas.reads().bytes, first.bytes);  // nothing is read twice
}

/// The bricks that a surface may need, each a flag: those that tau divides, and those with a sample of the other class in a cell with one
/// of theirs, or two steps away (the end of an edge, and the neighbour that its normal looks at). Outside of the volume everything is Low.
std::vector<bool> bricks_near_surface(const Grid& grid, double tau) {
    const isoatlas::BrickGrid bricks({grid.rank, {grid.size}});
    const auto is_high = [&](Index x, Index y, Index z) {
        return grid.contains({x, y, z}) && grid.value[static_cast<std::size_t>(grid.index(x, y, z))] >= tau;
    };
    const Index flat = grid.rank == 2 ? 0 : 2;
    std::vector<bool> near(static_cast<std::size_t>(bricks.count()));
    for (Index b = 0; b < bricks.count(); ++b) {
        const isoatlas::Box box = bricks.box(isoatlas::BrickId(b));
        const bool first = is_high(box.begin[0], box.begin[1], box.begin[2]);
        for (Index z = box.begin[2] - flat; z < box.end[2] + flat; ++z) {
            for (Index y = box.begin[1] - 2; y < box.end[1] + 2; ++y) {
                for (Index x = box.begin[0] - 2; x < box.end[0] + 2; ++x) {
                    const std::array<Index, 3> at{x, y, z};
                    Index steps = 0, max = 0;
                    for (int axis = 0; axis < 3; ++axis) {
                        const Index away = std::max<Index>({0, box.begin[axis] - at[axis], at[axis] - box.end[axis] + 1});
                        steps += away, max = std::max(max, away);
                    }
                    if (steps <= 2 || max <= 1) near[b] = near[b] || is_high(x, y, z) != first;
                }
            }
        }
    }
    return near;
}

RC_GTEST_FIXTURE_PROP(Stores, ReadTheBricksNearTheSurfaceOnce, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, isoatlas::ValueType::f64);
    isoatlas::Contents contents;
    contents.volume = volume.info;
    isoatlas::pack_store(path_, contents, isoatlas::brick_arrays(volume, {}));
    const Atlas atlas(path_);
    std::vector<bool> near;
    for (int query = 0; query < 4; ++query) {
        const double tau = grid.value[*rc::gen::inRange<std::size_t>(0, grid.value.size())] + *rc::gen::element(0, 0.25);
        (void)atlas.extract(tau, {}, arbitrary_context());
        const std::vector<bool> now = bricks_near_surface(grid, tau);
        near.resize(now.size());
        for (std::size_t b = 0; b < now.size(); ++b) near[b] = near[b] || now[b];
        RC_ASSERT(atlas.reads().bricks <= std::count(near.begin(), near.end(), true));
    }
}

TEST_F(Stores, OfTheSameVolumeHaveTheSameBytes) {
    const Volume volume = isoatlas::make_phantom("noise", {.size = 40});
    std::string first;
    for (const int threads : {1, 2, 3}) {
        isoatlas::Context context;
        context.threads = threads;
        context.slab_slices = threads;
        isoatlas::build_atlas(path_, volume, {}, context);
        std::ifstream file(path_, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        if (first.empty()) first = bytes;
        EXPECT_TRUE(bytes == first);
        std::this_thread::sleep_for(std::chrono::milliseconds(700));  // no time of day may be in it
    }
}

}  // namespace
}  // namespace oracle

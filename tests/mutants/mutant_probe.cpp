// A fixed, quick set of the suite's properties: exits 0 when all hold, 1 with the first difference. run_mutants.py links it against
// libraries with one deliberate bug each and demands that it fails.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "atlas/build_fingerprint.h"
#include "base/atomic_file.h"
#include "base/temporary_name.h"
#include "bricks/brick_classes.h"
#include "bricks/region_growing.h"
#include "isoatlas/error.h"
#include "isoatlas/surface.h"
#include "isoatlas/verify.h"
#include "mutants/coarser_surfaces.h"
#include "mutants/damaged_inputs.h"
#include "oracle/bodies.h"
#include "oracle/brick_scene.h"
#include "oracle/compare.h"
#include "oracle/finer.h"
#include "oracle/volumes.h"
#include "server/request_head.h"
#include "tree/predicates.h"

namespace {

using isoatlas::Interpolant;
using oracle::Index;

[[noreturn]] void fail(const std::string& what, const oracle::Grid& grid) {
    std::ostringstream text;
    text << what << "\n  " << grid << '\n';
    std::fputs(text.str().c_str(), stdout);
    std::exit(1);
}

double signed_volume(const isoatlas::Surface& surface) {
    double volume = 0;
    for (const auto& t : surface.triangles) {
        const auto &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return volume / 6;
}

void check_surface(const oracle::Elements& elements, const isoatlas::Volume& volume, double tau, Interpolant interpolant) {
    isoatlas::ExtractOptions options;
    options.interpolant = interpolant;
    const isoatlas::Surface surface = isoatlas::extract(volume, tau, options);
    const isoatlas::SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
    const bool sound = report.is_closed() && report.is_manifold() && report.is_oriented() && report.has_no_zero_area();
    if (!sound) fail("the surface is not closed, manifold, oriented and free of slivers", elements.grid);
    const oracle::Snapshot s = oracle::snapshot(elements, elements.cut_at(tau));
    std::vector<Index> expected, actual(report.component_chi.begin(), report.component_chi.end());
    for (const oracle::Contour& contour : s.contours) expected.push_back(2 - 2 * contour.genus);
    std::sort(expected.begin(), expected.end());
    std::sort(actual.begin(), actual.end());
    if (expected != actual) fail("the surface's components are not the contours", elements.grid);
    if (!s.objects.empty() && !(signed_volume(surface) > 0)) fail("the normals point to higher values", elements.grid);
}

/// uint8 where it holds the values, else float64.
isoatlas::ValueType type_for(const oracle::Grid& grid) {
    for (const double v : grid.value) {
        if (v != std::floor(v) || v < 0 || v > 255) return isoatlas::ValueType::f64;
    }
    return isoatlas::ValueType::u8;
}

void check_volume(const oracle::Grid& grid, Interpolant interpolant, bool with_surface) {
    const oracle::Elements elements = oracle::elements_of(grid, interpolant);
    const oracle::Result expected = oracle::analyse(elements);
    if (!expected.consistent) fail("the oracle contradicts the theory", grid);
    const isoatlas::Volume volume = oracle::to_volume(grid, type_for(grid));
    isoatlas::Context context;
    context.threads = 1;
    context.slab_slices = 1;
    const std::string difference = oracle::compare(expected, isoatlas::analyse(volume, {.interpolant = interpolant}, context));
    if (!difference.empty()) fail(difference, grid);
    const std::vector<double> values = oracle::interesting_values(elements);
    const std::size_t step = std::max<std::size_t>(1, values.size() / 6);
    for (std::size_t i = 0; i < values.size(); i += step) {
        const isoatlas::CutOptions options{.interpolant = interpolant, .label = true};
        const std::string cut = oracle::compare_cut(elements, values[i], isoatlas::cut(volume, values[i], options, context));
        if (!cut.empty()) fail(cut, grid);
        if (with_surface && grid.rank == 3) check_surface(elements, volume, values[i], interpolant);
    }
}

void check_interior(const oracle::Grid& grid) {
    const isoatlas::Volume volume = oracle::to_volume(grid, type_for(grid));
    isoatlas::Context context;
    context.threads = 1;
    for (const isoatlas::CheckResult& check :
         isoatlas::verify_volume(volume, {.levels = 8, .interpolant = isoatlas::Interpolant::trilinear}, context)) {
        if (!check.holds) fail(check.name + ": " + check.detail, grid);
    }
}

/// Files of the user that are in the way of outputs.
void check_outputs() {
    namespace fs = std::filesystem;
    using isoatlas::AtomicFile;
    const oracle::Grid none{};
    std::string folder = (fs::temp_directory_path() / "isoatlas_probe_XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr) fail("no temporary folder", none);
    const std::string path = folder + "/x", precious = folder + "/precious", left = folder + "/" + isoatlas::temporary_name();
    const auto expect = [&](bool holds, const char* what) {
        if (holds) return;
        fs::remove_all(folder);
        fail(what, none);
    };
    const auto is_refused = [&] {
        try {
            AtomicFile file(path);
            return false;
        } catch (const isoatlas::Error&) {
            return true;
        }
    };
    std::ofstream(precious) << "precious";
    fs::create_symlink("nowhere", path);
    expect(is_refused(), "a link to nowhere is written through");
    expect(isoatlas::system_files().create(path, 0666).error == -EEXIST && !fs::exists(folder + "/nowhere"), "create() follows a link");
    fs::remove(path);
    fs::create_hard_link(precious, left);
    {
        AtomicFile file(path);
        file.write("new");
        expect(!fs::exists(path), "an unfinished file has its name");
        file.commit();
    }
    expect(fs::file_size(path) == 3 && fs::exists(left), "a file with another name is tidied up");
    fs::permissions(path, fs::perms::owner_read);
    expect(is_refused(), "a read-only file is replaced");
    fs::remove_all(folder);
}

/// What a stranger may send is bounded, and says one thing.
void check_requests() {
    using isoatlas::HeadReader;
    const auto is_let_in = [](const std::string& fields) {
        HeadReader reader;
        std::string bytes = "GET / HTTP/1.1\r\nHost: a\r\n" + fields + "\r\n";
        return reader.read(bytes) == HeadReader::State::whole;
    };
    std::string many;
    for (int i = 0; i < 2 * isoatlas::kMaxFields; ++i) many += "X: y\r\n";
    if (is_let_in("X: y\r\n") && !is_let_in(many) && !is_let_in("Host: b\r\n")) return;
    std::puts("requests are not bounded, or not refused when they say two things");
    std::exit(1);
}

/// The predicates that verify relies on find damaged trees.
void check_predicates() {
    using Element = isoatlas::ElementIdOf<std::uint32_t>;
    using Event = isoatlas::EventIdOf<std::uint32_t>;
    isoatlas::ContourTree<std::uint32_t> contours;  // 0 - 1 - outside, and a cycle of 2 and 3
    for (const int other : {1, 4, 3, 2, 4}) contours.other.push_back(Element(other));
    for (const int degree : {0 | 1 << 2, 1 | 1 << 2, 0 | 2 << 2, 2 | 0 << 2, 1 | 0 << 2})
        contours.degree.push_back(static_cast<std::uint8_t>(degree));
    isoatlas::CriticalityTree<std::uint32_t> events;  // event 0 is not above its parent
    isoatlas::ByElement<std::uint32_t, double> values;
    for (const int i : {0, 1}) {
        events.event_of_element.push_back(Event(i)), events.top.push_back(Element(i)), events.parent.push_back(Event(1));
        values.push_back(5);
    }
    if (!isoatlas::is_contour_tree(contours) && !isoatlas::every_event_has_its_zone<std::uint32_t>(events, values)) return;
    std::puts("a damaged tree passes for a tree");
    std::exit(1);
}

/// A build is another one with another distance of samples.
void check_fingerprints() {
    isoatlas::VolumeInfo near, far;
    far.geometry.spacing = {2, 2, 2};
    if (isoatlas::header_fingerprint(near, {}, 0) != isoatlas::header_fingerprint(far, {}, 0)) return;
    std::puts("two spacings have one fingerprint");
    std::exit(1);
}

/// What whole bricks say of one object: all bricks with Highs that a chain of neighbours joins with it, and no others.
void check_joined_bricks() {
    using isoatlas::BrickClass, isoatlas::BrickId;
    std::mt19937 random(11);
    for (int round = 0; round < 20; ++round) {
        const isoatlas::BrickGrid grid({3, {5 * 16, 5 * 8, 5 * 8}});
        isoatlas::IdArray<BrickId, BrickClass> classes(static_cast<std::size_t>(grid.count()));
        for (const BrickId b : grid.bricks()) classes[b] = random() % 5 < 4 ? BrickClass::low : BrickClass::divided;
        std::set<std::int64_t> joined;
        const BrickId home(grid.count() / 2);
        classes[home] = BrickClass::high;
        joined.insert(home.number());
        for (std::size_t before = 0; before < joined.size();) {
            before = joined.size();
            for (const BrickId a : grid.bricks()) {
                for (const BrickId b : grid.bricks()) {
                    const isoatlas::Index3 p = grid.place(a), q = grid.place(b);
                    const bool are_near = std::abs(p[0] - q[0]) <= 1 && std::abs(p[1] - q[1]) <= 1 && std::abs(p[2] - q[2]) <= 1;
                    if (are_near && classes[b] != BrickClass::low && joined.contains(a.number())) joined.insert(b.number());
                }
            }
        }
        const isoatlas::BrickFlags found = isoatlas::joined_bricks(grid, {home}, classes);
        for (const BrickId b : grid.bricks()) {
            if ((found[b] != 0) != joined.contains(b.number())) fail("bricks of an object are missing or too many", {});
        }
    }
}

/// A region grows through all bricks that its samples enter, in every direction, and through no others.
void check_region_growing() {
    std::mt19937 random(12);
    for (int round = 0; round < 20; ++round) {
        oracle::Scene scene{isoatlas::BrickGrid({3, {40, 20, 21}}), {}};
        for (std::int64_t i = 0; i < scene.grid.extent.voxels(); ++i) scene.is_high.push_back(random() % 10 == 0);
        isoatlas::IdArray<isoatlas::BrickId, isoatlas::BrickClass> classes(static_cast<std::size_t>(scene.grid.count()));
        for (const isoatlas::BrickId b : scene.grid.bricks()) classes[b] = scene.class_of(b);
        const isoatlas::Index3 seed{20, 10, 10};
        scene.is_high[static_cast<std::size_t>(scene.grid.extent.index(seed))] = true;
        isoatlas::RegionGrowing region(scene.grid, classes);
        region.seed(seed);
        for (std::vector<isoatlas::BrickId> missing = region.grow(); !missing.empty(); missing = region.grow()) {
            for (const isoatlas::BrickId b : missing) region.add(b, scene.bits(b));
        }
        if (region.touched() != oracle::bricks_of_region(scene, {seed})) fail("a region does not grow as its samples do", {});
    }
}

}  // namespace

int main() try {
    check_outputs();
    check_requests();
    check_fingerprints();
    check_joined_bricks();
    check_region_growing();
    check_predicates();
    if (const std::string promise = mutants::broken_promise_of_readers(); !promise.empty()) {
        std::printf("does not hold: %s\n", promise.c_str());
        return 1;
    }
    std::mt19937 random(20240501);
    const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int trial = 0; trial < 400; ++trial) {
        const int rank = trial % 4 == 3 ? 2 : 3;
        std::array<Index, 3> size{};
        for (Index& s : size) s = 1 + below(rank == 2 ? 7 : 5);
        if (size[0] * size[1] * size[2] > 64) size[below(3)] = 2;
        std::vector<int> raw(343);
        for (int& r : raw) r = below(10000);
        oracle::Grid grid = oracle::make_grid(rank, size, static_cast<oracle::Texture>(trial % oracle::kTextures), raw);
        const bool huge = trial % 12 == 5;  // products overflow: face values come from the clamps
        if (huge) {
            for (double& v : grid.value) v = (v - 40) * 1e200;
        }
        check_volume(grid, trial % 2 == 0 ? Interpolant::trilinear : Interpolant::faces, !huge);
        if (!huge && trial % 2 == 0) check_interior(grid);
    }
    for (int trial = 0; trial < 3000; ++trial) {  // the faces alone are wrong in some of them
        oracle::Grid cell{3, {2, 2, 2}, {}};
        for (int k = 0; k < 8; ++k) cell.value.push_back(trial % 2 == 0 ? below(10000) / 10000.0 : below(8));
        const std::string difference = oracle::compare_with_finer(cell, oracle::cut_at_saddles(cell), 1e-9).difference;
        if (!difference.empty()) fail(difference, cell);
    }
    if (const std::string promise = mutants::broken_promise_of_coarser_surfaces(); !promise.empty()) {
        std::printf("does not hold: %s\n", promise.c_str());
        return 1;
    }
    return 0;
} catch (const std::exception& error) {
    std::printf("exception: %s\n", error.what());
    return 1;
}

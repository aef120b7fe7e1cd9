// Surfaces as meshes or files: of the whole store, or of its levels of detail; the first one of a page is kept.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <utility>

#include "atlas/overview.h"
#include "base/workers.h"
#include "formats/common/byte_writer.h"
#include "isoatlas/cards.h"
#include "isoatlas/isovalue.h"
#include "isoatlas/polarity.h"
#include "server/answers.h"
#include "server/download.h"
#include "server/fewer_triangles.h"
#include "server/object_points.h"
#include "server/parameter_text.h"
#include "server/query_parameters.h"
#include "server/service.h"
#include "server/unit_word.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kFirstTriangles = 20'000;  ///< max of the first request of a page (web/src/viewer/api/surfaces.ts)
constexpr std::int64_t kTriangleBytes = 128;      ///< of a triangle while a response is made
constexpr std::int64_t kMaxPointDivisions = 8;
constexpr int kFrontLevel = 4;                 ///< blocks of a front are at most 16 cells wide
constexpr double kStepsOfVoxel = 64;           ///< steps of positions per voxel
constexpr double kStepsOfSpacing = 16;         ///< of points, which are drawn wider than they are apart
constexpr std::int64_t kTimesOfFront = 16;     ///< a front seldom has fewer triangles than the exact surface by more than that
constexpr std::int64_t kPointsOfTriangle = 2;  ///< they are drawn as soon: less memory and bytes, more pixels

/// Which entry every page shows first: one that is more than background, if there is any (firstToShow() of web/src/shared/cards.ts).
template <class Entry>
std::size_t first_to_show(const std::vector<Entry>& entries) {
    const auto shown = std::ranges::find(entries, false, &Entry::is_background);
    return shown == entries.end() ? 0 : static_cast<std::size_t>(shown - entries.begin());
}

/// nullopt: there is none, or a cavity.
std::optional<NamedEntry> first_of(const StoreCatalogue& known) {
    if (known.entries.empty()) return std::nullopt;
    const NamedEntry& first = known.entries[first_to_show(known.contents.entries)];
    return first.is_cavity ? std::nullopt : std::optional(first);
}

/// The same, from the table alone; nullopt: the whole catalogue must tell.
std::optional<NamedEntry> first_of_table(const StoreSides& sides, const Context& context) {
    if (sides.has_both()) return std::nullopt;
    const std::optional<ObjectTable> table = stored_objects(sides.main, PageOptions{}.top, context);
    if (!table || table->entries.empty()) return std::nullopt;
    const VolumeInfo& info = sides.main.info();
    const ObjectEntry& first = table->entries[first_to_show(cards_of(*table, info.extent))];
    return NamedEntry{first.id, first.best_tau, first.voxels, false, polarity_of(info)};
}

/// NAME=X,Y,Z; nothing: without it.
std::optional<Vec3> vector_of(QueryParameters& words, const char* name) {
    const std::vector<std::string_view> numbers = words.items(name, 3);
    if (numbers.empty()) return std::nullopt;
    Vec3 vector;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string_view text = axis < numbers.size() ? numbers[axis] : "";
        const std::optional<double> at = whole_text_as<double>(text);
        if (!at || !std::isfinite(*at)) refuse_parameter(name, text, "three finite numbers: " + std::string(name) + "=X,Y,Z");
        vector[axis] = *at;
    }
    return vector;
}

/// eye=X,Y,Z&pixel=WIDTH and perhaps towards=X,Y,Z&angle=DEGREES; nothing: without them.
std::optional<Viewpoint> viewpoint_of(QueryParameters& words, const Geometry& geometry) {
    constexpr double kHalfTurn = 180;
    constexpr double kPositive = std::numeric_limits<double>::min();
    const std::optional<Vec3> eye = vector_of(words, "eye"), towards = vector_of(words, "towards");
    const std::optional<double> pixel = words.number("pixel", kPositive), angle = words.number("angle", kPositive);
    if (!eye && !pixel && !towards && !angle) return std::nullopt;
    if (!eye || !pixel)
        throw Error(ErrorKind::usage,
                    {.where = "eye", .what = "a view has an eye and the width of a pixel", .next = "add eye=X,Y,Z&pixel=WIDTH"});
    if (towards.has_value() != angle.has_value())
        throw Error(ErrorKind::usage,
                    {.where = "towards", .what = "a direction of view has an angle", .next = "add towards=X,Y,Z&angle=DEGREES"});
    Viewpoint from{.eye = *eye, .pixel = *pixel, .near = std::ranges::min(geometry.spacing)};
    if (towards) from.cone = {*towards, *angle / kHalfTurn * std::numbers::pi / 2};
    require_viewpoint(from);
    return from;
}

}  // namespace

void Service::prepare(const Context& context) {
    Context own = context_;
    own.cancelled = [&] { return ended_ || (context.cancelled && context.cancelled()); };
    const StoreSides sides = store_state_.sides();
    const bool is_volume = sides.main.info().extent.rank == 3;
    const std::optional<NamedEntry> early = is_volume ? first_of_table(sides, own) : std::nullopt;
    std::exception_ptr failure;
    Workers beside(1);  // of a store on a server, the surface does not wait for the trees
    const bool is_beside = early && beside.post([&] {
        try {
            prepare_first(*early, own);
        } catch (...) {
            failure = std::current_exception();
        }
    });
    const StoreCatalogue& all = known(own);
    beside.wait();
    if (failure) std::rethrow_exception(failure);
    if (is_beside || !is_volume) return;
    if (const std::optional<NamedEntry> first = first_of(all)) prepare_first(*first, own);
}

void Service::prepare_first(const NamedEntry& first, const Context& context) {
    (void)first_entry_.get(context, [&](const Context&) { return first; });
    const Atlas& atlas = store_state_.sides().of(first.polarity);
    SurfaceOptions options;
    options.ids = false;
    options.objects = {first.id};
    (void)first_.get(context, [&](const Context& shared) { return mesh_of(atlas, first.tau, options, {kFirstTriangles, {}}, shared); });
}

bool Service::is_first(const Atlas& atlas, double tau, const SurfaceOptions& options, const MeshWanted& wanted) const {
    const NamedEntry* first = first_entry_.there();
    if (first == nullptr || wanted.triangles != kFirstTriangles || wanted.from || first->polarity != polarity_of(atlas.info()))
        return false;
    const bool is_alone = options.objects == std::vector{first->id} && options.contours.empty() && options.shell == ShellChoice::all;
    return is_alone && tau == first->tau && !options.ids;
}

WireMesh Service::mesh_of(const Atlas& atlas, double tau, const SurfaceOptions& options, const MeshWanted& wanted, const Context& context) {
    const std::optional<SeenSurface> level = levels_.find(atlas, options, tau, wanted);
    if (!level) return unprepared(atlas, tau, options, wanted.triangles, context);
    if (std::ssize(level->simplified.surface.triangles) > wanted.triangles)
        return wire_sample(sample_surface(level->simplified.surface, kPointsOfTriangle * wanted.triangles, context), context);
    WireMesh mesh = wire(level->simplified.surface, context);
    mesh.coarse = level->simplified.distance > 0;
    mesh.distance = level->simplified.distance;
    if (wanted.from) mesh.pixels = level->pixels;
    return mesh;
}

WireMesh Service::unprepared(const Atlas& atlas, double tau, const SurfaceOptions& options, std::int64_t triangles,
                             const Context& context) const {
    if (atlas.info().extent.rank == 2) return wire(extract(atlas, tau, options, context), context);
    const std::int64_t few = std::min(triangles, max_triangles());
    SurfaceOptions all = options;
    all.max_triangles = max_triangles();
    const FrontOptions wanted{.max_level = kFrontLevel,
                              .triangles = few,
                              .exact_triangles = few,
                              .exact_above = kTimesOfFront * few,
                              .points = kPointsOfTriangle * few};
    FrontSurface front = atlas.extract_front(tau, wanted, all, context);
    if (front.spacing > 0)
        return wire_sample({{std::move(front.surface.points), std::move(front.surface.normals)}, front.spacing}, context);
    if (std::ssize(front.surface.triangles) > few)
        return wire_sample(sample_surface(front.surface, kPointsOfTriangle * few, context), context);
    return front.leaves.empty() ? wire(front.surface, context) : wire_front(front, context);
}

WireMesh Service::wire_sample(const SurfaceSample& sample, const Context& context) const {
    WireMesh mesh = wire_points(sample.cloud, std::max(step(), sample.spacing / kStepsOfSpacing), context);
    mesh.coarse = true;
    mesh.spacing = sample.spacing;
    return mesh;
}

WireMesh Service::wire_front(const FrontSurface& front, const Context& context) const {
    WireMesh mesh = wire(front.surface, context, false);  // soon replaced: the sooner it is there the better
    const auto widest = std::ranges::find_if(front.leaves.rbegin(), front.leaves.rend(), [](std::int64_t count) { return count > 0; });
    mesh.coarse = true;  // both surfaces of a block lie in it
    mesh.distance = std::sqrt(3.0) * static_cast<double>(std::int64_t{1} << (front.leaves.rend() - widest - 1));
    return mesh;
}

Response Service::surface_answer(const Request& request) {
    const Atlas& atlas = atlas_of_volume(request);
    QueryParameters words(request.words);
    const double tau = words.required_tau();
    SurfaceOptions options;
    options.objects = voxels(words, "object", request);
    options.contours = voxels(words, "contour", request);
    const std::optional<std::string> shell = words.choice("shell", {"outer", "inner"});
    if (shell) options.shell = *shell == "inner" ? ShellChoice::inner : ShellChoice::outer;
    const std::optional<std::string> format = words.choice("format", {"ply", "stl", "obj", "vtp", "glb", "vtkhdf"});
    std::optional<FewerTriangles> simplified;
    if (format) simplified.emplace(words);
    const std::optional<std::int64_t> divisions = format ? std::nullopt : words.whole("points", 1, kMaxPointDivisions);
    options.ids = format.has_value();
    const MeshWanted wanted{words.whole("max", 1, kMaxShownTriangles).value_or(kMaxShownTriangles),
                            viewpoint_of(words, atlas.info().geometry)};
    const std::string unit = unit_of_lengths(words, atlas.info().geometry);
    words.reject_unknown();

    const std::unique_ptr<JobQueue::Job> job = acquire_job(QueueClass::surfaces, request);
    const Context context = context_of(*job);
    const double stored = stored_isovalue(atlas.info(), tau);
    if (format) {
        options.max_triangles = simplified->most_of(max_triangles());
        Surface surface = atlas.extract(stored, options, context);
        simplified->apply(surface, atlas.info(), context);
        surface.unit = unit;
        Download download(*format, context);
        (void)write_surface(download, surface);
        return simplified->told(file_answer(download.take()));
    }
    const auto make = [&](const Context& own) {
        if (!divisions) return mesh_of(atlas, stored, options, wanted, own);
        const Surface surface = extract(atlas, stored, options, own);
        return wire(points_as_squares(atlas, surface, {static_cast<int>(*divisions), max_triangles(), memory_}, own), own);
    };
    WireMesh mesh = !divisions && is_first(atlas, stored, options, wanted) ? first_.get(context, make) : make(context);
    Response answer = file_answer(std::move(mesh.bytes));
    answer.headers["X-Triangles"] = std::to_string(mesh.triangles);
    answer.headers["X-Coarse"] = mesh.coarse ? "1" : "0";
    if (mesh.spacing > 0) answer.headers["X-Spacing"] = number_text(mesh.spacing);
    if (mesh.distance) answer.headers["X-Distance"] = number_text(*mesh.distance);
    if (mesh.pixels) answer.headers["X-Pixels"] = number_text(*mesh.pixels);
    return answer;
}

std::int64_t Service::max_triangles() const { return std::min(memory_ / kTriangleBytes, kMaxShownTriangles); }

Surface Service::extract(const Atlas& atlas, double tau, SurfaceOptions options, const Context& context) const {
    options.max_triangles = max_triangles();
    return atlas.extract(tau, options, context);
}

double Service::step() const { return std::ranges::min(store_state_.sides().main.info().geometry.spacing) / kStepsOfVoxel; }

WireMesh Service::wire(const Surface& surface, const Context& context, bool strips) const {
    return wire_mesh(surface, {.step = step(), .strips = strips}, context);
}

}  // namespace isoatlas

#include "compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "compare/seconds_of.h"
#include "data/temporary_folder.h"
#include "text/progress.h"

namespace isoatlas::cli {
namespace {

/// What lies far away, as in contours of noise, takes a thousand times as long: fewer parts, and not so far.
constexpr TrilinearDistanceOptions kDistances{.error = 0.001, .max_distance = 2, .max_parts = 500};

/// Tells which method runs, and gives a context in which it says nothing itself. As methods ask whether they are cancelled, the time goes
/// on.
class Stages {
public:
    Stages(const Context& context, std::size_t count)
        : context_(context), tell_(std::exchange(context_.progress, {})), count_(static_cast<int>(count)) {
        context_.cancelled = [this, cancelled = context.cancelled] {
            tell();
            return cancelled && cancelled();
        };
    }
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;
    [[nodiscard]] const Context& next(const std::string& method) {
        method_ = method, ++begun_;
        if (context_.cancelled()) throw Error(ErrorKind::cancelled, {.what = "cancelled"});
        return context_;
    }
    /// What follows belongs to the method before.
    [[nodiscard]] const Context& same() const { return context_; }

private:
    void tell() const {
        if (tell_) tell_({.phase = method_, .phase_index = begun_, .phase_count = count_, .fraction = kUnknownFraction});
    }
    Context context_;
    std::function<void(const Progress&)> tell_;
    int count_, begun_ = -1;
    std::string method_;
};

std::int64_t cells_of(const Extent& extent) {
    std::int64_t cells = 1;
    for (int axis = 0; axis < extent.rank; ++axis) cells *= extent.size[axis] - 1;
    return cells;
}

/// Every step-th sample along each axis.
Volume every(const Volume& volume, std::int64_t step) {
    const Extent& all = volume.info.extent;
    Extent extent = all;
    for (int axis = 0; axis < all.rank; ++axis) extent.size[axis] = (all.size[axis] + step - 1) / step;
    Geometry geometry;
    for (int axis = 0; axis < 3; ++axis) geometry.spacing[axis] = static_cast<double>(step);
    Volume coarse = make_volume(extent, volume.info.type, geometry);
    coarse.info.path = volume.info.path;
    visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const std::span<T> few = coarse.samples<T>();
        for (std::int64_t i = 0; i < extent.voxels(); ++i) {
            const Index3 at = extent.voxel(i);
            few[static_cast<std::size_t>(i)] = samples[static_cast<std::size_t>(all.index({step * at[0], step * at[1], step * at[2]}))];
        }
    });
    return coarse;
}

/// At which a half to a 2000th of the samples are High, evenly on a logarithmic scale; estimated from a million samples.
std::vector<double> spread_isovalues(const Volume& volume, std::int64_t count) {
    constexpr std::size_t kSamples = 1'000'000;
    constexpr double kMost = 0.5, kLeast = 0.0005;
    std::vector<double> values;
    visit_samples(volume, [&](auto samples) {
        const std::size_t step = std::max<std::size_t>(1, samples.size() / kSamples) | 1;  // odd: all columns have a share
        for (std::size_t i = 0; i < samples.size(); i += step) values.push_back(static_cast<double>(samples[i]));
    });
    std::ranges::sort(values);
    std::vector<double> isovalues;
    for (std::int64_t i = 0; i < count; ++i) {
        const double part = kMost * std::pow(kLeast / kMost, count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0);
        const auto place = static_cast<std::size_t>((1 - part) * static_cast<double>(values.size()));
        isovalues.push_back(values[std::min(place, values.size() - 1)]);
    }
    const auto repeated = std::ranges::unique(isovalues);
    isovalues.erase(repeated.begin(), repeated.end());
    if (!isovalues.empty() && isovalues.front() == values.front()) isovalues.erase(isovalues.begin());  // no cell is active
    return isovalues;
}

/// A set of cells as bits.
class CellSet {
public:
    CellSet(std::int64_t cells, const std::vector<CellId>& active) : bits_(static_cast<std::size_t>(cells)), count_(active.size()) {
        for (const CellId cell : active) bits_[cell.index()] = true;
    }
    /// The same cells, each once, in any order?
    [[nodiscard]] bool equals(const std::vector<CellId>& other) const {
        if (other.size() != count_) return false;
        std::vector<bool> missing = bits_;
        for (const CellId cell : other) {
            if (cell.index() >= missing.size() || !missing[cell.index()]) return false;
            missing[cell.index()] = false;
        }
        return true;
    }
    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(count_); }

private:
    std::vector<bool> bits_;
    std::size_t count_;
};

/// All searches on one volume, brute force first: it says which cells are active.
class SearchRunner {
public:
    SearchRunner(const Volume& volume, std::vector<double> isovalues, Stages& stages)
        : volume_(volume), isovalues_(std::move(isovalues)), stages_(stages), cells_(cells_of(volume.info.extent)) {}

    SearchRun run(const ComparedSearch& method) {
        const Context& context = stages_.next(method.title);
        SearchRun run{.method = method};
        std::unique_ptr<CellSearch> search;
        run.build_seconds = seconds_of([&] { search = method.build(volume_, folder_.path(), context); });
        if (search->file_bytes() > 0) {
            search->drop_pages();
            run.cold_seconds = ask(*search, 0, method.name).seconds;
        }
        for (std::size_t i = 0; i < isovalues_.size(); ++i) {
            const SearchQuery query = ask(*search, i, method.name);
            if (i == 0)
                run.query = query;
            else
                run.at_isovalue.push_back(query);
        }
        run.bytes = search->bytes(), run.file_bytes = search->file_bytes();
        return run;
    }
    [[nodiscard]] std::int64_t cells() const { return cells_; }
    /// At the i-th isovalue, after the first run.
    [[nodiscard]] std::int64_t active(std::size_t i) const { return active_[i].count(); }

private:
    SearchQuery ask(CellSearch& search, std::size_t i, const std::string& name) {
        SearchQuery query;
        std::vector<CellId> found;
        query.seconds = seconds_of([&] { found = search.active(isovalues_[i], query.cost); });
        if (active_.size() == i) active_.emplace_back(cells_, found);
        if (!active_[i].equals(found)) throw Error(ErrorKind::internal, {.what = name + " does not find the active cells"});
        return query;
    }

    const Volume& volume_;
    std::vector<double> isovalues_;
    Stages& stages_;
    std::int64_t cells_;
    TemporaryFolder folder_;
    std::vector<CellSet> active_;
};

/// How much memory a search takes to be built, by what it took for a smaller volume.
class MemoryForecast {
public:
    explicit MemoryForecast(std::int64_t limit) : limit_(limit) {}
    /// Bytes beyond the limit that it would need; 0: it fits, or nothing is known of it.
    [[nodiscard]] std::int64_t missing(const std::string& name, std::int64_t cells) const {
        const auto known = bytes_a_cell_.find(name);
        const double needed = known == bytes_a_cell_.end() ? 0 : known->second * static_cast<double>(cells);
        return limit_ > 0 && needed > static_cast<double>(limit_) ? static_cast<std::int64_t>(needed) : 0;
    }
    void learn(const SearchRun& run, std::int64_t cells) {
        constexpr double kWhileBuilt = 3;  // lists are sorted and copied
        if (cells > 0)
            bytes_a_cell_[run.method.name] =
                kWhileBuilt * static_cast<double>(std::max(run.bytes, run.file_bytes)) / static_cast<double>(cells);
    }

private:
    std::int64_t limit_;
    std::map<std::string, double> bytes_a_cell_;
};

std::vector<SearchRun> run_searches(const std::vector<ComparedSearch>& methods, SearchRunner& runner, MemoryForecast& forecast) {
    std::vector<SearchRun> runs;
    for (const ComparedSearch& method : methods) {
        if (const std::int64_t missing = forecast.missing(method.name, runner.cells()); missing > 0) {
            runs.push_back({.method = method, .missing_memory = missing});
            continue;
        }
        try {
            runs.push_back(runner.run(method));
        } catch (const Error& error) {  // a method may refuse what the others can do
            if (error.kind() != ErrorKind::resource) throw;
            runs.push_back({.method = method, .refusal = error.text().what});
            continue;
        }
        forecast.learn(runs.back(), runner.cells());
    }
    return runs;
}

ExtractedSurface measured(const ComparedMethod& method, double seconds, const SurfaceInHand& made) {
    const Surface& surface = made.result.surface;
    const PointCloud& cloud = made.result.points;
    ExtractedSurface one{.method = method, .seconds = seconds, .cost = made.result.cost};
    one.is_points = !cloud.points.empty();
    one.points = one.is_points ? std::ssize(cloud.points) : std::ssize(surface.points);
    one.triangles = std::ssize(surface.triangles);
    one.bytes = static_cast<std::int64_t>(surface.points.size() * sizeof(surface.points[0]) +
                                          surface.triangles.size() * sizeof(surface.triangles[0]) +
                                          cloud.points.size() * (sizeof(cloud.points[0]) + sizeof(cloud.normals[0])));
    one.components = made.difference.components, one.wrong_components = made.difference.wrong;
    one.euler = made.defects.euler;
    if (!one.is_points) one.genus = genus_of(made.defects);
    one.hole_edges = std::ssize(made.defects.hole_edges), one.non_manifold_edges = std::ssize(made.defects.non_manifold_edges);
    one.zero_area_triangles = std::ssize(made.defects.zero_area_triangles);
    return one;
}

std::vector<ExtractedSurface> run_staged(const Volume& volume, double tau, const std::vector<ComparedExtractor>& methods,
                                         const LookAtSurface& look, Stages& stages) {
    if (volume.info.extent.rank != 3 || methods.empty()) return {};
    std::vector<ExtractedSurface> all;
    const auto run = [&](const ComparedExtractor& method, SurfaceInHand& made) {
        const Context& context = stages.next(method.title);
        return seconds_of([&] { made.result = method.make(volume)->extract(tau, context); });
    };
    SurfaceInHand reference;
    const double seconds = run(methods.back(), reference);
    const auto add = [&](const ComparedMethod& method, double took, SurfaceInHand& made) {
        made.defects = find_defects(made.result.surface, volume.info);
        made.difference = compare_components(made.result.surface, reference.result.surface, volume.info);
        all.push_back(measured(method, took, made));
        all.back().to_trilinear = distance_to_trilinear(made.result, volume, tau, kDistances, stages.same());
        all.back().from_trilinear = distance_from_trilinear(made.result, volume, tau, kDistances, stages.same());
        if (look) look(all.back(), made);
    };
    add(methods.back(), seconds, reference);
    for (std::size_t i = 0; i + 1 < methods.size(); ++i) {
        SurfaceInHand made;
        const double took = run(methods[i], made);
        add(methods[i], took, made);
    }
    std::ranges::rotate(all, all.begin() + 1);
    return all;
}

std::vector<std::int64_t> steps_of(const Extent& extent, std::int64_t sizes) {
    constexpr std::int64_t kSmallest = 8;  // samples along the shortest axis
    std::vector<std::int64_t> steps;
    std::int64_t shortest = extent.size[0];
    for (int axis = 1; axis < extent.rank; ++axis) shortest = std::min(shortest, extent.size[axis]);
    for (std::int64_t step = 2; std::ssize(steps) + 1 < sizes && shortest / step >= kSmallest; step *= 2) steps.push_back(step);
    std::ranges::reverse(steps);
    return steps;
}

/// Of a large volume without a study over sizes: a coarser one tells how much memory searches take. 1: the volume is small enough.
std::int64_t trial_step(const Extent& extent, bool has_study) {
    constexpr std::int64_t kLarge = 4'000'000, kFew = 1'000'000;
    std::int64_t step = 1;
    if (has_study || cells_of(extent) <= kLarge) return step;
    while (cells_of(extent) / (step * step * step) > kFew) step *= 2;
    return step;
}

}  // namespace

std::vector<ExtractedSurface> run_extractors(const Volume& volume, double tau, const std::vector<ComparedExtractor>& methods,
                                             const LookAtSurface& look, const Context& context) {
    Stages stages(context, methods.size());
    return run_staged(volume, tau, methods, look, stages);
}

Comparison run_comparison(const Volume& volume, double tau, const CompareOptions& options, const LookAtSurface& look,
                          const Context& context) {
    const std::vector<ComparedSearch>& searches = options.methods.searches;
    const std::vector<std::int64_t> steps = searches.empty() ? std::vector<std::int64_t>{} : steps_of(volume.info.extent, options.sizes);
    const std::int64_t trial = searches.empty() ? 1 : trial_step(volume.info.extent, !steps.empty());
    Stages stages(context, options.methods.extractors.size() + (steps.size() + (trial > 1 ? 2 : 1)) * searches.size());
    Comparison found{.info = volume.info, .tau = tau, .cells = cells_of(volume.info.extent), .surface_part = options.surface_part};
    const Volume part = options.surface_part ? crop(volume, *options.surface_part) : Volume();
    found.surfaces = run_staged(options.surface_part ? part : volume, tau, options.methods.extractors, look, stages);
    if (searches.empty()) return found;
    MemoryForecast forecast(options.memory);
    if (trial > 1) {
        const Volume coarse = every(volume, trial);
        SearchRunner runner(coarse, {tau}, stages);
        static_cast<void>(run_searches(searches, runner, forecast));
    }
    for (const std::int64_t step : steps) {
        const Volume coarse = every(volume, step);
        SearchRunner runner(coarse, {tau}, stages);
        SizeRun size{.step = step, .extent = coarse.info.extent, .cells = runner.cells()};
        size.searches = run_searches(searches, runner, forecast);
        size.active = runner.active(0);
        found.sizes.push_back(std::move(size));
    }
    if (options.isovalues > 0) found.isovalues = spread_isovalues(volume, options.isovalues);
    std::vector<double> all{tau};
    all.insert(all.end(), found.isovalues.begin(), found.isovalues.end());
    SearchRunner runner(volume, all, stages);
    found.searches = run_searches(searches, runner, forecast);
    found.active = runner.active(0);
    for (std::size_t i = 0; i < found.isovalues.size(); ++i) found.active_at.push_back(runner.active(i + 1));
    if (!steps.empty())
        found.sizes.push_back(
            {.step = 1, .extent = volume.info.extent, .cells = found.cells, .active = found.active, .searches = found.searches});
    return found;
}

std::optional<double> fitted_exponent(const std::vector<std::array<double, 2>>& points) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const auto& [x, y] : points) {
        if (!(x > 0 && y > 0)) continue;
        const double a = std::log(x), b = std::log(y);
        ++n, sx += a, sy += b, sxx += a * a, sxy += a * b;
    }
    const double spread = n * sxx - sx * sx;
    if (n < 3 || !(spread > 1e-9 * n * sxx)) return std::nullopt;
    return (n * sxy - sx * sy) / spread;
}

}  // namespace isoatlas::cli

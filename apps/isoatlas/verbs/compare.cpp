// isoatlas compare: the methods of the literature on one volume, side by side: those that make surfaces, and those that search active
// cells.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "data/source.h"
#include "data/temporary_folder.h"
#include "text/document.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

/// Tells which method runs, and gives a context in which it says nothing itself.
class Stages {
public:
    explicit Stages(const Context& context) : context_(context), tell_(std::exchange(context_.progress, {})) {}
    [[nodiscard]] const Context& next(std::string_view method) {
        if (tell_) tell_({.phase = method, .phase_index = begun_++, .phase_count = kCount});
        return context_;
    }

private:
    static inline const int kCount = static_cast<int>(surface_methods().size() + search_methods().size()) + 5;

    Context context_;
    std::function<void(const Progress&)> tell_;
    int begun_ = 0;
};

struct Compared {
    const SearchMethodInfo* info;
    double build_seconds, seconds;
    std::int64_t bytes;
    CellSearchCost cost;
    std::vector<CellId> cells;  ///< ascending
};

template <class Work>
double seconds_of(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Compared run_method(const SearchMethodInfo& info, const Volume& volume, double tau, Stages& stages) {
    const Context& context = stages.next(info.name);
    Compared result{&info, 0, 0, 0, {}, {}};
    std::unique_ptr<CellSearch> search;
    result.build_seconds = seconds_of([&] { search = make_cell_search(info.method, volume, context); });
    result.seconds = seconds_of([&] { result.cells = search->active(tau, result.cost); });
    result.bytes = search->bytes();
    std::ranges::sort(result.cells);
    return result;
}

struct ComparedSurface {
    const SurfaceMethodInfo* info;
    double seconds;
    SurfaceReport report;
    std::int64_t hole_edges;

    [[nodiscard]] std::int64_t euler() const {
        return std::accumulate(report.component_chi.begin(), report.component_chi.end(), std::int64_t{0});
    }
};

struct ComparedPoints {
    int divisions;
    double seconds;
    std::int64_t points;
};

/// Dividing Cubes, twice as near each time; none of an image.
std::vector<ComparedPoints> make_points(const Volume& volume, double tau, Stages& stages) {
    std::vector<ComparedPoints> all;
    for (int divisions = 1; divisions <= 4 && volume.info.extent.rank == 3; divisions *= 2) {
        PointCloud cloud;
        const Context& context = stages.next("dividing-cubes");
        const double seconds = seconds_of(
            [&] { cloud = make_extractor(SurfaceMethod::dividing_cubes, volume, {.divisions = divisions})->extract(tau, context).points; });
        all.push_back({divisions, seconds, std::ssize(cloud.points)});
    }
    return all;
}

std::vector<ComparedSurface> make_surfaces(const Volume& volume, double tau, Stages& stages) {
    std::vector<ComparedSurface> all;
    if (volume.info.extent.rank != 3) return all;
    for (const SurfaceMethodInfo& info : surface_methods()) {
        if (makes_points(info.method)) continue;
        Surface surface;
        const Context& context = stages.next(info.name);
        const double seconds = seconds_of([&] { surface = make_extractor(info.method, volume)->extract(tau, context).surface; });
        all.push_back({&info, seconds, inspect(surface.points, surface.triangles), count_hole_edges(surface, volume.info)});
    }
    return all;
}

/// The interval tree in a file.
struct ComparedFile {
    std::int64_t block_bytes, file_bytes;
    double build_seconds, seconds;
    CellSearchCost cost;
};

std::vector<ComparedFile> search_files(const Volume& volume, double tau, Stages& stages) {
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/cells.tree";
    std::vector<ComparedFile> all;
    for (const std::int64_t block_bytes : {4096, 65536}) {
        ComparedFile one{block_bytes, 0, 0, 0, {}};
        const Context& context = stages.next("interval-tree-file");
        one.build_seconds = seconds_of([&] { write_interval_tree(path, volume, {.block_bytes = block_bytes}, context); });
        IntervalTreeFile file(path);
        one.seconds = seconds_of([&] { (void)file.active(tau, one.cost); });
        one.file_bytes = file.file_bytes();
        all.push_back(one);
    }
    return all;
}

/// In turns; each must find the cells of brute force, the first one.
std::vector<Compared> run_all(const Volume& volume, double tau, Stages& stages) {
    std::vector<Compared> all;
    for (const SearchMethodInfo& info : search_methods()) {
        all.push_back(run_method(info, volume, tau, stages));
        if (all.back().cells != all.front().cells)
            throw Error(ErrorKind::internal, {.what = std::string(info.name) + " does not find the active cells"});
        if (all.size() > 1) all.back().cells = {};
    }
    return all;
}

void print_text(Terminal& terminal, const std::vector<Compared>& all) {
    Table table({{"method", true}, {"section", true}, {"build, ms"}, {"query, ms"}, {"cells looked at"}, {"nodes"}, {"memory"}});
    for (const Compared& one : all) {
        table.add({std::string(one.info->title), std::string(one.info->section), fmt::format("{:.1f}", 1e3 * one.build_seconds),
                   fmt::format("{:.2f}", 1e3 * one.seconds), count_text(one.cost.cells), count_text(one.cost.nodes),
                   bytes_text(static_cast<double>(one.bytes))});
    }
    table.print(terminal);
    terminal.out() << '\n'
                   << counted(all.front().cost.active, "active cell") << " of " << count_text(all.front().cost.cells)
                   << "; every method finds them all. Sections are those of the dissertation\n";
}

void print_surfaces(Terminal& terminal, const std::vector<ComparedSurface>& all) {
    Table table({{"method", true},
                 {"section", true},
                 {"ms"},
                 {"triangles"},
                 {"components"},
                 {"Euler number"},
                 {"edges of holes"},
                 {"non-manifold edges"},
                 {"zero-area triangles"}});
    for (const ComparedSurface& one : all) {
        const SurfaceReport& report = one.report;
        table.add({std::string(one.info->title), std::string(one.info->section), fmt::format("{:.1f}", 1e3 * one.seconds),
                   count_text(report.triangles), count_text(std::ssize(report.component_chi)), count_text(one.euler()),
                   count_text(one.hole_edges), count_text(report.non_manifold_edges), count_text(report.zero_area_triangles)});
    }
    table.print(terminal);
    terminal.out() << "\nSurfaces are open where they leave the volume.\n\n";
}

void print_points(Terminal& terminal, const std::vector<ComparedPoints>& all) {
    Table table({{"method", true}, {"section", true}, {"ms"}, {"points"}, {"at most so many voxels away"}});
    for (const ComparedPoints& one : all) {
        table.add({fmt::format("Dividing Cubes, {0} x {0} x {0}", one.divisions), "3.3", fmt::format("{:.1f}", 1e3 * one.seconds),
                   count_text(one.points), fmt::format("{:.2f}", std::sqrt(3.0) / 2 / one.divisions)});
    }
    table.print(terminal);
    terminal.out() << '\n';
}

Json json_of(const std::vector<ComparedPoints>& all) {
    Json points = Json::array();
    for (const ComparedPoints& one : all)
        points.push_back({{"divisions", one.divisions}, {"seconds", one.seconds}, {"points", one.points}});
    return points;
}

Json json_of(const std::vector<ComparedSurface>& all) {
    Json surfaces = Json::array();
    for (const ComparedSurface& one : all) {
        surfaces.push_back({{"name", one.info->name},
                            {"title", one.info->title},
                            {"section", one.info->section},
                            {"source", one.info->source},
                            {"seconds", one.seconds},
                            {"points", one.report.points},
                            {"triangles", one.report.triangles},
                            {"components", one.report.component_chi.size()},
                            {"euler", one.euler()},
                            {"hole_edges", one.hole_edges},
                            {"non_manifold_edges", one.report.non_manifold_edges},
                            {"zero_area_triangles", one.report.zero_area_triangles}});
    }
    return surfaces;
}

void print_files(Terminal& terminal, const std::vector<ComparedFile>& all) {
    Table table(
        {{"method", true}, {"section", true}, {"build, ms"}, {"query, ms"}, {"cells looked at"}, {"blocks read"}, {"of nodes"}, {"file"}});
    for (const ComparedFile& one : all) {
        table.add({fmt::format("I/O-optimal interval tree, blocks of {} KiB", one.block_bytes / 1024), "3.8.6",
                   fmt::format("{:.1f}", 1e3 * one.build_seconds), fmt::format("{:.2f}", 1e3 * one.seconds), count_text(one.cost.cells),
                   count_text(one.cost.blocks), count_text(one.cost.nodes), bytes_text(static_cast<double>(one.file_bytes))});
    }
    table.print(terminal);
    terminal.out() << '\n';
}

Json json_of(const std::vector<ComparedFile>& all) {
    Json files = Json::array();
    for (const ComparedFile& one : all) {
        files.push_back({{"block_bytes", one.block_bytes},
                         {"file_bytes", one.file_bytes},
                         {"build_seconds", one.build_seconds},
                         {"seconds", one.seconds},
                         {"cells", one.cost.cells},
                         {"blocks", one.cost.blocks},
                         {"node_blocks", one.cost.nodes}});
    }
    return files;
}

/// Everything that was compared.
struct Comparison {
    double tau;
    std::vector<ComparedSurface> surfaces;
    std::vector<ComparedPoints> points;
    std::vector<Compared> searches;
    std::vector<ComparedFile> files;
};

void print_json(Terminal& terminal, const Comparison& found, const VolumeInfo& info) {
    Json json = document("compare", info);
    json["tau"] = number(info.calibration.reported(found.tau));
    json["cells"] = found.searches.front().cost.cells;  // brute force looks at all
    json["active_cells"] = found.searches.front().cost.active;
    json["surfaces"] = json_of(found.surfaces);
    json["dividing_cubes"] = json_of(found.points);
    json["searches"] = Json::array();
    for (const Compared& one : found.searches) {
        json["searches"].push_back({{"name", one.info->name},
                                    {"title", one.info->title},
                                    {"section", one.info->section},
                                    {"source", one.info->source},
                                    {"query_cost", one.info->cost},
                                    {"build_seconds", one.build_seconds},
                                    {"seconds", one.seconds},
                                    {"cells", one.cost.cells},
                                    {"nodes", one.cost.nodes},
                                    {"bytes", one.bytes}});
    }
    json["interval_tree_files"] = json_of(found.files);
    print(terminal, json);
}

}  // namespace

int run_compare(const Arguments& arguments, Terminal& terminal) {
    if (!arguments.tau) {
        throw Error(ErrorKind::usage,
                    {.what = "which isovalue?",
                     .expected = "--tau T",
                     .next = "isoatlas objects " + shell_word(arguments.file) + " lists the isovalues that show something"});
    }
    Source source(arguments, terminal);
    const double tau = source.tau();
    const Volume& volume = source.volume();
    Stages stages(source.context());
    const Comparison found{tau, make_surfaces(volume, tau, stages), make_points(volume, tau, stages), run_all(volume, tau, stages),
                           search_files(volume, tau, stages)};
    if (arguments.json) {
        print_json(terminal, found, source.info());
        return 0;
    }
    if (!found.surfaces.empty()) print_surfaces(terminal, found.surfaces), print_points(terminal, found.points);
    print_files(terminal, found.files);
    print_text(terminal, found.searches);
    return 0;
}

}  // namespace isoatlas::cli

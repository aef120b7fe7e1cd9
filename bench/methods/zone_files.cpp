// bench_zones: what do the zone files of the dissertation cost, beside bricks?
//
//   bench_zones VOLUME [--cache FOLDER] [--data FOLDER] [--scratch FOLDER] [--block BYTES] [--isovalues N] [--max-entries N] [--threads N]
//     [--memory BYTES] [--by-path]
//   bench_zones VOLUME --build-only ...      writes the file by path, nothing else: its peak of memory
//
// VOLUME: as in bench_engine. Prints one JSON document: for each layout the file and what queries at so many isovalues of table 13.1 read
// (mean), a surface from the file compared with that of the volume, and the bytes that a store reads for the same surfaces. Counts do not
// depend on the machine; seconds do. By zone with too many entries: only how many; --by-path: not even that, which takes long. --memory: a
// budget for loading, analysing and writing; by zone, tables of reads need several numbers a zone beside it.
#include <isoatlas/isoatlas.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line.h"
#include "memory.h"
#include "volumes.h"

namespace bench {
namespace {

using isoatlas::Volume;
using isoatlas::ZoneFileRow;
using isoatlas::ZoneFileSearch;
using isoatlas::ZoneLayout;
using nlohmann::ordered_json;

struct Arguments {
    std::string volume;
    Sources sources{"build/bench/volumes", ""};
    std::string scratch = "build/bench";
    isoatlas::ZoneFileOptions options;
    std::int64_t isovalues = 50;
    isoatlas::Context context;
    std::int64_t memory = 0;  ///< 0: no budget
    bool by_path_alone = false, build_only = false;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    const std::vector<std::string> words = CommandLine()
                                               .value("--cache", arguments.sources.cache)
                                               .value("--data", arguments.sources.data)
                                               .value("--scratch", arguments.scratch)
                                               .value("--block", arguments.options.block_bytes)
                                               .value("--isovalues", arguments.isovalues)
                                               .value("--max-entries", arguments.options.max_entries)
                                               .value("--threads", arguments.context.threads)
                                               .value("--memory", arguments.memory)
                                               .flag("--by-path", arguments.by_path_alone)
                                               .flag("--build-only", arguments.build_only)
                                               .read(argc, argv);
    if (words.size() != 1) throw std::runtime_error("which volume? the head of zone_files.cpp lists the arguments");
    arguments.volume = words.front();
    return arguments;
}

double mean(const std::vector<ZoneFileRow>& rows, const std::function<double(const ZoneFileRow&)>& number) {
    double sum = 0;
    for (const ZoneFileRow& row : rows) sum += number(row);
    return rows.empty() ? 0 : sum / static_cast<double>(rows.size());
}

ordered_json means(const std::vector<ZoneFileRow>& rows) {
    const auto of = [&](auto number) { return mean(rows, [&](const ZoneFileRow& row) { return static_cast<double>(number(row)); }); };
    return {{"isovalues", rows.size()},
            {"active", of([](const ZoneFileRow& row) { return row.cost.active; })},
            {"entries_active", of([](const ZoneFileRow& row) { return row.reads.entries_active; })},
            {"zones", of([](const ZoneFileRow& row) { return row.reads.zones; })},
            {"components", of([](const ZoneFileRow& row) { return row.reads.components; })},
            {"nodes", of([](const ZoneFileRow& row) { return row.cost.nodes; })},
            {"cells_loaded", of([](const ZoneFileRow& row) { return row.reads.cells_loaded; })},
            {"cells_visited", of([](const ZoneFileRow& row) { return row.reads.cells_visited; })},
            {"load_utility", of([](const ZoneFileRow& row) { return row.load_utility(); })},
            {"travel_utility", of([](const ZoneFileRow& row) { return row.travel_utility(); })},
            {"blocks", of([](const ZoneFileRow& row) { return row.cost.blocks; })},
            {"bytes", of([](const ZoneFileRow& row) { return row.cost.bytes_read; })},
            {"brick_load_utility", of([](const ZoneFileRow& row) {
                 return row.counted.bricks_loaded == 0
                            ? 0.0
                            : 100 * static_cast<double>(row.counted.active) / static_cast<double>(row.counted.bricks_loaded);
             })},
            {"brick_bytes", of([](const ZoneFileRow& row) { return row.brick_bytes; })}};
}

bool gives_the_surface(ZoneFileSearch& file, const Volume& volume, double tau) {
    isoatlas::ExtractOptions options;
    options.surface.boundary = isoatlas::Boundary::open;
    options.surface.normals = options.surface.ids = false;
    isoatlas::CellSearchCost cost;
    const isoatlas::Surface found = file.extract(tau, options, cost), surface = isoatlas::extract(volume, tau, options);
    return found.points == surface.points && found.triangles == surface.triangles;
}

std::string file_path(const Arguments& arguments) { return arguments.scratch + "/bench_zones.zones"; }

ordered_json write(const Arguments& arguments, const Volume& volume, const isoatlas::Analysis& analysis, ZoneLayout layout) {
    isoatlas::ZoneFileOptions options = arguments.options;
    options.layout = layout;
    const double seconds =
        seconds_of([&] { isoatlas::write_zone_files(file_path(arguments), volume, analysis, options, arguments.context); });
    const ZoneFileSearch file(file_path(arguments));
    return {{"entries", file.entries()},  {"written", true},       {"build_seconds", seconds},       {"file_bytes", file.file_bytes()},
            {"tree_bytes", file.bytes()}, {"zones", file.zones()}, {"components", file.components()}};
}

ordered_json measure(const Arguments& arguments, const Volume& volume, const isoatlas::Analysis& analysis, ZoneLayout layout,
                     const std::string& store) {
    const std::int64_t entries = layout == ZoneLayout::by_zone ? isoatlas::count_zone_file_entries(volume, analysis, layout) : 0;
    if (entries > arguments.options.max_entries) return {{"entries", entries}, {"written", false}};
    ordered_json result = write(arguments, volume, analysis, layout);
    {
        ZoneFileSearch file(file_path(arguments));
        const std::vector<ZoneFileRow> rows =
            isoatlas::zone_file_table(file, volume, analysis, arguments.isovalues, store, arguments.context);
        double query = 0;
        for (const ZoneFileRow& row : rows) {
            isoatlas::CellSearchCost cost;
            query += seconds_of([&] { (void)file.active(row.counted.tau, cost); });
        }
        result["queries"] = means(rows);
        result["query_seconds"] = rows.empty() ? 0 : query / static_cast<double>(rows.size());
        result["same_surface"] = rows.empty() || gives_the_surface(file, volume, rows[rows.size() / 2].counted.tau);
    }
    std::filesystem::remove(file_path(arguments));
    return result;
}

ordered_json compare_with_store(const Arguments& arguments, const Volume& volume, const isoatlas::Analysis& analysis) {
    const std::string store = arguments.scratch + "/bench_zones.atlas";
    isoatlas::build_atlas(store, volume, {}, arguments.context);
    ordered_json result{{"store_bytes", std::filesystem::file_size(store)}};
    result["by_path"] = measure(arguments, volume, analysis, ZoneLayout::by_path, store);
    if (!arguments.by_path_alone) result["by_zone"] = measure(arguments, volume, analysis, ZoneLayout::by_zone, store);
    std::filesystem::remove(store);
    return result;
}

void run(Arguments arguments) {
    std::filesystem::create_directories(arguments.sources.cache);
    std::optional<isoatlas::MemoryBudget> budget;
    isoatlas::Environment environment;
    if (arguments.memory > 0) environment.memory = &budget.emplace(arguments.memory, std::filesystem::absolute(arguments.scratch).string());
    arguments.context.environment = &environment;
    const isoatlas::EnvironmentScope scope(environment);
    const std::int64_t before = reset_peak();
    const Volume volume = make(arguments.volume, arguments.sources);
    const isoatlas::Extent& extent = volume.info.extent;
    ordered_json document{{"volume", arguments.volume},
                          {"size", {extent.size[0], extent.size[1], extent.size[2]}},
                          {"type", isoatlas::name_of(volume.info.type)},
                          {"volume_bytes", volume.bytes.size()},
                          {"block_bytes", arguments.options.block_bytes},
                          {"memory", arguments.memory}};
    isoatlas::Analysis analysis = isoatlas::analyse(volume, {}, arguments.context);
    document["events"] = analysis.event_count();
    document["peak_of_analysis"] = peak();
    if (arguments.build_only) {
        document["by_path"] = write(arguments, volume, analysis, ZoneLayout::by_path);
        document["peak_bytes"] = peak(), document["resident_before"] = before;
        std::filesystem::remove(file_path(arguments));
    } else {
        document.update(compare_with_store(arguments, volume, analysis));
    }
    std::printf("%s\n", document.dump(2).c_str());
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
    try {
        bench::run(bench::parse(argc, argv));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_zones: %s\n", error.what());
        return 1;
    }
}

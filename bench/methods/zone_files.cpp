// bench_zones: what do the zone files of the dissertation cost, beside bricks?
//
//   bench_zones VOLUME [--cache FOLDER] [--data FOLDER] [--scratch FOLDER] [--block BYTES] [--isovalues N] [--max-entries N] [--threads N]
//     [--by-path]
//
// VOLUME: as in bench_engine. Prints one JSON document: for each layout the file and what queries at so many isovalues of table 13.1 read
// (mean), a surface from the file compared with that of the volume, and the bytes that a store reads for the same surfaces. Counts do not
// depend on the machine; seconds do. By zone with too many entries: only how many; --by-path: not even that, which takes long.
#include <isoatlas/isoatlas.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

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
    bool by_path_alone = false;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&]() -> std::string {
            if (++i == argc) throw std::runtime_error(word + " needs a value");
            return argv[i];
        };
        if (word == "--cache")
            arguments.sources.cache = value();
        else if (word == "--data")
            arguments.sources.data = value();
        else if (word == "--scratch")
            arguments.scratch = value();
        else if (word == "--block")
            arguments.options.block_bytes = std::stoll(value());
        else if (word == "--isovalues")
            arguments.isovalues = std::stoll(value());
        else if (word == "--max-entries")
            arguments.options.max_entries = std::stoll(value());
        else if (word == "--threads")
            arguments.context.threads = std::stoi(value());
        else if (word == "--by-path")
            arguments.by_path_alone = true;
        else if (word.starts_with("--"))
            throw std::runtime_error("unknown option " + word);
        else
            arguments.volume = word;
    }
    if (arguments.volume.empty()) throw std::runtime_error("which volume? the head of zone_files.cpp lists the arguments");
    return arguments;
}

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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

ordered_json measure(const Arguments& arguments, const Volume& volume, const isoatlas::Analysis& analysis, ZoneLayout layout,
                     const std::string& store) {
    const std::string path = arguments.scratch + "/bench_zones.zones";
    isoatlas::ZoneFileOptions options = arguments.options;
    options.layout = layout;
    const std::int64_t entries = layout == ZoneLayout::by_zone ? isoatlas::count_zone_file_entries(volume, analysis, layout) : 0;
    if (entries > options.max_entries) return {{"entries", entries}, {"written", false}};
    const double build = seconds_of([&] { isoatlas::write_zone_files(path, volume, analysis, options, arguments.context); });
    ordered_json result;
    {
        ZoneFileSearch file(path);
        const std::vector<ZoneFileRow> rows =
            isoatlas::zone_file_table(file, volume, analysis, arguments.isovalues, store, arguments.context);
        double query = 0;
        for (const ZoneFileRow& row : rows) {
            isoatlas::CellSearchCost cost;
            query += seconds_of([&] { (void)file.active(row.counted.tau, cost); });
        }
        result = {{"entries", file.entries()},
                  {"written", true},
                  {"build_seconds", build},
                  {"file_bytes", file.file_bytes()},
                  {"tree_bytes", file.bytes()},
                  {"zones", file.zones()},
                  {"components", file.components()},
                  {"queries", means(rows)},
                  {"query_seconds", rows.empty() ? 0 : query / static_cast<double>(rows.size())},
                  {"same_surface", rows.empty() || gives_the_surface(file, volume, rows[rows.size() / 2].counted.tau)}};
    }
    std::filesystem::remove(path);
    return result;
}

void run(const Arguments& arguments) {
    std::filesystem::create_directories(arguments.sources.cache);
    const Volume volume = make(arguments.volume, arguments.sources);
    isoatlas::Analysis analysis = isoatlas::analyse(volume, {}, arguments.context);
    const std::string store = arguments.scratch + "/bench_zones.atlas";
    isoatlas::build_atlas(store, volume, {}, arguments.context);
    const isoatlas::Extent& extent = volume.info.extent;
    ordered_json document{{"volume", arguments.volume},
                          {"size", {extent.size[0], extent.size[1], extent.size[2]}},
                          {"type", isoatlas::name_of(volume.info.type)},
                          {"volume_bytes", volume.bytes.size()},
                          {"store_bytes", std::filesystem::file_size(store)},
                          {"events", analysis.event_count()},
                          {"block_bytes", arguments.options.block_bytes}};
    document["by_path"] = measure(arguments, volume, analysis, ZoneLayout::by_path, store);
    if (!arguments.by_path_alone) document["by_zone"] = measure(arguments, volume, analysis, ZoneLayout::by_zone, store);
    std::filesystem::remove(store);
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

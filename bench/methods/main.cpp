// bench_methods: what do searches for active cells look at, and what does the one in a file cost?
//
//   bench_methods growth [VOLUME...] [--cache FOLDER] [--data FOLDER] [--json FILE]    VOLUME: as in bench_engine
//   bench_methods build VOLUME_FILE TREE [--memory BYTES] [--block-bytes N]            within a budget, from the file
//   bench_methods query TREE TAU [--repeats N]                                         warm and cold
//
// growth: for each volume, each search and isovalues at even steps of the range: what a query looks at beyond the active cells. Counts, the
// same on every machine; bench/report.py fits exponents over the volumes of a field. Each command prints one JSON document.
#include <isoatlas/isoatlas.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
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

using isoatlas::CellSearch;
using isoatlas::CellSearchCost;
using isoatlas::IntervalTreeFile;
using isoatlas::SearchMethodInfo;
using isoatlas::Volume;
using nlohmann::ordered_json;

struct Arguments {
    std::vector<std::string> words;
    Sources sources{"build/bench/volumes", ""};
    std::string json;
    std::int64_t memory = 0, block_bytes = 4096;
    int repeats = 5;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    arguments.words = bench::CommandLine()
                          .value("--cache", arguments.sources.cache)
                          .value("--data", arguments.sources.data)
                          .value("--json", arguments.json)
                          .value("--memory", arguments.memory)
                          .value("--block-bytes", arguments.block_bytes)
                          .value("--repeats", arguments.repeats)
                          .read(argc, argv);
    return arguments;
}

constexpr int kIsovalues = 15;

std::vector<double> isovalues(const Volume& volume) {
    const auto [low, high] = isoatlas::visit_samples(volume, []<class T>(std::span<const T> samples) {
        const auto [min, max] = std::ranges::minmax(samples);
        return std::pair(static_cast<double>(min), static_cast<double>(max));
    });
    std::vector<double> taus;
    for (int i = 1; i <= kIsovalues; ++i) taus.push_back(low + (high - low) * i / (kIsovalues + 1));
    return taus;
}

/// in_block: cells of a block; 0: in memory.
ordered_json record_of(const std::string& volume, const Volume& of, const std::string& name, const std::string& theorem, CellSearch& search,
                       std::int64_t in_block) {
    const isoatlas::Extent& extent = of.info.extent;
    std::int64_t cells = 1;
    for (int axis = 0; axis < extent.rank; ++axis) cells *= extent.size[axis] - 1;
    ordered_json record{{"volume", volume},
                        {"n", cells},
                        {"search", name},
                        {"theorem", theorem},
                        {"bytes", search.bytes()},
                        {"file_bytes", search.file_bytes()},
                        {"cells_of_block", in_block},
                        {"queries", ordered_json::array()}};
    const std::vector<double> taus = isovalues(of);
    CellSearchCost cost;
    (void)search.active(taus.front(), cost);  // some begin with the cells of the query before
    for (const double tau : taus) {
        (void)search.active(tau, cost);
        record["queries"].push_back(
            {{"tau", tau}, {"k", cost.active}, {"cells", cost.cells}, {"nodes", cost.nodes}, {"blocks", cost.blocks}});
    }
    return record;
}

void growth(const Arguments& arguments) {
    std::vector<std::string> names(arguments.words.begin() + 1, arguments.words.end());
    if (names.empty()) {
        for (const char* field : {"smooth", "white"}) {
            for (const char* size : {"16", "32", "64", "128"}) names.push_back(std::string(field) + "-" + size);
        }
        names.emplace_back("smooth-256");
    }
    ordered_json records = ordered_json::array();
    const std::string path = arguments.sources.cache + "/tree";
    for (const std::string& name : names) {
        const Volume volume = make(name, arguments.sources);
        for (const SearchMethodInfo& info : isoatlas::search_methods()) {
            const std::unique_ptr<CellSearch> search = isoatlas::make_cell_search(info.method, volume);
            records.push_back(record_of(name, volume, std::string(info.title), std::string(info.cost), *search, 0));
        }
        for (const std::int64_t block_bytes : {4096, 65536}) {
            isoatlas::write_interval_tree(path, volume, {.block_bytes = block_bytes});
            IntervalTreeFile file(path);
            const auto entry = static_cast<std::int64_t>(2 * isoatlas::size_of(volume.info.type) + sizeof(isoatlas::CellId::Number));
            records.push_back(record_of(name, volume, "In a file, blocks of " + std::to_string(block_bytes / 1024) + " KiB",
                                        "log_B n + k / B", file, (block_bytes - 8) / entry));
        }
        std::fprintf(stderr, "bench_methods: %s\n", name.c_str());
    }
    std::filesystem::remove(path);
    const ordered_json document{{"records", records}};
    if (arguments.json.empty())
        std::puts(document.dump().c_str());
    else
        std::ofstream(arguments.json) << document.dump(1) << "\n";
}

void build(const Arguments& arguments) {
    const std::string &source = arguments.words.at(1), &path = arguments.words.at(2);
    std::optional<isoatlas::MemoryBudget> budget;
    isoatlas::Environment environment;
    if (arguments.memory > 0) {
        std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
        environment.memory = &budget.emplace(arguments.memory, folder.string());
    }
    isoatlas::Context context;
    context.environment = &environment;
    const std::int64_t before = reset_peak();
    const double seconds = seconds_of([&] {
        const std::unique_ptr<isoatlas::VolumeReader> reader = isoatlas::open_volume(source);
        isoatlas::write_interval_tree(path, *reader, {}, {.block_bytes = arguments.block_bytes}, context);
    });
    const std::int64_t most = peak();
    const IntervalTreeFile file(path);
    std::puts(ordered_json{{"volume", source},
                           {"memory", arguments.memory},
                           {"seconds", seconds},
                           {"peak_bytes", most},
                           {"resident_before", before},
                           {"file_bytes", file.file_bytes()},
                           {"cells", file.cells()},
                           {"slabs", file.slabs()},
                           {"levels", file.levels()}}
                  .dump()
                  .c_str());
}

void query(const Arguments& arguments) {
    IntervalTreeFile file(arguments.words.at(1));
    const double tau = std::stod(arguments.words.at(2));
    ordered_json warm = ordered_json::array(), cold = ordered_json::array();
    CellSearchCost cost;
    (void)file.active(tau, cost);
    for (int i = 0; i < arguments.repeats; ++i) {
        warm.push_back(seconds_of([&] { (void)file.active(tau, cost); }));
        file.drop_pages();
        cold.push_back(seconds_of([&] { (void)file.active(tau, cost); }));
    }
    std::puts(ordered_json{{"tau", tau},
                           {"k", cost.active},
                           {"cells", cost.cells},
                           {"nodes", cost.nodes},
                           {"blocks", cost.blocks},
                           {"bytes_read", cost.bytes_read},
                           {"warm", warm},
                           {"cold", cold}}
                  .dump()
                  .c_str());
}

void run(const Arguments& arguments) {
    const std::string command = arguments.words.empty() ? "" : arguments.words.front();
    if (command == "growth") return growth(arguments);
    if (command == "build") return build(arguments);
    if (command == "query") return query(arguments);
    throw std::runtime_error("commands: growth build query");
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) try {
    bench::run(bench::parse(argc, argv));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_methods: %s\n", error.what());
    return 1;
}

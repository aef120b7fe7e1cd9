// bench_engine: what does an analysis cost, measured in sorts, and how much memory does it need?
//
//   bench_engine [--data FOLDER] [--cache FOLDER] [--json FILE] [--threads N] [--pairs N] [--no-sort] [VOLUME...]
//
// For each volume: std::sort of its (value, index) pairs and analyse, in turns, medians of --pairs pairs; the answers are checked first.
// --no-sort leaves the sort out. Analyses run on one thread, on --threads and, where there are more, on all processors.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "command_line.h"
#include "measure.h"
#include "memory.h"
#include "volumes.h"

namespace bench {
namespace {

using nlohmann::ordered_json;

struct Arguments {
    Sources sources{"build/bench/volumes", ""};
    std::string json;
    Options options;
    std::string memory_of;  ///< set in the measuring process
    std::vector<std::string> names;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    arguments.names = bench::CommandLine()
                          .value("--data", arguments.sources.data)
                          .value("--cache", arguments.sources.cache)
                          .value("--json", arguments.json)
                          .value("--threads", arguments.options.threads)
                          .value("--pairs", arguments.options.pairs)
                          .value("--memory-of", arguments.memory_of)
                          .flag("--no-sort", [&] { arguments.options.sort = false; })
                          .read(argc, argv);
    return arguments;
}

/// The measuring process: prints the peak bytes of one analysis.
int print_peak(const Arguments& arguments) {
    const isoatlas::Volume volume = make(arguments.memory_of, arguments.sources);
    isoatlas::Context context;
    context.threads = arguments.options.threads;
    const std::int64_t before = reset_peak();
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {}, context);
    std::printf("%lld\n", static_cast<long long>(peak() - before));
    return analysis.element_count() > 0 ? 0 : 1;
}

std::int64_t peak_of(const std::string& name, const Arguments& arguments) {
    return peak_bytes_of_child({"bench_engine", "--memory-of", name, "--cache", arguments.sources.cache, "--data", arguments.sources.data,
                                "--threads", std::to_string(arguments.options.threads)});
}

ordered_json record_of(const std::string& name, const Arguments& arguments) {
    Answer answer{};
    const isoatlas::Volume volume = make(name, arguments.sources);
    const Timing timing = measure(volume, arguments.options, answer);
    const std::int64_t voxels = volume.info.extent.voxels();
    const std::int64_t peak = peak_of(name, arguments);
    const std::int64_t allowed = 12 * voxels + 64 * timing.trilinear_elements;

    ordered_json record{{"volume", name},
                        {"size", volume.info.extent.size},
                        {"type", isoatlas::name_of(volume.info.type)},
                        {"voxels", voxels},
                        {"critical_elements", answer.elements},
                        {"maxima", answer.maxima},
                        {"events", answer.events},
                        {"seconds", timing.seconds},
                        {"trilinear_ratio", timing.trilinear_ratio},
                        {"trilinear_elements", timing.trilinear_elements},
                        {"peak_bytes", peak},
                        {"peak_bytes_per_voxel", static_cast<double>(peak) / static_cast<double>(voxels)},
                        {"peak_over_allowed", static_cast<double>(peak) / static_cast<double>(allowed)}};
    for (const auto& [threads, seconds] : timing.seconds_by_threads) record["seconds_by_threads"][std::to_string(threads)] = seconds;
    if (arguments.options.sort) {
        record["sort_seconds"] = timing.sort_seconds;
        record["ratio"] = timing.ratio;
        record["ratio_range"] = {timing.ratio_low, timing.ratio_high};
    }
    for (const auto& [phase, seconds] : timing.phases) record["phases"][phase] = seconds;
    return record;
}

void print_line(const ordered_json& record) {
    std::printf("%-12s %-8s %11lld voxels %10lld elements", record["volume"].get<std::string>().c_str(),
                record["type"].get<std::string>().c_str(), record["voxels"].get<long long>(), record["critical_elements"].get<long long>());
    for (const auto& [threads, seconds] : record["seconds_by_threads"].items())
        std::printf(" %8.3f s on %s", seconds.get<double>(), threads.c_str());
    if (record.contains("ratio"))
        std::printf("  sort %6.3f s  ratio %5.3f", record["sort_seconds"].get<double>(), record["ratio"].get<double>());
    std::printf("  %5.1f bytes/voxel (%.2f of what is allowed)\n", record["peak_bytes_per_voxel"].get<double>(),
                record["peak_over_allowed"].get<double>());
    if (record.contains("phases")) {
        for (const auto& [phase, seconds] : record["phases"].items())
            std::printf("    %-28s %7.3f s\n", phase.c_str(), seconds.get<double>());
    }
    std::fflush(stdout);
}

int run_all(const Arguments& arguments) {
    std::filesystem::create_directories(arguments.sources.cache);
    ordered_json document{
        {"schema", "isoatlas-bench-engine/1"}, {"threads", arguments.options.threads}, {"pairs", arguments.options.pairs}};
    for (const std::string& name : arguments.names.empty() ? default_names(arguments.sources) : arguments.names) {
        print_line(document["volumes"].emplace_back(record_of(name, arguments)));
    }
    if (arguments.json.empty()) return 0;
    std::ofstream file(arguments.json);
    file << document.dump(2) << "\n";
    file.close();
    if (!file) throw std::runtime_error("cannot write " + arguments.json);
    return 0;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) try {
    const bench::Arguments arguments = bench::parse(argc, argv);
    return arguments.memory_of.empty() ? bench::run_all(arguments) : bench::print_peak(arguments);
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_engine: %s\n", error.what());
    return 1;
}

// bench_extract: how long does a surface take, without any index?
//
//   bench_extract VOLUME [TAU] [--cache FOLDER] [--data FOLDER] [--threads N] [--repeats N] [--open] [--full] [--ids] [--check]
//
// VOLUME: as in bench_engine. Prints JSON: size and type and, with an isovalue, seconds of every repeat, the peak bytes of the first,
// counts, and what --check found. compare_vtk.py runs this beside VTK's Flying Edges on the samples that it leaves in the cache, NAME.raw.
#include <isoatlas/isoatlas.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "command_line.h"
#include "memory.h"
#include "volumes.h"

namespace {

using nlohmann::ordered_json;

struct Arguments {
    std::string volume;
    std::optional<double> tau;
    bench::Sources sources{"build/bench/volumes", ""};
    int repeats = 5;
    bool check = false;
    isoatlas::Context context;
    isoatlas::SurfaceOptions options;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    arguments.options.ids = false;
    const std::vector<std::string> words = bench::CommandLine()
                                               .value("--threads", arguments.context.threads)
                                               .value("--repeats", arguments.repeats)
                                               .value("--cache", arguments.sources.cache)
                                               .value("--data", arguments.sources.data)
                                               .flag("--open", [&] { arguments.options.boundary = isoatlas::Boundary::open; })
                                               .flag("--full", [&] { arguments.options.style = isoatlas::SurfaceStyle::full; })
                                               .flag("--ids", arguments.options.ids)
                                               .flag("--check", arguments.check)
                                               .read(argc, argv);
    if (words.empty() || words.size() > 2) throw std::runtime_error("usage: bench_extract VOLUME [TAU] [options]");
    arguments.volume = words[0];
    if (words.size() == 2) arguments.tau = std::stod(words[1]);
    return arguments;
}

ordered_json check(const isoatlas::Volume& volume, const Arguments& arguments, const isoatlas::Surface& surface) {
    const isoatlas::SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
    const isoatlas::Cut cut = isoatlas::cut(volume, *arguments.tau, {}, arguments.context);
    return {{"components", report.component_chi.size()},
            {"closed", report.is_closed()},
            {"manifold", report.is_manifold()},
            {"oriented", report.is_oriented()},
            {"zero_area_triangles", report.zero_area_triangles},
            {"contours_of_the_cut", cut.contours.size()}};
}

void measure(const Arguments& arguments, const isoatlas::Volume& volume, ordered_json& result) {
    ordered_json seconds = ordered_json::array();
    isoatlas::Surface surface;
    const std::int64_t before = bench::reset_peak();
    for (int i = 0; i < arguments.repeats; ++i) {
        surface = {};
        const auto start = std::chrono::steady_clock::now();
        surface = isoatlas::extract(volume, *arguments.tau, {.surface = arguments.options}, arguments.context);
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        if (i == 0) result["peak_bytes"] = bench::peak() - before;
    }
    result["seconds"] = seconds;
    result["points"] = surface.points.size();
    result["triangles"] = surface.triangles.size();
    if (arguments.check) result["check"] = check(volume, arguments, surface);
}

void run(const Arguments& arguments) {
    const isoatlas::Volume volume = bench::make(arguments.volume, arguments.sources);
    ordered_json result{{"size", volume.info.extent.size}, {"type", isoatlas::name_of(volume.info.type)}};
    if (arguments.tau) measure(arguments, volume, result);
    std::puts(result.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) try {
    run(parse(argc, argv));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_extract: %s\n", error.what());
    return 1;
}

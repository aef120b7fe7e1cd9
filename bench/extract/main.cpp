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
    if (argc < 2) throw std::runtime_error("usage: bench_extract VOLUME [TAU] [options]");
    Arguments arguments;
    arguments.volume = argv[1];
    arguments.options.ids = false;
    for (int i = 2; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&]() -> std::string {
            if (++i == argc) throw std::runtime_error(word + " needs a value");
            return argv[i];
        };
        if (word == "--threads")
            arguments.context.threads = std::stoi(value());
        else if (word == "--repeats")
            arguments.repeats = std::stoi(value());
        else if (word == "--cache")
            arguments.sources.cache = value();
        else if (word == "--data")
            arguments.sources.data = value();
        else if (word == "--open")
            arguments.options.boundary = isoatlas::Boundary::open;
        else if (word == "--full")
            arguments.options.style = isoatlas::SurfaceStyle::full;
        else if (word == "--ids")
            arguments.options.ids = true;
        else if (word == "--check")
            arguments.check = true;
        else if (word.starts_with("--") || arguments.tau)
            throw std::runtime_error("unknown option " + word);
        else
            arguments.tau = std::stod(word);
    }
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

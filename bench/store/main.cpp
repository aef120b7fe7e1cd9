// bench_store: what do a store and its queries cost?
//
//   bench_store build VOLUME STORE [--cache FOLDER] [--data FOLDER] [--threads N] [--repeats N] [--analysis]   VOLUME: as in bench_engine
//   bench_store surface STORE TAU [--threads N] [--repeats N]         the whole isosurface: warm, again, cold
//   bench_store steps STORE TAU [--threads N] [--repeats N]           steps of a Navigator by 0.5 % of the range, from TAU to its middle
//   bench_store fronts STORE TAU [--threads N] [--repeats N]          octree fronts, from TAU on by the same steps
//   bench_store object STORE TAU [--threads N] [--repeats N] [--voxels N]   one object of about that many voxels (1000)
//   bench_store decode VOLUME [--cache FOLDER] [--data FOLDER] [--repeats N]   bricks of the volume, on one thread: decoding.h
//   bench_store check STORE TAU VOLUME [--cache FOLDER] [--data FOLDER]   is the surface that of the volume, byte for byte?
//
// Each prints one JSON document. --analysis: in turns with an analysis of the volume in memory. Seconds are those of every repeat:
//   open   opening the store, the file's pages in memory     warm   the query of an open store that holds no bricks
//   again  the same query once more                          cold   opening and first query, the file's pages dropped before
//   copy   as many samples as that query needs, uncoded, from pages of the store that the system holds into new memory, in as many reads,
//          on one thread: what is left of reading if decoding and checking cost nothing
//   reading  so many samples as are classified, from memory, nothing else
//   exact  the whole surface, samples there                  front  the same as an octree front, of a query without a step before
//   step   from the isovalue before to this one, and of it the phases; classes: before the first
//   fresh  the query at this one of a store that holds no bricks
// compare_vtk.py runs all this beside VTK's Flying Edges on the same volume.
#include <isoatlas/isoatlas.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "cold.h"
#include "command_line.h"
#include "decoding.h"
#include "field/brick_grid.h"
#include "memory.h"
#include "phase_clock.h"
#include "volumes.h"

namespace bench {
namespace {

using isoatlas::Atlas;
using isoatlas::Surface;
using nlohmann::ordered_json;

struct Arguments {
    std::vector<std::string> words;
    Sources sources{"build/bench/volumes", ""};
    isoatlas::Context context;
    int repeats = 5;
    std::int64_t voxels = 1000;
    bool analysis = false;

    [[nodiscard]] const std::string& word(std::size_t i) const {
        if (i >= words.size()) throw std::runtime_error("too few arguments; the head of main.cpp lists them");
        return words[i];
    }
    [[nodiscard]] double tau() const { return std::stod(word(2)); }
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    arguments.words = bench::CommandLine()
                          .value("--cache", arguments.sources.cache)
                          .value("--data", arguments.sources.data)
                          .value("--threads", arguments.context.threads)
                          .value("--repeats", arguments.repeats)
                          .value("--voxels", arguments.voxels)
                          .flag("--analysis", arguments.analysis)
                          .read(argc, argv);
    return arguments;
}

/// A query of an open store, with the file's pages in memory: without bricks, then with those that it needs.
ordered_json measure_warm(const Arguments& arguments, const isoatlas::SurfaceOptions& options) {
    ordered_json result{{"open", ordered_json::array()}, {"warm", ordered_json::array()}, {"again", ordered_json::array()}};
    Surface surface;
    const auto extract = [&](const Atlas& atlas) { surface = atlas.extract(arguments.tau(), options, arguments.context); };
    for (int i = 0; i < arguments.repeats; ++i) result["open"].push_back(seconds_of([&] { const Atlas atlas(arguments.word(1)); }));
    const Atlas atlas(arguments.word(1));
    isoatlas::QueryCost needed;
    surface = atlas.extract(arguments.tau(), options, arguments.context, &needed);  // with what a store reads once
    const std::int64_t raw = needed.cells_visited * static_cast<std::int64_t>(isoatlas::size_of(atlas.info().type));
    const std::int64_t reads = needed.extents;
    for (int i = 0; i < arguments.repeats; ++i)
        result["copy"].push_back(seconds_of([&] { copy_to_new_memory(arguments.word(1), raw, reads); }));
    result["samples_bytes"] = raw;
    for (int i = 0; i < arguments.repeats; ++i) {
        surface = {};
        atlas.clear_cache();
        const isoatlas::AtlasReads before = atlas.reads();
        result["warm"].push_back(seconds_of([&] { extract(atlas); }));
        const isoatlas::AtlasReads after = atlas.reads();
        result["bytes"] = after.bytes - before.bytes;
        result["extents"] = after.extents - before.extents;
        result["bricks"] = after.bricks - before.bricks;
        surface = {};
        result["again"].push_back(seconds_of([&] { extract(atlas); }));
    }
    result["points"] = surface.points.size();
    result["triangles"] = surface.triangles.size();
    return result;
}

/// Opening and the first query, the file's pages dropped.
void measure_cold(const Arguments& arguments, const isoatlas::SurfaceOptions& options, ordered_json& result) {
    for (int i = 0; i < arguments.repeats; ++i) {
        drop_pages(arguments.word(1));
        const std::int64_t before = bytes_from_disk();
        std::unique_ptr<Atlas> atlas;
        const double opening = seconds_of([&] { atlas = std::make_unique<Atlas>(arguments.word(1)); });
        const double query = seconds_of([&] { (void)atlas->extract(arguments.tau(), options, arguments.context); });
        result["cold_open"].push_back(opening);
        result["cold"].push_back(opening + query);
        result["cold_disk_bytes"] = bytes_from_disk() - before;
    }
}

ordered_json measure(const Arguments& arguments, const isoatlas::SurfaceOptions& options) {
    ordered_json result = measure_warm(arguments, options);
    measure_cold(arguments, options, result);
    return result;
}

/// What a store holds beside an analysis, computed in memory: objects, cavities, and the numbers of the spectrum.
void answer(const isoatlas::Volume& volume, const isoatlas::Analysis& analysis, const isoatlas::Context& context) {
    constexpr std::int64_t kStored = 1024;  // objects
    (void)isoatlas::rank_both(volume, analysis, {.top = kStored}, context);
    (void)isoatlas::spectrum(volume, analysis, {}, context);
}

ordered_json build(const Arguments& arguments) {
    const isoatlas::Volume volume = make(arguments.word(1), arguments.sources);
    ordered_json seconds = ordered_json::array(), analysis = ordered_json::array(), answers = ordered_json::array();
    std::int64_t peak_bytes = 0;
    ordered_json phases = ordered_json::object();  // of the last build
    for (int i = 0; i < arguments.repeats; ++i) {
        PhaseClock clock;
        const std::int64_t before = reset_peak();
        seconds.push_back(seconds_of([&] { isoatlas::build_atlas(arguments.word(2), volume, {}, clock.watched(arguments.context)); }));
        if (i == 0) peak_bytes = peak() - before;  // before analyses leave memory to the process
        for (const auto& [phase, time] : clock.phases()) phases[phase] = time;
        if (!arguments.analysis) continue;
        std::optional<isoatlas::Analysis> analysed;
        analysis.push_back(seconds_of([&] { analysed.emplace(isoatlas::analyse(volume, {}, arguments.context)); }));
        if (!phases.contains("objects")) continue;  // the store has no answers but those of the analysis
        answers.push_back(analysis.back().get<double>() + seconds_of([&] { answer(volume, *analysed, arguments.context); }));
    }
    const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(arguments.word(2)));
    const std::int64_t voxels = volume.info.extent.voxels();
    return {{"volume", arguments.word(1)},
            {"size", volume.info.extent.size},
            {"type", isoatlas::name_of(volume.info.type)},
            {"voxels", voxels},
            {"seconds", seconds},
            {"analysis_seconds", analysis},
            {"answers_seconds", answers},
            {"phases", phases},
            {"peak_bytes", peak_bytes},
            {"bytes", bytes},
            {"bytes_per_voxel", static_cast<double>(bytes) / static_cast<double>(voxels)},
            {"sample_bytes", isoatlas::size_of(volume.info.type)}};
}

isoatlas::SurfaceOptions without_ids() {
    isoatlas::SurfaceOptions options;
    options.ids = false;
    return options;
}

ordered_json surface(const Arguments& arguments) {
    ordered_json result = measure(arguments, without_ids());
    result["active_cells"] = Atlas(arguments.word(1)).cut(arguments.tau(), {}, arguments.context).active_cells;
    return result;
}

/// 0.5 % of the range, from tau towards its middle.
double step_from(double tau, const Atlas& atlas) {
    const auto [low, high] = atlas.range();
    return (tau < 0.5 * (low + high) ? 0.005 : -0.005) * (high - low);
}

/// Steps towards the middle of the range, as a key that is held down makes them: each meets bricks that none before has read.
ordered_json measure_steps(const Arguments& arguments) {
    const isoatlas::SurfaceOptions options = without_ids();
    const Atlas walked(arguments.word(1)), fresh(arguments.word(1));
    isoatlas::Navigator navigator(walked, options);
    double tau = arguments.tau();
    const double step = step_from(tau, walked);
    navigator.go_to(tau, arguments.context);
    (void)fresh.extract(tau, options, arguments.context);  // what a store reads once
    ordered_json result{{"step", ordered_json::array()}, {"fresh", ordered_json::array()}};
    for (int i = 0; i < arguments.repeats; ++i) {
        tau += step;
        result["step"].push_back(seconds_of([&] { navigator.go_to(tau, arguments.context); }));
        fresh.clear_cache();
        result["fresh"].push_back(seconds_of([&] { (void)fresh.extract(tau, options, arguments.context); }));
    }
    return result;
}

/// Reads memory once, each thread its part, and does nothing with it: no classification of so many samples takes less time.
double reading(const std::vector<std::uint64_t>& words, int threads) {
    const std::size_t parts = static_cast<std::size_t>(std::max(threads, 1));
    std::vector<std::uint64_t> sums(parts);
    const double seconds = seconds_of([&] {
        std::vector<std::jthread> workers;
        for (std::size_t part = 0; part < parts; ++part) {
            workers.emplace_back([&, part] {
                const auto begin = words.begin() + static_cast<std::ptrdiff_t>(words.size() * part / parts);
                sums[part] = std::reduce(begin, words.begin() + static_cast<std::ptrdiff_t>(words.size() * (part + 1) / parts));
            });
        }
    });
    if (std::reduce(sums.begin(), sums.end()) == 0) throw std::runtime_error("the words add up to nothing");
    return seconds;
}

/// The samples of the bricks that a surface divides, at least.
std::int64_t bytes_classified(const Atlas& atlas, double tau) {
    return atlas.preview(tau).bricks.min * isoatlas::kBrickSize.product() * static_cast<std::int64_t>(isoatlas::size_of(atlas.info().type));
}

/// Three steps as above, then back to the first isovalue, again and again: samples are present from the first round on.
ordered_json measure_fronts(const Arguments& arguments) {
    const isoatlas::SurfaceOptions options = without_ids();
    const isoatlas::FrontOptions front{.max_level = 4};
    const Atlas atlas(arguments.word(1));
    isoatlas::Navigator navigator(atlas, options);
    const double step = step_from(arguments.tau(), atlas);
    ordered_json result;
    const std::int64_t bytes = bytes_classified(atlas, arguments.tau());
    const std::vector<std::uint64_t> samples(static_cast<std::size_t>(bytes / 8 + 1), 1);
    result["classified_bytes"].push_back(bytes);
    for (int i = -4; i < arguments.repeats; ++i) {
        const double tau = arguments.tau() + step * std::abs(i % 4);
        isoatlas::Surface surface;
        isoatlas::FrontSurface coarse, stepped;
        const double exact = seconds_of([&] { surface = atlas.extract(tau, options, arguments.context); });
        const double fresh = seconds_of([&] { coarse = atlas.extract_front(tau, front, options, arguments.context); });
        PhaseClock clock;
        const double by_step = seconds_of([&] {
            stepped = navigator.extract_front(tau, front, clock.watched(arguments.context));
            (void)clock.phases();  // ends the last one
        });
        if (stepped.surface.triangles != coarse.surface.triangles || stepped.surface.points != coarse.surface.points)
            throw std::runtime_error("a front is another one after a step");
        if (i < 0) continue;
        result["reading"].push_back(reading(samples, arguments.context.threads));
        result["exact"].push_back(exact), result["front"].push_back(fresh), result["step"].push_back(by_step);
        double classes = by_step;  // what comes before the first phase that a step reports
        for (const auto& [phase, seconds] : clock.phases()) result["step: " + phase].push_back(seconds), classes -= seconds;
        result["step: classes"].push_back(classes);
        result["exact_triangles"].push_back(surface.triangles.size()), result["triangles"].push_back(coarse.surface.triangles.size());
    }
    return result;
}

ordered_json object(const Arguments& arguments) {
    const isoatlas::Cut cut = Atlas(arguments.word(1)).cut(arguments.tau(), {}, arguments.context);
    if (cut.objects.empty()) throw std::runtime_error("there is no object at this isovalue");
    const auto distance = [&](const isoatlas::CutObject& o) { return std::abs(o.voxels - arguments.voxels); };
    const isoatlas::CutObject& chosen =
        *std::min_element(cut.objects.begin(), cut.objects.end(), [&](const auto& p, const auto& q) { return distance(p) < distance(q); });
    isoatlas::SurfaceOptions options = without_ids();
    options.objects = {chosen.id};
    ordered_json result = measure(arguments, options);
    result["object_voxels"] = chosen.voxels;
    return result;
}

ordered_json check(const Arguments& arguments) {
    const isoatlas::Volume volume = make(arguments.word(3), arguments.sources);
    const Atlas atlas(arguments.word(1));
    bool same = true;
    for (const isoatlas::Boundary boundary : {isoatlas::Boundary::closed, isoatlas::Boundary::open}) {
        isoatlas::SurfaceOptions options = without_ids();
        options.boundary = boundary;
        const Surface own = atlas.extract(arguments.tau(), options, arguments.context);
        const Surface other = isoatlas::extract(volume, arguments.tau(), {.surface = options}, arguments.context);
        same = same && own.points == other.points && own.triangles == other.triangles && own.normals == other.normals;
    }
    return {{"same_as_the_volume", same}};
}

ordered_json run(const Arguments& arguments) {
    const std::string& verb = arguments.word(0);
    if (verb == "build") return build(arguments);
    if (verb == "surface") return surface(arguments);
    if (verb == "steps") return measure_steps(arguments);
    if (verb == "fronts") return measure_fronts(arguments);
    if (verb == "object") return object(arguments);
    if (verb == "check") return check(arguments);
    if (verb == "decode") return measure_decoding(make(arguments.word(1), arguments.sources), arguments.repeats);
    throw std::runtime_error("unknown verb " + verb);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) try {
    std::puts(bench::run(bench::parse(argc, argv)).dump().c_str());
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_store: %s\n", error.what());
    return 1;
}

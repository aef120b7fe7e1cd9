// bench_render: where does the time of a picture go?
//
//   bench_render VOLUME [--cache FOLDER] [--data FOLDER] [--surface] [--size N] [--samples N] [--threads N] [--repeats N] [--flat]
//                [--step S] [--raw FILE] [--picture FILE] [--like FILE]
//
// VOLUME: as in bench_engine. It is drawn as matter with the opacity that its tree proposes, or (--surface) its first object, seen from 30
// degrees to the right and 20 above. Prints JSON: seconds of every phase and repeat, peak bytes of the first, what was drawn and how. --raw
// writes the samples, --picture the RGBA bytes. --like: with the opacity of an earlier run, whose JSON this is; nothing is analysed.
// compare_vtk.py runs this beside VTK's ray caster.
#include <isoatlas/isoatlas.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "command_line.h"
#include "memory.h"
#include "volumes.h"

namespace {

using nlohmann::ordered_json;

struct Arguments {
    std::string volume, raw, picture, like;
    bench::Sources sources{"build/bench/volumes", ""};
    bool surface = false;
    int repeats = 3;
    double step = 1;
    isoatlas::RenderOptions options{.width = 512, .height = 512, .background = isoatlas::Background::transparent, .samples = 1};
    isoatlas::Context context;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    std::int64_t size = arguments.options.width;
    const std::vector<std::string> words = bench::CommandLine()
                                               .value("--cache", arguments.sources.cache)
                                               .value("--data", arguments.sources.data)
                                               .flag("--surface", arguments.surface)
                                               .flag("--flat", [&] { arguments.options.shading = false; })
                                               .value("--size", size)
                                               .value("--samples", arguments.options.samples)
                                               .value("--threads", arguments.context.threads)
                                               .value("--step", arguments.step)
                                               .value("--repeats", arguments.repeats)
                                               .value("--raw", arguments.raw)
                                               .value("--picture", arguments.picture)
                                               .value("--like", arguments.like)
                                               .read(argc, argv);
    if (words.size() != 1) throw std::runtime_error("usage: bench_render VOLUME [options]");
    arguments.volume = words.front();
    arguments.options.width = arguments.options.height = size;
    return arguments;
}

void write(const std::string& path, const void* bytes, std::size_t size) {
    if (path.empty()) return;
    std::ofstream out(path, std::ios::binary);
    out.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    if (!out) throw std::runtime_error("cannot write " + path);
}

/// Seconds on the clock by name, in the order in which they come.
class Phases {
public:
    void begin(const std::string& name) {
        end();
        name_ = name, start_ = std::chrono::steady_clock::now(), processor_start_ = std::clock();
    }
    void end() {
        if (name_.empty()) return;
        seconds_[name_].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
        processor_[name_].push_back(static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC);
        name_.clear();
    }
    [[nodiscard]] const ordered_json& seconds() const { return seconds_; }
    /// Of all threads together: what it costs while others use the machine too.
    [[nodiscard]] const ordered_json& processor_seconds() const { return processor_; }

private:
    std::string name_;
    std::chrono::steady_clock::time_point start_;
    std::clock_t processor_start_ = 0;
    ordered_json seconds_ = ordered_json::object(), processor_ = ordered_json::object();
};

std::array<double, 2> range_of(const isoatlas::Volume& volume) {
    return isoatlas::visit_samples(volume, [](auto samples) {
        const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
        return std::array<double, 2>{static_cast<double>(*low), static_cast<double>(*high)};
    });
}

ordered_json json_of(const std::vector<isoatlas::OpacityTent>& tents) {
    ordered_json bumps = ordered_json::array();
    for (const isoatlas::OpacityTent& bump : tents) {
        bumps.push_back({{"low", bump.low},
                         {"high", bump.high},
                         {"ramp", bump.ramp},
                         {"density", bump.density},
                         {"colour", {bump.colour.red, bump.colour.green, bump.colour.blue}}});
    }
    return bumps;
}

std::vector<isoatlas::OpacityTent> tents_of(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::vector<isoatlas::OpacityTent> tents;
    const ordered_json document = ordered_json::parse(file);
    for (const ordered_json& bump : document.at("bumps")) {
        const std::vector<double> colour = bump.at("colour");
        tents.push_back({.low = bump.at("low"),
                         .high = bump.at("high"),
                         .colour = {colour.at(0), colour.at(1), colour.at(2)},
                         .density = bump.at("density"),
                         .ramp = bump.at("ramp")});
    }
    return tents;
}

isoatlas::ObjectTable table_of(const isoatlas::Volume& volume, const Arguments& arguments, Phases& phases) {
    phases.begin("analyse");
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {}, arguments.context);
    isoatlas::ObjectTable table = rank_objects(volume, analysis, {.top = 5}, arguments.context);
    phases.end();
    return table;
}

isoatlas::Scene scene_of(const isoatlas::Volume& volume, const Arguments& arguments, Phases& phases) {
    isoatlas::Scene scene;
    if (arguments.surface) {
        const isoatlas::ObjectTable table = table_of(volume, arguments, phases);
        phases.begin("extract");
        if (table.entries.empty()) throw std::runtime_error("no object");
        isoatlas::Surface surface = isoatlas::extract(volume, table.entries[0].best_tau,
                                                      {.surface = {.objects = {}, .contours = {}, .ids = false}}, arguments.context);
        scene.objects.push_back({.surface = std::move(surface), .colour = isoatlas::palette(0)});
        phases.end();
        return scene;
    }
    const std::array<double, 2> range = range_of(volume);
    std::vector<isoatlas::OpacityTent> tents =
        arguments.like.empty() ? propose_transfer(table_of(volume, arguments, phases), volume.info, range) : tents_of(arguments.like);
    scene.volume = {.volume = &volume, .tents = std::move(tents), .range = range, .sample_distance = arguments.step};
    return scene;
}

void measure(Arguments arguments) {
    Phases phases;
    phases.begin("load");
    const isoatlas::Volume volume = bench::make(arguments.volume, arguments.sources);
    phases.end();
    write(arguments.raw, volume.bytes.data(), volume.bytes.size());
    const isoatlas::Scene scene = scene_of(volume, arguments, phases);
    const isoatlas::View view = isoatlas::view_from(30, 20);
    const isoatlas::Camera camera = fit_camera(scene, view, arguments.options);
    isoatlas::Image image;
    const std::int64_t before = bench::reset_peak();
    std::int64_t peak_bytes = 0;
    for (int i = 0; i < arguments.repeats; ++i) {
        arguments.context.progress = [&](const isoatlas::Progress& progress) {
            if (progress.fraction == 0) phases.begin(progress.phase == "draw" ? "draw" : "prepare");
        };
        image = render_scene(scene, camera, arguments.options, arguments.context);
        phases.end();
        if (i == 0) peak_bytes = bench::peak() - before;
    }
    write(arguments.picture, image.rgba.data(), image.rgba.size());
    const isoatlas::VolumeInfo& info = volume.info;
    const ordered_json result{{"seconds", phases.seconds()},
                              {"processor_seconds", phases.processor_seconds()},
                              {"peak_bytes", peak_bytes},
                              {"size", info.extent.size},
                              {"type", name_of(info.type)},
                              {"spacing", info.geometry.spacing},
                              {"origin", info.geometry.origin},
                              {"direction", info.geometry.direction},
                              {"triangles", arguments.surface ? scene.objects[0].surface.triangles.size() : 0},
                              {"bumps", json_of(scene.volume.tents)},
                              {"camera", {{"target", camera.target}, {"toward", view.toward}, {"up", view.up}, {"height", camera.height}}}};
    std::puts(result.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) try { measure(parse(argc, argv)); } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_render: %s\n", error.what());
    return 1;
}

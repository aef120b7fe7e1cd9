// bench_projection: image order beside object order, time and error against the integral.
//
//   bench_projection VOLUME [--cache FOLDER] [--data FOLDER] [--size N] [--around DEGREES] [--pictures FOLDER]
//
// VOLUME: as in bench_engine. Two layers of matter, thin and thick, by the range of its values; seen from 30 degrees to the right, or
// --around, and 20 above. Prints a table: ray casting at several steps, splatting with several kernels, shear-warp; one thread.
#include <isoatlas/isoatlas.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "volumes.h"

namespace {

using isoatlas::ProjectionMethod;

struct Arguments {
    std::string volume, pictures;
    bench::Sources sources{"build/bench/volumes", ""};
    std::int64_t size = 256;
    double around = 30;
};

Arguments parse(int argc, char** argv) {
    if (argc < 2) throw std::runtime_error("usage: bench_projection VOLUME [options]");
    Arguments arguments;
    arguments.volume = argv[1];
    for (int i = 2; i + 1 < argc; i += 2) {
        const std::string word = argv[i], value = argv[i + 1];
        if (word == "--cache")
            arguments.sources.cache = value;
        else if (word == "--data")
            arguments.sources.data = value;
        else if (word == "--size")
            arguments.size = std::stoll(value);
        else if (word == "--around")
            arguments.around = std::stod(value);
        else if (word == "--pictures")
            arguments.pictures = value;
        else
            throw std::runtime_error("unknown option " + word);
    }
    return arguments;
}

isoatlas::SceneVolume matter_of(const isoatlas::Volume& volume) {
    const std::array<double, 2> range = isoatlas::visit_samples(volume, [](auto samples) {
        const auto [first, last] = std::minmax_element(samples.begin(), samples.end());
        return std::array<double, 2>{static_cast<double>(*first), static_cast<double>(*last)};
    });
    const auto at = [&](double part) { return range[0] + part * (range[1] - range[0]); };
    const auto& spacing = volume.info.geometry.spacing;
    const double voxel = std::min({spacing[0], spacing[1], spacing[2]});
    isoatlas::SceneVolume matter{.volume = &volume, .range = range};
    matter.curves = {
        {.points = {{at(0.12), 0}, {at(0.2), isoatlas::extinction_of(0.03, voxel)}, {at(0.4), 0}}, .colour = {0.3, 0.7, 0.3}},
        {.points = {{at(0.4), 0}, {at(0.55), isoatlas::extinction_of(0.3, voxel)}, {at(1), isoatlas::extinction_of(0.3, voxel)}},
         .colour = {0.95, 0.85, 0.7}}};
    return matter;
}

void print_row(const std::string& name, double seconds, const isoatlas::ProjectedPicture& picture, const isoatlas::PictureError& error) {
    std::printf("| %-22s | %8.3f | %11.3f | %9.5f | %8.4f |\n", name.c_str(), seconds, static_cast<double>(picture.samples) * 1e-6,
                error.root_mean_square, error.largest);
}

void measure(const Arguments& arguments) {
    const isoatlas::Volume volume = bench::make(arguments.volume, arguments.sources);
    isoatlas::Scene scene;
    scene.volume = matter_of(volume);
    isoatlas::ProjectionOptions options{.width = arguments.size, .height = arguments.size};
    const isoatlas::Camera camera =
        fit_camera(scene, isoatlas::view_from(arguments.around, 20), {.width = arguments.size, .height = arguments.size});
    const isoatlas::ProjectedPicture exact = projected_integral(scene.volume, camera, options);
    std::puts("| method                 | seconds  | 10^6 values | RMS error | largest  |");
    std::puts("|---|---|---|---|---|");
    const auto run = [&](ProjectionMethod method, const std::string& beside) {
        const auto start = std::chrono::steady_clock::now();
        const isoatlas::ProjectedPicture picture = project_by(method, scene.volume, camera, options);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const std::string name(info_of(method).name);
        print_row(name + beside, seconds, picture, picture_error(picture, exact));
        if (!arguments.pictures.empty()) write_image(arguments.pictures + "/" + name + ".png", image_of(picture));
    };
    for (const double step : {4.0, 2.0, 1.0, 0.5, 0.25}) {
        options.step = step;
        run(ProjectionMethod::ray_casting, ", step " + std::to_string(step).substr(0, 4));
    }
    for (const double kernel : {0.45, 0.6, 0.8}) {
        options.kernel = kernel;
        run(ProjectionMethod::splatting, ", kernel " + std::to_string(kernel).substr(0, 4));
    }
    run(ProjectionMethod::shear_warp, "");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        measure(parse(argc, argv));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_projection: %s\n", error.what());
        return 1;
    }
}

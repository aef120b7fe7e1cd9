// bench_extract: how long does a surface take, without any index?
//
//   bench_extract --make SIZE FILE.raw                      writes the smooth field: float32, SIZE^3, 60 cosines of 2 to 10 periods a side
//   bench_extract FILE.raw SIZE TAU [--threads N] [--repeats N] [--open] [--full] [--ids] [--check]
//                                                           prints JSON: seconds of every repeat, counts, and what --check found
//
// compare_vtk.py runs this beside VTK's Flying Edges on the same file.
#include <isoatlas/isoatlas.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using nlohmann::ordered_json;

struct Arguments {
    std::string file;
    std::int64_t size = 0;
    double tau = 0;
    int repeats = 5;
    bool check = false;
    isoatlas::Context context;
    isoatlas::SurfaceOptions options;
};

Arguments parse(int argc, char** argv) {
    if (argc < 4) throw std::runtime_error("usage: bench_extract FILE.raw SIZE TAU [options], or bench_extract --make SIZE FILE.raw");
    Arguments arguments;
    arguments.file = argv[1];
    arguments.size = std::stoll(argv[2]);
    arguments.tau = std::stod(argv[3]);
    arguments.options.ids = false;
    for (int i = 4; i < argc; ++i) {
        const std::string word = argv[i];
        const auto number = [&] {
            if (++i == argc) throw std::runtime_error(word + " needs a value");
            return std::stoi(argv[i]);
        };
        if (word == "--threads")
            arguments.context.threads = number();
        else if (word == "--repeats")
            arguments.repeats = number();
        else if (word == "--open")
            arguments.options.boundary = isoatlas::Boundary::open;
        else if (word == "--full")
            arguments.options.style = isoatlas::SurfaceStyle::full;
        else if (word == "--ids")
            arguments.options.ids = true;
        else if (word == "--check")
            arguments.check = true;
        else
            throw std::runtime_error("unknown option " + word);
    }
    return arguments;
}

/// Sum of products of cosines: one table per axis and cosine, so that a large field is made quickly.
void make_field(std::int64_t size, const std::string& file) {
    constexpr int kWaves = 60;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> periods(2, 10), phase(0, 2 * std::numbers::pi);
    std::uniform_int_distribution<int> sign(0, 1);
    const auto n = static_cast<std::size_t>(size);
    std::vector<std::vector<float>> cosine(3 * kWaves, std::vector<float>(n)), sine = cosine;
    for (std::size_t wave = 0; wave < cosine.size(); ++wave) {
        const double frequency = periods(random) / std::sqrt(3.0) * (sign(random) != 0 ? 1 : -1), shift = phase(random);
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * frequency * static_cast<double>(i) / static_cast<double>(n) + shift;
            cosine[wave][i] = static_cast<float>(std::cos(angle));
            sine[wave][i] = static_cast<float>(std::sin(angle));
        }
    }
    std::ofstream out(file, std::ios::binary);
    std::vector<float> row(n);
    for (std::size_t z = 0; z < n; ++z) {
        for (std::size_t y = 0; y < n; ++y) {
            std::fill(row.begin(), row.end(), 0.0F);
            for (std::size_t wave = 0; wave < kWaves; ++wave) {  // cos(a + b + c) by the addition theorems
                const float cy = cosine[3 * wave + 1][y], sy = sine[3 * wave + 1][y], cz = cosine[3 * wave + 2][z],
                            sz = sine[3 * wave + 2][z];
                const float c = cy * cz - sy * sz, s = sy * cz + cy * sz;
                for (std::size_t x = 0; x < n; ++x) row[x] += cosine[3 * wave][x] * c - sine[3 * wave][x] * s;
            }
            out.write(reinterpret_cast<const char*>(row.data()), static_cast<std::streamsize>(n * sizeof(float)));
        }
    }
    out.close();
    if (!out) throw std::runtime_error("cannot write " + file);
}

isoatlas::Volume read_field(const Arguments& arguments) {
    isoatlas::Extent extent;
    extent.size = {arguments.size, arguments.size, arguments.size};
    isoatlas::Volume volume = isoatlas::make_volume(extent, isoatlas::ValueType::f32);
    std::ifstream in(arguments.file, std::ios::binary);
    in.read(reinterpret_cast<char*>(volume.bytes.data()), static_cast<std::streamsize>(volume.bytes.size()));
    if (!in) throw std::runtime_error("cannot read " + arguments.file);
    return volume;
}

ordered_json check(const isoatlas::Volume& volume, const Arguments& arguments, const isoatlas::Surface& surface) {
    const isoatlas::SurfaceReport report = isoatlas::inspect(surface.points, surface.triangles);
    const isoatlas::Cut cut = isoatlas::cut(volume, arguments.tau, {}, arguments.context);
    return {{"components", report.component_chi.size()},
            {"closed", report.is_closed()},
            {"manifold", report.is_manifold()},
            {"oriented", report.is_oriented()},
            {"zero_area_triangles", report.zero_area_triangles},
            {"contours_of_the_cut", cut.contours.size()}};
}

void measure(const Arguments& arguments) {
    const isoatlas::Volume volume = read_field(arguments);
    ordered_json seconds = ordered_json::array();
    isoatlas::Surface surface;
    for (int i = 0; i < arguments.repeats; ++i) {
        surface = {};
        const auto start = std::chrono::steady_clock::now();
        surface = isoatlas::extract(volume, arguments.tau, {.surface = arguments.options}, arguments.context);
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    ordered_json result{{"seconds", seconds}, {"points", surface.points.size()}, {"triangles", surface.triangles.size()}};
    if (arguments.check) result["check"] = check(volume, arguments, surface);
    std::puts(result.dump().c_str());
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc == 4 && std::strcmp(argv[1], "--make") == 0)
        make_field(std::stoll(argv[2]), argv[3]);
    else
        measure(parse(argc, argv));
} catch (const std::exception& error) {
    std::fprintf(stderr, "bench_extract: %s\n", error.what());
    return 1;
}

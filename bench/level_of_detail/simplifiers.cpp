// bench_simplifiers: what other libraries make of a mesh, for compare.py.
//
//   bench_simplifiers METHOD MESH OUT [--error LENGTH] [--triangles N]
//
// METHOD: meshoptimizer (with --error at that error, else down to N triangles), cgal (Lindstrom and Turk down to N triangles),
// cgal-envelope (within --error of the mesh). Writes OUT, a surface file, and prints JSON: triangles, seconds of the simplification alone,
// on one thread.
#include <meshoptimizer.h>

#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "cgal_collapse.h"
#include "command_line.h"

namespace {

bench::Collapsed with_meshoptimizer(const isoatlas::Mesh& mesh, double error, std::int64_t triangles) {
    std::vector<float> points;
    for (const auto& point : mesh.points)
        for (const double x : point) points.push_back(static_cast<float>(x));
    std::vector<unsigned> corners, kept(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
        for (const std::int64_t corner : triangle) corners.push_back(static_cast<unsigned>(corner));
    constexpr std::size_t kStride = 3 * sizeof(float);
    const float scale = meshopt_simplifyScale(points.data(), mesh.points.size(), kStride);
    const float limit = error > 0 ? static_cast<float>(error) / scale : std::numeric_limits<float>::max();
    bench::Collapsed result;
    result.seconds = bench::seconds_of([&] {
        kept.resize(meshopt_simplify(kept.data(), corners.data(), corners.size(), points.data(), mesh.points.size(), kStride,
                                     static_cast<std::size_t>(3 * triangles), limit, 0, nullptr));
    });
    std::vector<std::int64_t> number(mesh.points.size(), -1);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        std::int64_t& point = number[kept[i]];
        if (point < 0) {
            point = static_cast<std::int64_t>(result.surface.points.size());
            result.surface.points.push_back(mesh.points[kept[i]]);
        }
        if (i % 3 == 0) result.surface.triangles.emplace_back();
        result.surface.triangles.back()[i % 3] = point;
    }
    return result;
}

int run(int argc, char** argv) {
    double error = 0;
    std::int64_t triangles = 0;
    const std::vector<std::string> words = bench::CommandLine().value("--error", error).value("--triangles", triangles).read(argc, argv);
    if (words.size() != 3) throw std::runtime_error("usage: bench_simplifiers METHOD MESH OUT [--error LENGTH] [--triangles N]");
    isoatlas::Mesh mesh = isoatlas::read_mesh(words[1]);
    bench::Collapsed result;
    if (words[0] == "meshoptimizer")
        result = with_meshoptimizer(mesh, error, triangles);
    else if (words[0] == "cgal")
        result = bench::collapse_with_cgal(mesh, 0, triangles);
    else if (words[0] == "cgal-envelope")
        result = bench::collapse_with_cgal(mesh, error, triangles);
    else
        throw std::runtime_error("unknown method " + words[0]);
    result.surface.space = mesh.space, result.surface.unit = mesh.unit;
    isoatlas::write_surface(words[2], result.surface, {.space = isoatlas::PointSpace::volume});
    const nlohmann::ordered_json told{{"triangles", result.surface.triangles.size()}, {"seconds", result.seconds}};
    std::puts(told.dump().c_str());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_simplifiers: %s\n", error.what());
        return 1;
    }
}

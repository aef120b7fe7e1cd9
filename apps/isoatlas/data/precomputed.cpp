#include "data/precomputed.h"

#include <algorithm>

#include <fmt/format.h>

#include "data/session.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

void add(std::vector<PrecomputedLevel>& sums, const OctreeMesh& mesh) {
    const auto count = [](const OctreeLevel& level) {
        PrecomputedLevel counted{.fragments = std::ssize(level.fragments), .distance = level.distance};
        for (const OctreeFragment& fragment : level.fragments) counted.triangles += std::ssize(fragment.triangles);
        return counted;
    };
    while (sums.size() < mesh.levels.size()) sums.push_back(sums.empty() ? PrecomputedLevel{} : sums.back());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const PrecomputedLevel level = count(mesh.levels[std::min(i, mesh.levels.size() - 1)]);
        sums[i].triangles += level.triangles, sums[i].fragments += level.fragments;
        sums[i].distance = std::max(sums[i].distance, level.distance);
    }
}

}  // namespace

bool is_precomputed(const std::string& output) { return lower_extension(output) == kPrecomputedExtension; }

void check_precomputed(const Arguments& arguments) {
    if (!is_precomputed(arguments.output)) return;
    const char* option = nullptr;
    if (arguments.split) option = "--split";
    if (arguments.space) option = "--space";
    if (arguments.for_print) option = "--for-print";
    if (arguments.simplification.is_asked_for()) option = "--simplify, --simplify-error or --triangles";
    if (arguments.octree.is_asked_for()) option = "--octree";
    if (option == nullptr) return;
    throw Error(ErrorKind::usage,
                {.file = arguments.output,
                 .what = std::string(option) + " does not apply to .precomputed, a folder of all levels of detail of each object",
                 .next = "omit it, or write .glb"});
}

std::vector<PrecomputedLevel> write_precomputed(const std::string& output, std::span<const NamedSurface> surfaces, const VolumeInfo& info,
                                                const Context& context) {
    PrecomputedMeshes meshes(output, info);
    std::vector<PrecomputedLevel> levels;
    for (const NamedSurface& one : surfaces) {
        const OctreeMesh mesh = make_octree_mesh(one.surface, info.geometry, info.extent, {}, context);
        meshes.add(one.name, one.surface.reported_tau, mesh);
        add(levels, mesh);
    }
    const WritingGuard guard;
    meshes.commit();
    return levels;
}

std::string levels_text(std::span<const PrecomputedLevel> levels) {
    std::string text = "levels of ";
    for (std::size_t i = 0; i < levels.size(); ++i) {
        text += (i == 0 ? "" : ", ") + (i == 0 ? counted(levels[i].triangles, "triangle") : count_text(levels[i].triangles));
        if (levels[i].distance > 0) text += fmt::format(" within {:.3g}", levels[i].distance) + (i == 1 ? " voxels" : "");
    }
    return text + ", with the same topology";
}

Json levels_json(std::span<const PrecomputedLevel> levels) {
    if (levels.empty()) return nullptr;
    Json list = Json::array();
    for (const PrecomputedLevel& level : levels)
        list.push_back({{"triangles", level.triangles}, {"fragments", level.fragments}, {"distance", level.distance}});
    return list;
}

}  // namespace isoatlas::cli

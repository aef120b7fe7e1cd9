#include "data/coarser.h"

#include <algorithm>

#include <fmt/format.h>

namespace isoatlas::cli {

void check_coarser(const Arguments& arguments) {
    if (arguments.coarser == 0) return;
    if (!arguments.output.ends_with(".glb")) {
        throw Error(ErrorKind::usage, {.file = arguments.output,
                                       .what = "only .glb holds coarser versions of a surface",
                                       .next = "write .glb, or take --simplify instead of --coarser"});
    }
    if (arguments.simplification.is_asked_for() || arguments.for_print) {
        const std::string other = arguments.for_print ? "--for-print" : "--simplify, --simplify-error or --triangles";
        throw Error(ErrorKind::usage, {.what = "--coarser and " + other + " contradict each other", .next = "omit one of them"});
    }
}

std::vector<SimplifiedSurface> coarser_versions(const Surface& surface, const VolumeInfo& info, CoarserVersions& sum,
                                                const Context& context) {
    if (!surface.segments.empty()) {
        throw Error(ErrorKind::usage,
                    {.file = info.path, .what = "curves of a 2D volume have no coarser versions", .next = "omit --coarser"});
    }
    const ClusterHierarchy hierarchy = make_clusters(surface, info.geometry, info.extent, {.unit = DistanceUnit::physical}, context);
    std::vector<SimplifiedSurface> versions = coarser_surfaces(hierarchy, sum.most);
    sum.length_unit = surface.unit;
    sum.list.resize(std::max(sum.list.size(), versions.size()));
    for (std::size_t i = 0; i < sum.list.size(); ++i) {
        const bool has_version = i < versions.size();
        const Surface& coarsest = versions.empty() ? surface : versions.back().surface;
        sum.list[i].triangles += static_cast<std::int64_t>((has_version ? versions[i].surface : coarsest).triangles.size());
        if (has_version) sum.list[i].distance = std::max(sum.list[i].distance, versions[i].distance);
    }
    return versions;
}

std::string coarser_text(const CoarserVersions& versions) {
    if (versions.list.empty()) return "no coarser versions: the topology needs all triangles";
    const std::string unit = versions.length_unit.empty() ? "" : " " + versions.length_unit;
    std::string text = "coarser versions of ";
    for (std::size_t i = 0; i < versions.list.size(); ++i) {
        const CoarserVersions::Version& version = versions.list[i];
        text += fmt::format("{}{}{} within {:.3g}{}", i == 0 ? "" : ", ", version.triangles, i == 0 ? " triangles" : "", version.distance,
                            unit);
    }
    return text + ", with the same topology";
}

Json coarser_json(const CoarserVersions& versions) {
    if (versions.most == 0) return nullptr;
    Json list = Json::array();
    for (const CoarserVersions::Version& version : versions.list) {
        list.push_back({{"triangles", version.triangles}, {"distance", version.distance}});
    }
    return list;
}

}  // namespace isoatlas::cli

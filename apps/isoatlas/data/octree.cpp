#include "data/octree.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "options/words.h"

namespace isoatlas::cli {

void check_octree(const Arguments& arguments) {
    const auto contradicts = [](const std::string& option, const std::string& other) {
        throw Error(ErrorKind::usage, {.what = option + " and " + other + " contradict each other", .next = "omit one of them"});
    };
    if (arguments.octree.pixels && arguments.octree.eye.empty())
        throw Error(ErrorKind::usage, {.what = "--octree-pixels are seen from an eye", .next = "add --eye X,Y,Z"});
    if (!arguments.octree.is_asked_for()) {
        if (arguments.octree.error)
            throw Error(ErrorKind::usage, {.what = "--octree-error is a limit of --octree", .next = "add --octree CELLS"});
        if (!arguments.octree.eye.empty())
            throw Error(ErrorKind::usage, {.what = "--eye makes blocks of --octree smaller", .next = "add --octree CELLS"});
        return;
    }
    if (arguments.octree.error && !arguments.octree.eye.empty()) contradicts("--octree-error", "--eye");
    if (!std::has_single_bit(static_cast<unsigned>(arguments.octree.cells)))
        throw Error(ErrorKind::usage,
                    {.what = "--octree " + std::to_string(arguments.octree.cells), .expected = "2, 4, 8, 16 or 32 cells"});
    if (arguments.boundary == Boundary::open) contradicts("--octree", "--boundary open");
    if (arguments.simplification.is_asked_for()) contradicts("--octree", "--simplify, --simplify-error and --triangles");
    if (arguments.coarser > 0) contradicts("--octree", "--coarser");
    if (arguments.inputs.are_labels && !arguments.tau && !arguments.best) contradicts("--octree", "labels");
}

FrontOptions OctreeUse::options(const Geometry& geometry) const {
    FrontOptions options;
    options.max_level = std::countr_zero(static_cast<unsigned>(asked.cells));
    if (asked.error) options.deviation = *asked.error;
    if (!asked.eye.empty()) {
        options.from = viewpoint_of_picture(parse_vector("--eye", asked.eye, 0), std::ranges::min(geometry.spacing));
        options.pixels = asked.pixels.value_or(1);
    }
    return options;
}

Surface OctreeUse::take(FrontSurface front) {
    *this += {asked, front.deviation, front.pixels, std::move(front.leaves)};
    return std::move(front.surface);
}

OctreeUse& OctreeUse::operator+=(const OctreeUse& other) {
    deviation = std::max(deviation, other.deviation), pixels = std::max(pixels, other.pixels);
    leaves.resize(std::max(leaves.size(), other.leaves.size()));
    for (std::size_t level = 0; level < other.leaves.size(); ++level) leaves[level] += other.leaves[level];
    return *this;
}

std::string octree_text(const OctreeUse& use) {
    std::string text;
    for (std::size_t level = use.leaves.size(); level-- > 0;) {
        if (use.leaves[level] == 0) continue;
        text += fmt::format("{}{} of {}", text.empty() ? "blocks of cells: " : ", ", use.leaves[level], 1 << level);
    }
    const std::string within =
        std::isfinite(use.deviation) ? fmt::format("points of the exact surface within {:.3g} voxels, ", use.deviation) : "";
    const std::string seen = std::isfinite(use.pixels) ? fmt::format("{:.2g} pixels from the eye, ", use.pixels) : "";
    return text + "; " + within + seen + "with the same topology";
}

Json octree_json(const OctreeUse& use) {
    Json json{{"cells", use.asked.cells}};
    json["deviation"] = std::isfinite(use.deviation) ? Json(use.deviation) : Json(nullptr);
    json["pixels"] = std::isfinite(use.pixels) ? Json(use.pixels) : Json(nullptr);
    Json& leaves = json["leaves"] = Json::array();
    for (std::size_t level = 0; level < use.leaves.size(); ++level) leaves.push_back({{"cells", 1 << level}, {"count", use.leaves[level]}});
    return json;
}

}  // namespace isoatlas::cli

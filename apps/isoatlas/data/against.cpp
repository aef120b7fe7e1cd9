#include "data/against.h"

#include <algorithm>

#include <fmt/format.h>

namespace isoatlas::cli {
namespace {

void check_choice(const Arguments& arguments) {
    const bool has_tau =
        arguments.tau || !arguments.objects.empty() || std::ranges::any_of(arguments.contours, [](const ObjectReference& contour) {
            return contour.tau || contour.kind == ObjectReference::Kind::cavity || contour.kind == ObjectReference::Kind::name;
        });
    if (has_tau) return;
    throw Error(ErrorKind::usage, {.what = "against the surface of which isovalue?",
                                   .expected = "--tau T, or --object REF, as the mesh was extracted",
                                   .next = "isoatlas objects " + shell_word(arguments.file) + " lists isovalues and objects"});
}

/// The surface of everything or of the objects and contours of the command line, at one isovalue.
Surface exact_surface(const Arguments& arguments, Sides& sides, Source*& source) {
    std::vector<ChosenObject> chosen = sides.find(arguments.objects, arguments.tau);
    for (ChosenObject& contour : sides.find_contours(arguments.contours, arguments.tau)) chosen.push_back(std::move(contour));
    sides.release_trees();
    const auto is_as_first = [&](const ChosenObject& one) { return one.tau == chosen[0].tau && one.polarity == chosen[0].polarity; };
    if (!std::ranges::all_of(chosen, is_as_first))
        throw Error(ErrorKind::usage, {.what = "the objects are at several isovalues, which is several surfaces",
                                       .next = "verify one at a time: write them with --split, and give one --object REF"});
    source = chosen.empty() ? &sides.main() : &sides.source(chosen[0]);
    SurfaceOptions options{
        .boundary = arguments.boundary, .style = arguments.style, .objects = {}, .contours = {}, .shell = arguments.shell};
    for (const ChosenObject& one : chosen) (one.is_contour ? options.contours : options.objects).push_back(one.voxel);
    Surface surface = source->extract(chosen.empty() ? source->tau() : chosen[0].tau, options);
    if (source->info().extent.rank == 2)
        throw Error(ErrorKind::unsupported,
                    {.file = arguments.file,
                     .what = "it has 2 dimensions, and at an isovalue curves, no surface",
                     .next = "isoatlas verify " + shell_word(arguments.file) + " compares the curves with the tree"});
    return surface;
}

Json pair_of(const DistanceBounds& bounds) { return Json::array({bounds.lower, bounds.upper}); }

/// Infinite where one of both surfaces is empty: null.
Json distance_json(const DistanceBounds& to_exact, const DistanceBounds& from_exact, const Json& unit) {
    return {{"unit", unit}, {"mesh_to_exact", pair_of(to_exact)}, {"exact_to_mesh", pair_of(from_exact)}};
}

std::string between(const DistanceBounds& one, const DistanceBounds& other) {
    const double lower = std::max(one.lower, other.lower), upper = std::max(one.upper, other.upper);
    return upper == 0 ? "0" : fmt::format("{:.4g} to {:.4g}", lower, upper);
}

std::string distance_text(const SimplifiedReport& report, const std::string& unit) {
    const auto direction = [&](const std::string& name, const DistanceBounds& voxels, const DistanceBounds& lengths) {
        const std::string length = unit.empty() ? "" : fmt::format(" ({} {})", between(lengths, lengths), unit);
        return fmt::format("{} {} voxels{}", name, between(voxels, voxels), length);
    };
    return "greatest distance: " + direction("mesh to exact surface", report.to_exact_in_voxels, report.to_exact) + ", " +
           direction("back", report.from_exact_in_voxels, report.from_exact);
}

}  // namespace

AgainstSurface verify_against(const Arguments& arguments, Terminal& terminal) {
    check_choice(arguments);
    const Mesh mesh = read_mesh(arguments.mesh);
    Sides sides(arguments, terminal);
    Source* source = nullptr;
    const Surface exact = exact_surface(arguments, sides, source);
    const VolumeInfo& info = source->info();
    SimplifiedOptions options;
    options.space = arguments.space.value_or(PointSpace::lps);
    options.in_voxels = arguments.max_distance.has_value();
    options.max_distance = options.in_voxels ? arguments.max_distance : arguments.max_error;
    AgainstSurface result{document("verify", info, source->interpolant(), source->tunnel_height(), arguments.boundary), {}, {}};
    try {
        result.report = verify_simplified(mesh, exact, info, options, source->context());
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        ErrorText text = error.text();
        text.file = arguments.mesh;
        throw Error(ErrorKind::input, text);
    }
    const SimplifiedReport& report = result.report;
    result.head["what"] = "mesh";
    result.head["file"] = arguments.mesh;
    result.head["tau"] = exact.reported_tau;
    result.head["points"] = mesh.points.size();
    result.head["triangles"] = mesh.triangles.size();
    result.head["contours"] = report.contours;
    result.head["genus"] = report.genus ? Json(*report.genus) : Json(nullptr);
    result.head["exact"] = {{"triangles", report.exact_triangles}, {"contours", report.exact_contours}, {"genus", report.exact_genus}};
    result.head["distance"] = nullptr;
    if (!report.is_measured) return result;
    const Json unit = exact.unit.empty() ? Json(nullptr) : Json(exact.unit);
    result.head["distance"] = {{"voxels", distance_json(report.to_exact_in_voxels, report.from_exact_in_voxels, "voxels")},
                               {"lengths", distance_json(report.to_exact, report.from_exact, unit)}};
    result.distances = distance_text(report, exact.unit);
    return result;
}

}  // namespace isoatlas::cli

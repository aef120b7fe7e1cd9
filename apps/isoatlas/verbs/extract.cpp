// isoatlas extract: the surface at an isovalue, of everything, some objects, or some contours.
#include <algorithm>

#include <fmt/format.h>

#include "data/chosen_surfaces.h"
#include "data/coarser.h"
#include "data/octree.h"
#include "data/precomputed.h"
#include "data/print_surface.h"
#include "data/sides.h"
#include "data/simplify.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

void check_extract_arguments(const Arguments& arguments) {
    const bool chooses = !arguments.objects.empty() || arguments.best || arguments.top > 0;
    const bool has_contours = std::ranges::any_of(arguments.contours, [](const ObjectReference& contour) {
        return contour.tau || contour.kind == ObjectReference::Kind::cavity || contour.kind == ObjectReference::Kind::name;
    });
    if (!arguments.tau && !chooses && !has_contours) {
        throw Error(ErrorKind::usage,
                    {.what = "which isovalue?",
                     .expected = "--tau T, --object REF, --top N or --best",
                     .next = "isoatlas objects " + shell_word(arguments.file) + " lists the isovalues that show something"});
    }
    if (arguments.tau && (arguments.best || arguments.top > 0)) {
        const std::string option = arguments.best ? "--best" : "--top";
        throw Error(ErrorKind::usage, {.what = "--tau and " + option + " contradict each other", .next = "omit one of them"});
    }
    if (arguments.for_print && arguments.boundary == Boundary::open)
        throw Error(ErrorKind::usage, {.what = "--for-print and --boundary open contradict each other", .next = "omit one of them"});
    if (arguments.for_print && arguments.shell == ShellChoice::inner)
        throw Error(ErrorKind::usage, {.what = "--for-print and --shell inner contradict each other", .next = "omit one of them"});
    if (arguments.min_wall && !arguments.for_print)
        throw Error(ErrorKind::usage, {.what = "--min-wall is a limit of what --for-print says", .next = "add --for-print, or omit it"});
    if (arguments.split && !chooses && !has_contours)
        throw Error(ErrorKind::usage, {.what = "--split writes a file for each chosen object", .next = "add --top N or --object REF"});
    check_output(arguments, {".ply", ".stl", ".obj", ".vtp", ".glb", ".vtkhdf", kPrecomputedExtension});
    check_coarser(arguments);
    check_precomputed(arguments);
}

/// The objects and contours of the command line; empty: everything at --tau.
std::vector<ChosenObject> chosen_objects(const Arguments& arguments, Sides& sides) {
    std::vector<ChosenObject> chosen = sides.find(arguments.objects, arguments.tau);
    for (ChosenObject& contour : sides.find_contours(arguments.contours, arguments.tau)) chosen.push_back(std::move(contour));
    const std::int64_t top = arguments.top > 0 ? arguments.top : arguments.best && arguments.objects.empty() ? 1 : 0;
    if (top == 0) return chosen;
    std::vector<ChosenObject> first = sides.first(top);
    if (first.empty()) sides.refuse_without_objects();
    const auto is_chosen = [&](const ChosenObject& object) {
        return std::ranges::any_of(chosen, [&](const ChosenObject& other) {
            return !other.is_contour && other.polarity == object.polarity && other.voxel == object.voxel && other.tau == object.tau;
        });
    };
    std::erase_if(first, is_chosen);
    chosen.insert(chosen.end(), first.begin(), first.end());
    return chosen;
}

/// One surface of all chosen objects at one isovalue: every vertex once, also where two references mean one object.
bool is_one_surface(const Arguments& arguments, const std::vector<ChosenObject>& chosen) {
    if (chosen.empty()) return true;
    const bool same = std::ranges::all_of(
        chosen, [&](const ChosenObject& object) { return object.polarity == chosen[0].polarity && object.tau == chosen[0].tau; });
    const bool mixed = chosen.size() > 1 && std::ranges::any_of(chosen, &ChosenObject::is_contour) && !arguments.tau;
    const bool has_each = arguments.output.ends_with(".glb") || is_precomputed(arguments.output);
    return same && !mixed && !arguments.split && !has_each;
}

SurfaceOptions options_of(const Arguments& arguments) {
    const ShellChoice shell = arguments.for_print ? ShellChoice::outer : arguments.shell;
    return {.boundary = arguments.boundary, .style = arguments.style, .objects = {}, .contours = {}, .shell = shell};
}

[[noreturn]] void nothing_written(const Arguments& arguments) {
    throw Error(ErrorKind::not_found, {.file = arguments.file,
                                       .what = "there is no such surface at this isovalue; nothing was written",
                                       .next = "isoatlas objects " + shell_word(arguments.file) + " --tau T lists the contours"});
}

SurfaceFileOptions file_options(const Arguments& arguments) { return {.space = arguments.space.value_or(PointSpace::lps)}; }

struct Counts {
    std::int64_t points, triangles, segments, objects, contours;
    bool closed;
};

std::int64_t distinct(isoatlas::Array<std::int64_t> ids) {
    std::sort(ids.begin(), ids.end());
    return std::unique(ids.begin(), ids.end()) - ids.begin();
}

Counts count(const Surface& surface) {
    return {static_cast<std::int64_t>(surface.points.size()),
            static_cast<std::int64_t>(surface.triangles.size()),
            static_cast<std::int64_t>(surface.segments.size()),
            distinct(surface.object),
            distinct(surface.contour),
            surface.closed};
}

Counts& operator+=(Counts& sum, const Counts& one) {
    sum.points += one.points, sum.triangles += one.triangles, sum.segments += one.segments;
    sum.objects += one.objects, sum.contours += one.contours;
    sum.closed = sum.closed && one.closed;
    return sum;
}

/// What was written: one surface of everything that was asked for, or one for each object.
struct Written {
    double tau = 0, reported_tau = 0;  ///< of one isovalue
    bool has_one_tau = true;
    std::string space, unit;
    Counts counts{};
    std::vector<std::string> warnings{}, notes{};
    struct Part {
        ChosenObject object;
        Counts counts;
        double reported_tau;
        std::string output;
    };
    std::vector<Part> parts{};
    std::optional<Printing> print{};
    std::optional<Simplification> simplification{};
    std::optional<OctreeUse> octree{};
    CoarserVersions coarser{};
    std::vector<PrecomputedLevel> levels{};
};

Json part_json(const Written::Part& part) {
    const ChosenObject& object = part.object;
    Json json{{"reference", reference_of(object)}};
    json["number"] = object.number == 0 ? Json(nullptr) : Json(object.number);
    json["name"] = object.name.empty() ? Json(nullptr) : Json(object.name);
    if (object.polarity == Polarity::low) json["polarity"] = name_of(object.polarity);
    json["side"] = object.is_contour ? "cavity" : "object";
    json["id"] = object.voxel;
    json["tau"] = part.reported_tau;
    json["points"] = part.counts.points;
    json["triangles"] = part.counts.triangles;
    json["segments"] = part.counts.segments;
    json["closed"] = part.counts.closed;
    json["output"] = part.output;
    return json;
}

Json to_json(const Arguments& arguments, Source& source, const Written& written) {
    Json json = document("extract", source.info(), source.interpolant(), source.tunnel_height(), arguments.boundary);
    json["tau"] = written.has_one_tau ? Json(written.reported_tau) : Json(nullptr);
    json["style"] = arguments.style == SurfaceStyle::compact ? "compact" : "full";
    json["output"] = arguments.output;
    json["points"] = written.counts.points;
    json["triangles"] = written.counts.triangles;
    json["segments"] = written.counts.segments;
    json["objects"] = written.counts.objects;
    json["contours"] = written.counts.contours;
    json["closed"] = written.counts.closed;
    json["space"] = space_in_file(arguments.output, written.space, file_options(arguments));
    json["warnings"] = written.warnings;
    json["notes"] = written.notes;
    json["simplification"] = written.simplification ? simplification_json(*written.simplification) : Json(nullptr);
    json["octree"] = written.octree ? octree_json(*written.octree) : Json(nullptr);
    json["coarser"] = coarser_json(written.coarser);
    json["levels"] = levels_json(written.levels);
    json["print"] = written.print ? printing_json(*written.print) : Json(nullptr);
    Json& parts = json["surfaces"] = Json::array();
    for (const Written::Part& part : written.parts) parts.push_back(part_json(part));
    add_reads(json, source.reads());
    return json;
}

std::string size_text(const Counts& counts) {
    return (counts.segments > 0 ? counted(counts.segments, "segment") : counted(counts.triangles, "triangle")) + ", ";
}

void print_text(const Arguments& arguments, Terminal& terminal, Source& source, const Written& written) {
    const std::string closed = written.counts.closed ? "closed" : "open at the border of the volume";
    const std::string unit = written.unit.empty() ? "" : ", in " + written.unit;
    const auto is_low = [](const Written::Part& part) { return part.object.polarity == Polarity::low; };
    const bool all_low = written.parts.empty() ? polarity_of(source.info()) == Polarity::low : std::ranges::all_of(written.parts, is_low);
    const std::string of_low = all_low ? ", of low values" : "";
    const std::string connectivity = interpolant_text(source.info(), source.interpolant(), source.tunnel_height()) + of_low;
    if (written.has_one_tau && !arguments.split) {
        terminal.out() << shown_name(arguments.output) << ": " << size_text(written.counts) << counted(written.counts.objects, "object")
                       << ", " << counted(written.counts.contours, "contour") << ", " << closed << ", isovalue "
                       << Scale(source.info()).text(written.tau) << unit << ", " << connectivity << '\n';
    } else {
        for (const Written::Part& part : written.parts)
            terminal.out() << (arguments.split ? shown_name(part.output) + ": " : "  ") << title_of(part.object) << " at "
                           << part.object.tau_text << ", " << size_text(part.counts)
                           << (part.counts.closed ? "closed" : "open at the border of the volume") << '\n';
        if (!arguments.split)
            terminal.out() << shown_name(arguments.output) << ": " << size_text(written.counts)
                           << counted(static_cast<std::int64_t>(written.parts.size()), "object") << ", " << closed << unit << ", "
                           << connectivity << '\n';
    }
    if (written.simplification) terminal.out() << simplification_text(*written.simplification) << '\n';
    if (written.octree) terminal.out() << octree_text(*written.octree) << '\n';
    if (written.coarser.most > 0) terminal.out() << coarser_text(written.coarser) << '\n';
    if (!written.levels.empty()) terminal.out() << levels_text(written.levels) << '\n';
    if (written.print) terminal.out() << printing_text(*written.print) << '\n';
    const std::string file = arguments.split ? written.parts[0].output : arguments.output;
    if (written.counts.triangles > 0 && written.counts.closed && !file.ends_with(".vtkhdf") && written.levels.empty())
        terminal.next("isoatlas verify " + shell_word(file));
}

/// Everything at one isovalue.
Written write_one(const Arguments& arguments, Source& source, const std::vector<ChosenObject>& chosen) {
    SurfaceOptions options = options_of(arguments);
    for (const ChosenObject& object : chosen) (object.is_contour ? options.contours : options.objects).push_back(object.voxel);
    Surface surface = source.extract(chosen.empty() ? source.tau() : chosen[0].tau, options);
    if (surface.points.empty()) nothing_written(arguments);
    std::optional<Simplification> simplification;
    if (arguments.simplification.is_asked_for()) {
        simplify(surface, source.info(), simplification.emplace(simplification_of(arguments)), source.context());
    }
    std::optional<Printing> print;
    std::vector<std::string> notes;
    if (arguments.for_print) print_surface(surface, print.emplace(printing_of(arguments)), notes, source.context());
    Written written{.tau = surface.tau, .reported_tau = surface.reported_tau, .space = surface.space, .unit = surface.unit};
    written.print = print, written.notes = std::move(notes);
    written.simplification = simplification;
    written.counts = count(surface);
    written.coarser.most = arguments.coarser;
    std::vector<SimplifiedSurface> coarser;
    if (arguments.coarser > 0) coarser = coarser_versions(surface, source.info(), written.coarser, source.context());
    if (chosen.size() == 1) written.parts.push_back({chosen[0], written.counts, surface.reported_tau, arguments.output});
    if (is_precomputed(arguments.output)) {
        const NamedSurface all{std::move(surface), fmt::format("isovalue {:g}", written.reported_tau), {}, {}};
        written.levels = write_precomputed(arguments.output, std::span(&all, 1), source.info(), source.context());
        return written;
    }
    const WritingGuard guard;
    written.warnings = write_surface(arguments.output, surface, coarser, file_options(arguments));
    return written;
}

/// Each object at its isovalue, in one file or in one file each.
Written write_several(const Arguments& arguments, Sides& sides, const std::vector<ChosenObject>& chosen) {
    Written written;
    std::vector<ChosenSurface> surfaces = chosen_surfaces(sides, chosen, options_of(arguments), written.notes);
    if (surfaces.empty()) nothing_written(arguments);
    const Surface& first = surfaces[0].named.surface;
    written.tau = first.tau, written.reported_tau = first.reported_tau, written.space = first.space;
    written.unit = arguments.for_print ? "mm" : first.unit;
    written.counts.closed = true;
    written.coarser.most = arguments.coarser;
    std::vector<NamedSurface> together;
    const auto keep = [&](const std::vector<std::string>& warnings) {
        for (const std::string& warning : warnings) {
            if (std::ranges::find(written.warnings, warning) == written.warnings.end()) written.warnings.push_back(warning);
        }
    };
    if (arguments.for_print) written.print = printing_of(arguments);
    if (arguments.simplification.is_asked_for()) written.simplification = simplification_of(arguments);
    for (ChosenSurface& one : surfaces) {
        if (written.simplification) {
            Source& source = sides.source(one.object);
            simplify(one.named.surface, source.info(), *written.simplification, source.context());
        }
        if (arguments.coarser > 0) {
            Source& source = sides.source(one.object);
            one.named.coarser = coarser_versions(one.named.surface, source.info(), written.coarser, source.context());
        }
        if (written.print) print_surface(one.named.surface, *written.print, written.notes, sides.main().context());
        const std::string output = arguments.split ? split_name(arguments.output, one.object) : arguments.output;
        const Counts counts = count(one.named.surface);
        written.counts += counts;
        written.has_one_tau = written.has_one_tau && one.object.tau == written.tau && one.object.polarity == surfaces[0].object.polarity;
        written.parts.push_back({one.object, counts, one.named.surface.reported_tau, output});
        together.push_back(std::move(one.named));
        if (!arguments.split) continue;
        const WritingGuard guard;
        keep(write_surfaces(output, together, file_options(arguments)));
        together.clear();
    }
    if (arguments.split) return written;
    if (is_precomputed(arguments.output)) {
        written.levels = write_precomputed(arguments.output, together, sides.main().info(), sides.main().context());
        return written;
    }
    const WritingGuard guard;
    keep(write_surfaces(arguments.output, together, file_options(arguments)));
    return written;
}

}  // namespace

int run_extract(const Arguments& arguments, Terminal& terminal) {
    check_octree(arguments);
    if (arguments.inputs.are_labels && !arguments.tau && !arguments.best) {
        check_output(arguments, {".ply", ".stl", ".obj", ".vtp", ".glb", ".vtkhdf", kPrecomputedExtension});
        return extract_label_objects(arguments, terminal);
    }
    check_extract_arguments(arguments);
    Sides sides(arguments, terminal);
    const std::vector<ChosenObject> chosen = chosen_objects(arguments, sides);
    sides.release_trees();
    Source& first = chosen.empty() ? sides.main() : sides.source(chosen[0]);
    Written written = is_one_surface(arguments, chosen) ? write_one(arguments, first, chosen) : write_several(arguments, sides, chosen);
    for (const Polarity polarity : {Polarity::high, Polarity::low}) {
        if (!arguments.octree.is_asked_for() || !sides.is_open(polarity)) continue;
        if (!written.octree) written.octree.emplace(OctreeUse{.asked = arguments.octree});
        *written.octree += sides.source(polarity).octree();
    }
    if (arguments.space && space_in_file(arguments.output, written.space) == "glTF")
        written.warnings.emplace_back("--space does not apply to .glb, which has metres and y up");
    if (written.print && !thin_walls_text(*written.print).empty()) written.warnings.push_back(thin_walls_text(*written.print));
    for (const std::string& warning : written.warnings) terminal.warn(warning);
    for (const std::string& note : written.notes) terminal.say("note: " + note);
    if (arguments.json) {
        print(terminal, to_json(arguments, first, written));
    } else {
        print_text(arguments, terminal, first, written);
    }
    return 0;
}

}  // namespace isoatlas::cli

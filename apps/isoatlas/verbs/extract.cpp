// isoatlas extract: the surface at an isovalue, of everything, some objects, or some contours.
#include <algorithm>

#include <fmt/format.h>

#include "data/source.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

const ObjectEntry* find(const ObjectTable& table, std::int64_t id) {
    const auto found = std::find_if(table.entries.begin(), table.entries.end(), [&](const ObjectEntry& entry) { return entry.id == id; });
    return found == table.entries.end() ? nullptr : &*found;
}

[[noreturn]] void no_such_entry(const Arguments& arguments, const std::string& what) {
    throw Error(
        ErrorKind::not_found,
        {.file = arguments.file, .what = what, .next = "isoatlas objects " + shell_word(arguments.file) + " lists them; or give --tau"});
}

/// The best isovalue of the selected objects. With --best and no --object: the object of the first line of the table.
double best_tau(const Arguments& arguments, Source& source, SurfaceOptions& options) {
    ObjectTable table = source.objects({});
    if (options.objects.empty()) {
        if (table.entries.empty()) no_such_entry(arguments, "no object of this volume is above the noise level");
        options.objects = {table.entries[0].id};
    }
    const auto known = [&](std::int64_t id) { return find(table, id) != nullptr; };
    if (!std::all_of(options.objects.begin(), options.objects.end(), known)) {
        table = source.objects({.top = 0, .gate = false});
    }
    double tau = 0;
    for (std::size_t i = 0; i < options.objects.size(); ++i) {
        const ObjectEntry* entry = find(table, options.objects[i]);
        if (entry == nullptr) no_such_entry(arguments, fmt::format("no object of the table has the id {}", options.objects[i]));
        if (i > 0 && entry->best_tau != tau) {
            throw Error(ErrorKind::usage,
                        {.what = fmt::format("objects {} and {} have different best isovalues", options.objects[0], options.objects[i]),
                         .next = "give one isovalue for all with --tau, or extract them one by one"});
        }
        tau = entry->best_tau;
    }
    return tau;
}

void check_arguments(const Arguments& arguments) {
    if (!arguments.tau && !arguments.best && arguments.objects.empty()) {
        throw Error(ErrorKind::usage,
                    {.what = "which isovalue?",
                     .expected = "--tau T, --object ID or --best",
                     .next = "isoatlas objects " + shell_word(arguments.file) + " lists the isovalues that show something"});
    }
    if (arguments.tau && arguments.best) {
        throw Error(ErrorKind::usage, {.what = "--tau and --best contradict each other", .next = "omit one of them"});
    }
    check_output(arguments, {".ply", ".stl", ".obj", ".vtp", ".glb"});
}

/// Ids are voxel indices: one beyond the volume is not an object at any isovalue.
void check_ids(const Arguments& arguments, const VolumeInfo& info) {
    for (const std::vector<std::int64_t>* ids : {&arguments.objects, &arguments.contours}) {
        for (const std::int64_t id : *ids) {
            if (id >= 0 && id < info.extent.voxels()) continue;
            throw Error(ErrorKind::not_found,
                        {.file = arguments.file,
                         .what = fmt::format("there is no {} {}", ids == &arguments.objects ? "object" : "contour", id),
                         .expected = fmt::format("a voxel index, 0 to {}", info.extent.voxels() - 1),
                         .next = "isoatlas objects " + shell_word(arguments.file) + " lists them"});
        }
    }
}

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

Json to_json(const Arguments& arguments, const Source& source, const Surface& surface, const Counts& counts,
             const std::vector<std::string>& warnings) {
    Json json = document("extract", source.info(), surface.interpolant, surface.tunnel_height, arguments.boundary);
    json["tau"] = surface.reported_tau;
    json["style"] = arguments.style == SurfaceStyle::compact ? "compact" : "full";
    json["output"] = arguments.output;
    json["points"] = counts.points;
    json["triangles"] = counts.triangles;
    json["segments"] = counts.segments;
    json["objects"] = counts.objects;
    json["contours"] = counts.contours;
    json["closed"] = counts.closed;
    json["space"] = surface.space;
    json["warnings"] = warnings;
    add_reads(json, source.reads());
    return json;
}

void print_text(const Arguments& arguments, Terminal& terminal, const VolumeInfo& info, const Surface& surface, const Counts& counts) {
    terminal.out() << shown_name(arguments.output) << ": "
                   << (counts.segments > 0 ? counted(counts.segments, "segment") : counted(counts.triangles, "triangle")) << ", "
                   << counted(counts.objects, "object") << ", " << counted(counts.contours, "contour") << ", "
                   << (counts.closed ? "closed" : "open at the border of the volume") << ", isovalue " << Scale(info).text(surface.tau)
                   << (surface.unit.empty() ? "" : ", in " + surface.unit) << ", "
                   << interpolant_text(info, surface.interpolant, surface.tunnel_height) << '\n';
    if (counts.triangles > 0 && counts.closed) terminal.next("isoatlas verify " + shell_word(arguments.output));
}

}  // namespace

int run_extract(const Arguments& arguments, Terminal& terminal) {
    check_arguments(arguments);
    Source source(arguments, terminal);
    check_ids(arguments, source.info());
    SurfaceOptions options{.boundary = arguments.boundary,
                           .style = arguments.style,
                           .objects = arguments.objects,
                           .contours = arguments.contours,
                           .shell = arguments.shell};
    const double tau = arguments.tau ? source.tau() : best_tau(arguments, source, options);
    const Surface surface = source.extract(tau, options);
    if (surface.points.empty()) {
        throw Error(ErrorKind::not_found, {.file = arguments.file,
                                           .what = "there is no such surface at this isovalue; nothing was written",
                                           .next = "isoatlas objects " + shell_word(arguments.file) + " --tau T lists the contours"});
    }
    const Counts counts = count(surface);
    std::vector<std::string> warnings;
    {
        const WritingGuard guard;
        warnings = write_surface(arguments.output, surface);
    }
    for (const std::string& warning : warnings) terminal.warn(warning);
    if (arguments.json) {
        print(terminal, to_json(arguments, source, surface, counts, warnings));
    } else {
        print_text(arguments, terminal, source.info(), surface, counts);
    }
    return 0;
}

}  // namespace isoatlas::cli

// Label volumes: `objects` lists their labels, `extract` writes the surface of each.
#include <algorithm>

#include <fmt/format.h>

#include "data/coarser.h"
#include "data/label_directory.h"
#include "data/precomputed.h"
#include "data/print_surface.h"
#include "data/simplify.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/sizes.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

Json region_json(const LabelRegion& region, const VolumeInfo& info, const std::string& name) {
    return {{"label", region.label},           {"name", name.empty() ? Json(nullptr) : Json(name)},
            {"voxels", region.voxels},         {"measure", region.measure},
            {"components", region.components}, {"tunnels", region.tunnels},
            {"cavities", region.cavities},     {"box", {{"low", region.box_low}, {"high", region.box_high}}},
            {"position", region.position},     {"position_physical", to_physical(info.geometry, region.position)}};
}

std::string box_text(const LabelRegion& region, int rank) {
    std::string text;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(rank); ++axis)
        text += fmt::format("{}{}..{}", axis > 0 ? " x " : "", region.box_low[axis], region.box_high[axis]);
    return text;
}

void print_labels_text(const Arguments& arguments, Terminal& terminal, const VolumeInfo& info, const LabelTable& table,
                       const LabelDirectory& directory) {
    const Sizes sizes(info, largest_measure(table.regions));
    std::vector<Table::Column> columns{{"label"}};
    if (!directory.names().empty()) columns.push_back({"name", true});
    sizes.add_titles(columns);
    columns.insert(columns.end(), {{"components"}, {"box", true}});
    Table text(columns);
    for (const LabelRegion& region : table.regions) {
        std::vector<std::string> row{fmt::format("{}", region.label)};
        if (!directory.names().empty()) row.push_back(directory.name_of(region.label));
        sizes.add(row, region.voxels, region.measure, region.tunnels, region.cavities);
        row.insert(row.end(), {count_text(region.components), box_text(region, info.extent.rank)});
        text.add(row);
    }
    terminal.say(fmt::format("{}; {} of background (0); {}", counted(std::ssize(table.regions), "label"),
                             counted(table.background, "voxel"), interpolant_text(info, arguments.interpolant, 0)));
    text.print(terminal);
    if (table.regions.empty()) return;
    terminal.next(fmt::format("isoatlas extract {}{} --object {} -o label.ply", shell_word(arguments.file), reading_options(arguments),
                              table.regions.front().label));
}

struct LabelSurfaces {
    std::vector<NamedSurface> surfaces{};
    std::size_t points = 0, triangles = 0, segments = 0;
    std::optional<Simplification> simplification;
    CoarserVersions coarser;
    std::optional<Printing> printing;
    std::vector<std::string> notes{};
};

void add_surface(LabelSurfaces& made, std::int64_t label, Source& source, const LabelDirectory& directory, const SurfaceOptions& options) {
    Surface part = extract_label(source.volume(), label, {.interpolant = source.interpolant(), .surface = options}, source.context());
    if (made.simplification) simplify(part, source.info(), *made.simplification, source.context());
    std::vector<SimplifiedSurface> versions;
    if (made.coarser.most > 0) versions = coarser_versions(part, source.info(), made.coarser, source.context());
    if (made.printing) print_surface(part, *made.printing, made.notes, source.context());
    made.points += part.points.size(), made.triangles += part.triangles.size(), made.segments += part.segments.size();
    made.surfaces.push_back({std::move(part), directory.title_of(label), directory.colour_of(label), std::move(versions)});
}

}  // namespace

int list_label_objects(const Arguments& arguments, Terminal& terminal) {
    Source source(arguments, terminal);
    const LabelDirectory directory(arguments, source);
    const Volume& volume = source.volume();
    const LabelTable table = list_labels(volume, {.interpolant = source.interpolant()}, source.context());
    if (!arguments.json) {
        print_labels_text(arguments, terminal, volume.info, table, directory);
        return 0;
    }
    Json head = document("labels", volume.info, source.interpolant(), 0);
    head["background"] = table.background;
    add_reads(head, source.reads());
    print(terminal, head, "labels", std::ssize(table.regions), [&](std::int64_t i) {
        const LabelRegion& region = table.regions[static_cast<std::size_t>(i)];
        return region_json(region, volume.info, directory.name_of(region.label));
    });
    return 0;
}

int extract_label_objects(const Arguments& arguments, Terminal& terminal) {
    check_coarser(arguments);
    check_precomputed(arguments);
    Source source(arguments, terminal);
    LabelDirectory directory(arguments, source);
    SurfaceOptions options;
    options.boundary = arguments.boundary, options.style = arguments.style, options.shell = arguments.shell;
    if (arguments.for_print) options.shell = ShellChoice::outer;
    LabelSurfaces made{.simplification = {}, .coarser = {.most = arguments.coarser}, .printing = {}};
    if (arguments.for_print) made.printing = printing_of(arguments);
    if (arguments.simplification.is_asked_for()) made.simplification = simplification_of(arguments);
    const std::vector<std::int64_t> labels = directory.find(arguments.objects);
    for (const std::int64_t label : labels) add_surface(made, label, source, directory, options);
    const Surface& surface = made.surfaces.front().surface;
    const SurfaceFileOptions file_options{.space = arguments.space.value_or(PointSpace::lps)};
    std::vector<std::string> warnings;
    std::vector<PrecomputedLevel> levels;
    if (is_precomputed(arguments.output)) {
        levels = write_precomputed(arguments.output, made.surfaces, source.info(), source.context());
    } else {
        const WritingGuard guard;
        warnings = write_surfaces(arguments.output, made.surfaces, file_options);
    }
    if (made.printing && !thin_walls_text(*made.printing).empty()) warnings.push_back(thin_walls_text(*made.printing));
    for (const std::string& warning : warnings) terminal.warn(warning);
    for (const std::string& note : made.notes) terminal.say("note: " + note);
    const auto facets = static_cast<std::int64_t>(made.segments == 0 ? made.triangles : made.segments);
    if (arguments.json) {
        Json json = document("extract-labels", source.info(), surface.interpolant, 0, arguments.boundary);
        json["output"] = arguments.output;
        json["labels"] = labels;
        json["points"] = made.points;
        json["triangles"] = made.triangles;
        json["segments"] = made.segments;
        json["closed"] = surface.closed;
        json["space"] = space_in_file(arguments.output, surface.space, file_options);
        json["warnings"] = warnings;
        json["notes"] = made.notes;
        json["simplification"] = made.simplification ? simplification_json(*made.simplification) : Json(nullptr);
        json["coarser"] = coarser_json(made.coarser);
        json["levels"] = levels_json(levels);
        json["print"] = made.printing ? printing_json(*made.printing) : Json(nullptr);
        add_reads(json, source.reads());
        print(terminal, json);
        return 0;
    }
    terminal.out() << shown_name(arguments.output) << ": " << counted(facets, surface.segments.empty() ? "triangle" : "segment") << " of "
                   << counted(std::ssize(labels), "label") << (surface.unit.empty() ? "" : ", in " + surface.unit) << ", "
                   << interpolant_text(source.info(), surface.interpolant, 0) << '\n';
    if (made.simplification) terminal.out() << simplification_text(*made.simplification) << '\n';
    if (made.coarser.most > 0) terminal.out() << coarser_text(made.coarser) << '\n';
    if (!levels.empty()) terminal.out() << levels_text(levels) << '\n';
    if (made.printing) terminal.out() << printing_text(*made.printing) << '\n';
    if (labels.size() == 1 && !surface.triangles.empty() && surface.closed && levels.empty())
        terminal.next("isoatlas verify " + shell_word(arguments.output));
    return 0;
}

}  // namespace isoatlas::cli

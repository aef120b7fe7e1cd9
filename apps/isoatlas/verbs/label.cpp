// isoatlas label: a label volume of the objects at an isovalue, or of the zones.
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "data/chosen_labels.h"
#include "data/source.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/simplified.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

struct Labels {
    std::vector<std::uint32_t> of_voxel;
    std::int64_t count = 0;  ///< the largest label
    LabelOrigin origin;
};

[[noreturn]] void too_many(const Arguments& arguments, std::int64_t count) {
    throw Error(ErrorKind::unsupported, {.file = arguments.file,
                                         .what = count_text(count) + " labels do not fit in 32 bits",
                                         .next = "label the objects of one isovalue with --tau"});
}

Labels label_objects(Source& source) {
    const Cut at = source.cut(source.tau(), true);
    return {object_labels(at),
            static_cast<std::int64_t>(at.objects.size()),
            {.interpolant = at.interpolant, .tunnel_height = at.tunnel_height, .tau = at.tau}};
}

Labels label_cavity_voxels(Source& source) {
    const double tau = source.tau();
    const Analysis analysis = source.analysis(false);
    std::vector<std::int64_t> ids;
    Labels labels;
    labels.of_voxel = label_cavities(source.volume(), analysis, tau, ids, source.context());
    labels.count = static_cast<std::int64_t>(ids.size());
    labels.origin = {.interpolant = analysis.interpolant(), .tunnel_height = analysis.tunnel_height(), .tau = tau, .cavities = true};
    return labels;
}

/// Zones of the simplified tree: label = node + 1.
Labels label_simplified(Source& source, Terminal& terminal) {
    const Volume& volume = source.volume();
    const Analysis analysis = source.analysis(true);
    const Simplified simplified = BranchHierarchy(volume, analysis, source.context()).simplify(source.selection());
    Labels labels{{},
                  static_cast<std::int64_t>(simplified.nodes.size()),
                  {.interpolant = analysis.interpolant(), .tunnel_height = analysis.tunnel_height(), .tau = {}}};
    for (const VoxelId voxel : ids<VoxelId>(volume.info.extent.voxels())) {
        const std::int64_t node = simplified.node_of_event[analysis.zone(voxel).index()];
        labels.of_voxel.push_back(static_cast<std::uint32_t>(node + 1));
    }
    terminal.say(hidden_text(simplified, volume.info.extent.voxels()));
    return labels;
}

Labels label_zones(const Arguments& arguments, Source& source, Terminal& terminal) {
    if (arguments.selects) return label_simplified(source, terminal);
    const Analysis analysis = source.analysis(true);
    if (analysis.event_count() > std::numeric_limits<std::uint32_t>::max()) too_many(arguments, analysis.event_count());
    const std::int64_t voxels = source.info().extent.voxels();
    Labels labels{std::vector<std::uint32_t>(static_cast<std::size_t>(voxels)),
                  analysis.event_count(),
                  {.interpolant = analysis.interpolant(), .tunnel_height = analysis.tunnel_height(), .tau = {}}};
    for (const VoxelId voxel : ids<VoxelId>(voxels))
        labels.of_voxel[voxel.index()] = static_cast<std::uint32_t>(analysis.zone(voxel).number() + 1);
    return labels;
}

bool chooses(const Arguments& arguments) { return !arguments.objects.empty() || arguments.top > 0; }

void check_label_arguments(const Arguments& arguments) {
    check_output(arguments, {".nrrd", ".nii", ".nii.gz", ".tif", ".mrc", ".vdb", ".h5", ".hdf5", ".zarr"});
    const auto contradict = [](const std::string& one, const std::string& other) {
        throw Error(ErrorKind::usage, {.what = one + " and " + other + " contradict each other", .next = "isoatlas label --help"});
    };
    if (chooses(arguments)) {
        const std::string option = arguments.top > 0 ? "--top" : "--object";
        if (arguments.zones) contradict("--zones", option);
        if (arguments.cavities) contradict("--cavities", option);
        if (arguments.tau && arguments.top > 0) contradict("--tau", option);
        if (arguments.selects)
            throw Error(ErrorKind::usage, {.what = "a selection applies to --zones only", .next = "isoatlas label --help"});
        return;
    }
    if (arguments.tau.has_value() == arguments.zones) {
        throw Error(ErrorKind::usage,
                    {.what = arguments.zones ? "--tau and --zones contradict each other" : "nothing to label",
                     .expected = "--top N or --object REF for objects of the table, --tau T for the objects at an isovalue, "
                                 "or --zones",
                     .next = "isoatlas label --help"});
    }
    if (arguments.cavities && arguments.zones) contradict("--cavities", "--zones");
    if (arguments.selects && !arguments.zones)
        throw Error(ErrorKind::usage, {.what = "a selection applies to --zones only", .next = "isoatlas label --help"});
}

Json segment_json(const LabelledObject& one) {
    const ChosenObject& object = one.object;
    Json json{{"label", one.segment.number}, {"reference", reference_of(object)}};
    json["number"] = object.number == 0 ? Json(nullptr) : Json(object.number);
    json["name"] = object.name.empty() ? Json(nullptr) : Json(object.name);
    if (object.polarity == Polarity::low) json["polarity"] = name_of(object.polarity);
    json["side"] = object.is_contour ? "cavity" : "object";
    json["id"] = object.voxel;
    json["tau"] = one.segment.isovalue;
    json["voxels"] = one.segment.voxels;
    json["colour"] = one.segment.colour;
    return json;
}

ChosenLabels make_chosen_labels(const Arguments& arguments, Sides& sides) {
    std::vector<ChosenObject> chosen = sides.find(arguments.objects, arguments.tau);
    if (arguments.top > 0) {
        for (ChosenObject& object : sides.first(arguments.top)) chosen.push_back(std::move(object));
    }
    if (chosen.empty()) sides.refuse_without_objects();
    return chosen_labels(arguments, sides, chosen);
}

/// Objects of the table, each at its own isovalue.
int label_chosen(const Arguments& arguments, Terminal& terminal) {
    Sides sides(arguments, terminal);
    Source& source = sides.main();
    const ChosenLabels labels = make_chosen_labels(arguments, sides);
    std::vector<Segment> segments;
    for (const LabelledObject& one : labels.objects) {
        segments.push_back(one.segment);
        if (one.segment.voxels == 0)
            terminal.say(
                fmt::format("note: label {} ({}) has no voxel: other objects hold all of them", one.segment.number, one.segment.name));
    }
    std::vector<std::string> warnings;
    {
        const WritingGuard guard;
        warnings = write_segmentation(arguments.output, labels.of_voxel, segments, source.info());
    }
    for (const std::string& warning : warnings) terminal.warn(warning);
    const auto count = static_cast<std::int64_t>(segments.size());
    if (arguments.json) {
        Json json = document("label", source.info(), source.interpolant(), source.tunnel_height());
        json["output"] = arguments.output;
        json["labels_are"] = "chosen objects";
        json["tau"] = nullptr;
        json["labels"] = segments.back().number;
        Json& list = json["segments"] = Json::array();
        for (const LabelledObject& one : labels.objects) list.push_back(segment_json(one));
        add_reads(json, source.reads());
        print(terminal, json);
        return 0;
    }
    Table table({{"label"}, {"object", true}, {"isovalue"}, {"voxels"}});
    for (const LabelledObject& one : labels.objects)
        table.add({fmt::format("{}", one.segment.number), one.segment.name, one.object.tau_text, count_text(one.segment.voxels)});
    table.print(terminal);
    terminal.out() << shown_name(arguments.output) << ": " << counted(count, "object") << ", each at its isovalue (0 is background), "
                   << interpolant_text(source.info(), source.interpolant(), source.tunnel_height()) << '\n';
    return 0;
}

}  // namespace

int run_label(const Arguments& arguments, Terminal& terminal) {
    if (arguments.inputs.are_labels) return label_label_objects(arguments, terminal);
    check_label_arguments(arguments);
    if (chooses(arguments)) return label_chosen(arguments, terminal);
    Source source(arguments, terminal);
    const Labels labels = arguments.zones      ? label_zones(arguments, source, terminal)
                          : arguments.cavities ? label_cavity_voxels(source)
                                               : label_objects(source);
    {
        const WritingGuard guard;
        write_labels(arguments.output, source.info(), labels.of_voxel, labels.origin);
    }
    const std::string what = arguments.zones ? "zones" : arguments.cavities ? "cavities" : "objects";
    if (arguments.json) {
        Json json = document("label", source.info(), labels.origin.interpolant, labels.origin.tunnel_height);
        json["output"] = arguments.output;
        json["labels_are"] = what;
        json["tau"] = arguments.tau ? Json(*arguments.tau) : Json(nullptr);
        json["labels"] = labels.count;
        add_reads(json, source.reads());
        print(terminal, json);
        return 0;
    }
    terminal.out() << shown_name(arguments.output) << ": "
                   << counted(labels.count,
                              arguments.zones      ? "zone"
                              : arguments.cavities ? "cavity"
                                                   : "object",
                              what)
                   << (arguments.zones ? arguments.selects ? " (label = node of the simplified tree + 1), " : " (label = event id + 1), "
                                       : " (label 1 is the largest, 0 is background), ")
                   << interpolant_text(source.info(), labels.origin.interpolant, labels.origin.tunnel_height) << '\n';
    if (arguments.tau && !arguments.cavities) {
        terminal.next(fmt::format("isoatlas objects {}{} --tau {}    # the objects in the order of the labels", shell_word(arguments.file),
                                  reading_options(arguments), *arguments.tau));
    }
    return 0;
}

}  // namespace isoatlas::cli

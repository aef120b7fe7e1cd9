// Label volumes: the page and the label volume of chosen labels (`objects` and `extract`: label_objects.cpp).
#include <algorithm>

#include <fmt/format.h>

#include "data/label_directory.h"
#include "data/store_beside.h"
#include "text/document.h"
#include "text/interrupt.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kPictures = 64;

struct KeptLabels {
    std::vector<std::uint32_t> of_voxel;  ///< 0: none, or not chosen
    std::vector<Segment> segments;        ///< by label
    std::vector<std::int64_t> first;      ///< voxel of each
};

/// The isovalue of a segment is its label: where the samples are that.
KeptLabels kept_labels(const Volume& volume, const LabelDirectory& directory, std::vector<std::int64_t> labels) {
    std::ranges::sort(labels);
    labels.erase(std::ranges::unique(labels).begin(), labels.end());
    KeptLabels kept{std::vector<std::uint32_t>(static_cast<std::size_t>(volume.info.extent.voxels())), {}, {}};
    for (const std::int64_t label : labels) {
        kept.segments.push_back({label, directory.title_of(label), directory.colour_of(label), static_cast<double>(label), 0});
        kept.first.push_back(-1);
    }
    visit_samples(volume, [&](auto samples) {
        for (std::size_t v = 0; v < samples.size(); ++v) {
            const auto label = static_cast<std::int64_t>(samples[v]);
            const auto place = std::ranges::lower_bound(labels, label);
            if (label == 0 || place == labels.end() || *place != label) continue;
            const auto i = static_cast<std::size_t>(place - labels.begin());
            kept.of_voxel[v] = static_cast<std::uint32_t>(label);
            if (kept.segments[i].voxels++ == 0) kept.first[i] = static_cast<std::int64_t>(v);
        }
    });
    for (const Segment& segment : kept.segments) {
        if (segment.voxels > 0) continue;
        throw Error(ErrorKind::not_found, {.file = volume.info.path,
                                           .what = fmt::format("no sample has the label {}", segment.number),
                                           .next = "isoatlas objects " + shell_word(volume.info.path) + " lists the labels"});
    }
    return kept;
}

Json segment_json(const Segment& segment, std::int64_t first, const std::string& name) {
    Json json{{"label", segment.number}, {"reference", std::to_string(segment.number)}, {"number", nullptr}};
    json["name"] = name.empty() ? Json(nullptr) : Json(name);
    json["side"] = "object";
    json["id"] = first;
    json["tau"] = segment.isovalue;
    json["voxels"] = segment.voxels;
    json["colour"] = segment.colour;
    return json;
}

}  // namespace

int run_label_page(const Arguments& arguments, Terminal& terminal) {
    const std::string page = arguments.output.empty() ? stem_of(arguments) + ".atlas.html" : arguments.output;
    check_output(arguments, page, {".html"});
    Source source(arguments, terminal);
    const LabelDirectory directory(arguments, source);
    std::vector<std::string> notes = source.info().notes;
    const auto add = [&notes](const std::string& note) {
        if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    };
    for (const std::string& note : arguments.inputs.assumed) add(note);
    const PageOptions options{.top = arguments.top > 0 ? arguments.top : kPictures,
                              .source = shell_word(arguments.file) + reading_options(arguments),
                              .notes = notes,
                              .partly_written = tell_first_pictures(terminal, page)};
    PageReport report;
    {
        const WritingGuard guard;
        report = write_label_page(page, source.volume(), source.interpolant(), directory.names(), options, source.context());
    }
    if (arguments.json) {
        Json json = document("atlas", source.info(), source.interpolant(), 0);
        json["store"] = nullptr;
        json["output"] = page;
        json["bytes"] = report.bytes;
        json["shown"] = report.objects;
        json["shown_cavities"] = 0;
        json["shown_low"] = 0;
        json["hidden"] = report.hidden;
        print(terminal, json);
        return 0;
    }
    terminal.out() << page << ": " << counted(report.objects, "picture") << " of labels; " << counted(report.hidden, "label")
                   << " without; " << bytes_text(static_cast<double>(report.bytes)) << '\n';
    terminal.next("open " + page + " in a browser");
    return 0;
}

int label_label_objects(const Arguments& arguments, Terminal& terminal) {
    check_output(arguments, {".nrrd", ".nii", ".nii.gz", ".tif", ".mrc", ".h5", ".hdf5"});
    Source source(arguments, terminal);
    LabelDirectory directory(arguments, source);
    const KeptLabels kept = kept_labels(source.volume(), directory, directory.find(arguments.objects, arguments.top));
    std::vector<std::string> warnings;
    {
        const WritingGuard guard;
        warnings = write_segmentation(arguments.output, kept.of_voxel, kept.segments, source.info());
    }
    for (const std::string& warning : warnings) terminal.warn(warning);
    if (arguments.json) {
        Json json = document("label", source.info(), source.interpolant(), 0);
        json["output"] = arguments.output;
        json["labels_are"] = "labels of the volume";
        json["tau"] = nullptr;
        json["labels"] = kept.segments.back().number;
        Json& list = json["segments"] = Json::array();
        for (std::size_t i = 0; i < kept.segments.size(); ++i)
            list.push_back(segment_json(kept.segments[i], kept.first[i], directory.name_of(kept.segments[i].number)));
        add_reads(json, source.reads());
        print(terminal, json);
        return 0;
    }
    Table table({{"label"}, {"name", true}, {"voxels"}});
    for (const Segment& segment : kept.segments) table.add({fmt::format("{}", segment.number), segment.name, count_text(segment.voxels)});
    table.print(terminal);
    terminal.out() << shown_name(arguments.output) << ": " << counted(std::ssize(kept.segments), "label") << " of the volume\n";
    return 0;
}

}  // namespace isoatlas::cli

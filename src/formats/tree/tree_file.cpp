// write_tree and write_tree_json: the extension chooses the format.
#include "base/atomic_file.h"
#include "formats/common/file_extension.h"
#include "formats/tree/tree_formats.h"

namespace isoatlas {

namespace {

/// Graph formats need edges, and points need positions.
void check_detail(const std::string& path, const std::string& extension, TreeDetail detail) {
    const bool graph = extension == ".graphml" || extension == ".vtu";
    const bool possible =
        !graph || detail == TreeDetail::events || detail == TreeDetail::contours || (detail == TreeDetail::elements && extension == ".vtu");
    if (possible) return;
    throw Error(ErrorKind::usage,
                {.file = path,
                 .what = std::string("the ") + name_of(detail) + " of a tree are a list, and " + extension + " holds a graph",
                 .next = "write .json or .csv, or choose the detail events or contours"});
}

std::string checked_extension(const std::string& path, const TreeOutput& options) {
    const std::string extension = known_extension(path, {".json", ".graphml", ".csv", ".vtu"},
                                                  {"the format of the tree", "format of a tree", ".json, .graphml, .csv or .vtu"});
    check_detail(path, extension, options.detail);
    return extension;
}

}  // namespace

TreeView::TreeView(const Volume& the_volume, const Analysis& the_analysis, const TreeOutput& the_options)
    : volume(the_volume), analysis(the_analysis), options(the_options), has_zones(the_analysis.counts_voxels()) {}

std::int64_t TreeView::item_count() const {
    switch (options.detail) {
        case TreeDetail::levels: return analysis.level_count();
        case TreeDetail::elements: return analysis.element_count();
        case TreeDetail::contours: return analysis.contour_arc_count();
        case TreeDetail::events: break;
    }
    return analysis.event_count();
}

void visit_events(const TreeView& tree, const EventVisitor& visit) {
    tree.analysis.visit_object_contours([&](EventId id, std::span<const GenusCount> genera) { visit(tree.analysis.event(id), genera); });
}

const char* name_of(TreeDetail detail) {
    switch (detail) {
        case TreeDetail::levels: return "levels";
        case TreeDetail::elements: return "elements";
        case TreeDetail::contours: return "contours";
        case TreeDetail::events: break;
    }
    return "events";
}

std::string histogram_text(std::span<const GenusCount> genera) {
    std::string text;
    for (const GenusCount& g : genera) text += (text.empty() ? "" : " ") + std::to_string(g.genus) + ":" + std::to_string(g.count);
    return text;
}

std::string list_text(std::span<const std::int64_t> numbers) {
    std::string text;
    for (const std::int64_t number : numbers) text += (text.empty() ? "" : " ") + std::to_string(number);
    return text;
}

std::string list_text(std::span<const EventId> events) {
    std::string text;
    for (const EventId event : events) text += (text.empty() ? "" : " ") + std::to_string(event.number());
    return text;
}

void write_tree(Sink& sink, const Volume& volume, const Analysis& analysis, const TreeOutput& options) {
    const std::string extension = checked_extension(sink.name(), options);
    const TreeView tree(volume, analysis, options);
    if (extension == ".json") return write_json(tree, output_to(sink));
    if (extension == ".csv") return write_tree_csv(sink, tree);
    if (extension == ".graphml") return write_tree_graphml(sink, tree);
    write_tree_vtu(sink, tree);
}

void write_tree(const std::string& path, const Volume& volume, const Analysis& analysis, const TreeOutput& options) {
    (void)checked_extension(path, options);
    AtomicFile file(path);
    write_tree(file, volume, analysis, options);
    file.commit();
}

void write_tree_json(std::ostream& out, const Volume& volume, const Analysis& analysis, const TreeOutput& options) {
    write_json({volume, analysis, options}, output_to(out, "the tree"));
}

}  // namespace isoatlas

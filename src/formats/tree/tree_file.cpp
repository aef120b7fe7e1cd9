// write_tree and write_tree_json: the extension chooses the format.
#include "formats/common/byte_writer.h"
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
    tree.analysis.visit_object_contours(
        [&](std::int64_t id, std::span<const GenusCount> genera) { visit(tree.analysis.event(id), genera); });
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

void write_tree(const std::string& path, const Volume& volume, const Analysis& analysis, const TreeOutput& options) {
    const std::string extension = lower_extension(path);
    const TreeView tree(volume, analysis, options);
    check_detail(path, extension, options.detail);
    if (extension == ".json") {
        AtomicFile file(path);
        write_json(tree, [&](std::string_view text) { file.write(text); });
        file.commit();
    } else if (extension == ".csv") {
        AtomicFile file(path);
        write_tree_csv(file, tree);
    } else if (extension == ".graphml") {
        AtomicFile file(path);
        write_tree_graphml(file, tree);
    } else if (extension == ".vtu") {
        AtomicFile file(path);
        write_tree_vtu(file, tree);
    } else {
        refuse_extension(path, {"the format of the tree", "format of a tree", ".json, .graphml, .csv or .vtu"});
    }
}

void write_tree_json(std::ostream& out, const Volume& volume, const Analysis& analysis, const TreeOutput& options) {
    write_json({volume, analysis, options}, stream_sink(out, "the tree"));
}

}  // namespace isoatlas

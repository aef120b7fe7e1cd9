#include "text/simplified.h"

#include <map>

#include <fmt/format.h>

#include "data/source.h"
#include "options/object_reference.h"
#include "text/interrupt.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/tree_document.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

void print_text(Terminal& terminal, const VolumeInfo& info, const BranchHierarchy& hierarchy, const Simplified& simplified) {
    const Scale scale(info);
    Table table({{"node", true}, {"object"}, {"from"}, {scale.way()}, {"voxels in zone"}, {"object voxels"}});
    std::map<std::int64_t, std::vector<std::int64_t>> above;
    for (std::size_t i = 0; i < simplified.nodes.size(); ++i) above[simplified.nodes[i].parent].push_back(static_cast<std::int64_t>(i));
    std::vector<std::pair<std::int64_t, std::size_t>> stack{{above[-1].front(), 0}};
    while (!stack.empty()) {
        const auto [i, depth] = stack.back();
        stack.pop_back();
        const SimplifiedNode& node = simplified.nodes[static_cast<std::size_t>(i)];
        table.add({fmt::format("{}{} {}", std::string(2 * depth, ' '), node.is_maximum ? scale.is_low() ? "minimum" : "maximum" : "merge",
                               node.event.number()),
                   voxel_word(hierarchy.branches()[node.branch.index()].id), scale.brief(node.tau_high),
                   node.parent < 0 ? scale.last() : scale.brief(node.tau_low), count_text(node.voxels), count_text(node.object_voxels)});
        const std::vector<std::int64_t>& children = above[i];
        // A chain without branches is not indented further.
        for (auto child = children.rbegin(); child != children.rend(); ++child) stack.push_back({*child, depth + (children.size() > 1)});
    }
    table.print(terminal);
    terminal.out() << '\n' << hidden_text(simplified, info.extent.voxels()) << '\n';
}

void write_file(const Arguments& arguments, Terminal& terminal, Source& source, const SimplifiedTree& tree) {
    {
        const WritingGuard guard;
        write_simplified_tree(arguments.output, tree);
    }
    if (!arguments.json) {
        terminal.out() << fmt::format("{}: {}; {}\n", shown_name(arguments.output),
                                      counted(static_cast<std::int64_t>(tree.simplified.nodes.size()), "node"),
                                      hidden_text(tree.simplified, source.info().extent.voxels()));
        return;
    }
    Json json = tree_file_document(arguments, source.info(), tree.analysis);
    json["nodes"] = tree.simplified.nodes.size();
    json["kept"] = tree.simplified.kept.size();
    json["hidden"] = tree.simplified.hidden;
    json["hidden_voxels"] = tree.simplified.hidden_voxels;
    print(terminal, json);
}

}  // namespace

std::string hidden_text(const Simplified& simplified, std::int64_t voxels) {
    const auto kept = static_cast<std::int64_t>(simplified.kept.size());
    const double percent = 100 * static_cast<double>(simplified.hidden_voxels) / static_cast<double>(voxels);
    return fmt::format("{} of {} shown; the other {} hold {:.3g} % of the voxels", count_text(kept),
                       counted(kept + simplified.hidden, "object"), count_text(simplified.hidden), percent);
}

void write_curves(const Arguments& arguments, Source& source) {
    const BranchHierarchy hierarchy = source.hierarchy();
    const WritingGuard guard;
    isoatlas::write_curves(arguments.curve, source.info(), hierarchy.curves());
}

int run_simplified_tree(const Arguments& arguments, Terminal& terminal) {
    if (arguments.detail != TreeDetail::events) {
        throw Error(ErrorKind::usage, {.what = "a simplified tree has events only", .next = "omit --detail, or the selection"});
    }
    Source source(arguments, terminal);
    const auto [analysis, hierarchy] = source.analysis_and_hierarchy();
    const Simplified simplified = hierarchy.simplify(source.selection());
    const SimplifiedTree tree{source.info(), analysis, hierarchy, simplified};
    stop_if_interrupted();
    if (!arguments.output.empty()) {
        write_file(arguments, terminal, source, tree);
    } else if (arguments.json) {
        write_simplified_tree_json(terminal.out(), tree);
    } else {
        print_text(terminal, source.info(), hierarchy, simplified);
    }
    return 0;
}

}  // namespace isoatlas::cli

#include "simplified.h"

#include <map>

#include <fmt/format.h>

#include "document.h"
#include "interrupt.h"
#include "source.h"
#include "table.h"
#include "terminal.h"
#include "values.h"

namespace isoatlas::cli {
namespace {

Json node_json(const SimplifiedNode& node, const BranchHierarchy& hierarchy, const Scale& scale) {
    Json json{{"event", node.event}, {"object", hierarchy.branches()[static_cast<std::size_t>(node.branch)].id}};
    json["kind"] = node.is_maximum ? "maximum" : "merge";
    json["parent"] = node.parent < 0 ? Json(nullptr) : Json(node.parent);
    json["tau_low"] = number(scale.reported(node.tau_low));
    json["tau_high"] = scale.reported(node.tau_high);
    json["voxels"] = node.voxels;
    json["object_voxels"] = node.object_voxels;
    return json;
}

void print_json(Terminal& terminal, Source& source, const BranchHierarchy& hierarchy, const Simplified& simplified) {
    const Scale scale(source.info());
    Json head = document("simplified-tree", source.info(), source.interpolant(), source.tunnel_height());
    head["objects"] = hierarchy.branches().size();
    head["kept"] = simplified.kept.size();
    head["hidden"] = simplified.hidden;
    head["hidden_voxels"] = simplified.hidden_voxels;
    print(terminal, head, "nodes", static_cast<std::int64_t>(simplified.nodes.size()),
          [&](std::int64_t i) { return node_json(simplified.nodes[static_cast<std::size_t>(i)], hierarchy, scale); });
}

void print_text(Terminal& terminal, const VolumeInfo& info, const BranchHierarchy& hierarchy, const Simplified& simplified) {
    const Scale scale(info);
    Table table({{"node", true}, {"object"}, {"from"}, {"down to"}, {"voxels in zone"}, {"object voxels"}});
    std::map<std::int64_t, std::vector<std::int64_t>> above;
    for (std::size_t i = 0; i < simplified.nodes.size(); ++i) above[simplified.nodes[i].parent].push_back(static_cast<std::int64_t>(i));
    std::vector<std::pair<std::int64_t, std::size_t>> stack{{above[-1].front(), 0}};
    while (!stack.empty()) {
        const auto [i, depth] = stack.back();
        stack.pop_back();
        const SimplifiedNode& node = simplified.nodes[static_cast<std::size_t>(i)];
        table.add({fmt::format("{}{} {}", std::string(2 * depth, ' '), node.is_maximum ? "maximum" : "merge", node.event),
                   fmt::format("{}", hierarchy.branches()[static_cast<std::size_t>(node.branch)].id), scale.brief(node.tau_high),
                   node.parent < 0 ? "bottom" : scale.brief(node.tau_low), count_text(node.voxels), count_text(node.object_voxels)});
        const std::vector<std::int64_t>& children = above[i];
        // A line without branches goes straight down the page.
        for (auto child = children.rbegin(); child != children.rend(); ++child) stack.push_back({*child, depth + (children.size() > 1)});
    }
    table.print(terminal);
    terminal.out() << '\n' << hidden_text(simplified, info.extent.voxels()) << '\n';
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
    const WritingGuard guard(arguments.curve);
    isoatlas::write_curves(arguments.curve, source.info(), hierarchy.curves());
}

int run_simplified_tree(const Arguments& arguments, Terminal& terminal) {
    if (!arguments.output.empty()) {
        throw Error(ErrorKind::usage,
                    {.what = "a simplified tree cannot be written with -o", .next = "print it with --json, or leave out the selection"});
    }
    Source source(arguments, terminal);
    const BranchHierarchy hierarchy = source.hierarchy();
    const Simplified simplified = hierarchy.simplify(source.selection());
    stop_if_interrupted();
    if (arguments.json) {
        print_json(terminal, source, hierarchy, simplified);
    } else {
        print_text(terminal, source.info(), hierarchy, simplified);
    }
    return 0;
}

}  // namespace isoatlas::cli

// isoatlas tree: the criticality tree, as a file, as JSON, or as a summary.
#include <algorithm>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "data/source.h"
#include "text/interrupt.h"
#include "text/simplified.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/tree_document.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kShown = 16;

std::string genera_text(const std::vector<std::int64_t>& genera) {
    std::string text;
    for (std::size_t i = 0; i < genera.size() && i < 8; ++i) text += fmt::format("{}{}", i > 0 ? "," : "", genera[i]);
    return text.empty() ? "-" : text + (genera.size() > 8 ? ",..." : "");
}

std::string position_text(const std::array<double, 3>& p) { return fmt::format("{:g},{:g},{:g}", p[0], p[1], p[2]); }

std::string interpolant_of(const Volume& volume, const Analysis& analysis) {
    return interpolant_text(volume.info, analysis.interpolant(), analysis.tunnel_height());
}

Criticality kind_of(const VolumeInfo& info, const Event& event) {
    return polarity_of(info) == Polarity::low ? mirrored(event.kind) : event.kind;
}

void print_counts(Terminal& terminal, const Volume& volume, const Analysis& analysis) {
    std::map<Criticality, std::int64_t> kinds;
    for (const EventId id : ids<EventId>(analysis.event_count())) ++kinds[kind_of(volume.info, analysis.event(id))];
    Table table({{"kind", true}, {"events"}});
    for (const auto& [kind, count] : kinds) table.add({name_of(kind), count_text(count)});
    table.print(terminal);
    terminal.out() << '\n'
                   << counted(analysis.event_count(), "event") << " from " << counted(analysis.level_count(), "level") << ", "
                   << counted(analysis.contour_arc_count(), "contour") << " (arcs), "
                   << counted(analysis.element_count(), "critical element") << "; " << interpolant_of(volume, analysis) << "\n\n";
}

/// The largest zones, each indented below its nearest ancestor in the list.
void print_largest_zones(Terminal& terminal, const Volume& volume, const Analysis& analysis) {
    const Scale scale(volume.info);
    std::vector<std::pair<std::int64_t, EventId>> largest;  // (-voxels, id)
    for (const EventId id : ids<EventId>(analysis.event_count())) largest.emplace_back(-analysis.event(id).zone.voxels, id);
    const auto shown = std::min<std::ptrdiff_t>(kShown, static_cast<std::ptrdiff_t>(largest.size()));
    std::partial_sort(largest.begin(), largest.begin() + shown, largest.end());
    std::vector<EventId> events;
    for (std::ptrdiff_t i = 0; i < shown; ++i) events.push_back(largest[static_cast<std::size_t>(i)].second);
    std::sort(events.rbegin(), events.rend());  // parents first

    std::unordered_map<EventId, int> depth;
    std::unordered_map<EventId, std::vector<EventId>> below;  // shown children of a shown event; none: top
    for (const EventId id : events) {
        EventId ancestor = analysis.event(id).parent;
        while (ancestor.exists() && depth.count(ancestor) == 0) ancestor = analysis.event(ancestor).parent;
        depth[id] = ancestor.exists() ? depth[ancestor] + 1 : 0;
        below[ancestor].push_back(id);
    }
    Table table(
        {{"zones with most voxels", true}, {"from"}, {scale.way()}, {"voxels in zone"}, {"object voxels"}, {"tunnels"}, {"cavities"}});
    std::vector<EventId> stack(below[EventId::none()].rbegin(), below[EventId::none()].rend());
    while (!stack.empty()) {
        const EventId id = stack.back();
        stack.pop_back();
        const Event event = analysis.event(id);
        table.add({fmt::format("{}{} {}", std::string(2 * static_cast<std::size_t>(depth[id]), ' '), name_of(kind_of(volume.info, event)),
                               id.number()),
                   scale.brief(event.zone.tau_high), event.parent.exists() ? scale.brief(event.zone.tau_low) : scale.last(),
                   count_text(event.zone.voxels), count_text(event.object_voxels), count_text(event.b1), count_text(event.b2)});
        const auto& children = below[id];
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
    table.print(terminal);
}

void print_rest(Terminal& terminal, std::int64_t count, std::int64_t shown) {
    if (count > shown) terminal.out() << "... and " << count_text(count - shown) << " more: -o tree.csv or --json\n";
}

void print_levels(Terminal& terminal, const Volume& volume, const Analysis& analysis) {
    const Scale scale(volume.info);
    Table table({{"level"}, {"value"}, {"event"}, {"genera in", true}, {"genera out", true}});
    const std::int64_t shown = std::min(kShown, analysis.level_count());
    for (std::int64_t id = 0; id < shown; ++id) {
        const Level level = analysis.level(id);
        table.add({fmt::format("{}", id), scale.brief(level.value), fmt::format("{}", level.event.number()), genera_text(level.in),
                   genera_text(level.out)});
    }
    table.print(terminal);
    print_rest(terminal, analysis.level_count(), shown);
}

void print_elements(Terminal& terminal, const Volume& volume, const Analysis& analysis) {
    const Scale scale(volume.info);
    Table table({{"element"}, {"value"}, {"position", true}, {"h0"}, {"l0"}});
    const std::int64_t shown = std::min(kShown, analysis.element_count());
    for (std::int64_t id = 0; id < shown; ++id) {
        const Element element = analysis.element(ElementId(id));
        table.add({fmt::format("{}", id), scale.brief(element.value), position_text(element.position), fmt::format("{}", element.h0),
                   fmt::format("{}", element.l0)});
    }
    table.print(terminal);
    print_rest(terminal, analysis.element_count(), shown);
}

void print_contours(Terminal& terminal, const Volume& volume, const Analysis& analysis) {
    const Scale scale(volume.info);
    Table table({{"contour"}, {"from"}, {scale.way()}, {"genus"}});
    const std::int64_t shown = std::min(kShown, analysis.contour_arc_count());
    for (std::int64_t id = 0; id < shown; ++id) {
        const ContourArc arc = analysis.contour_arc(id);
        table.add({fmt::format("{}", id), scale.brief(arc.value_high),
                   arc.lower == ElementId(analysis.element_count()) ? scale.last() : scale.brief(arc.value_low),
                   fmt::format("{}", arc.genus)});
    }
    table.print(terminal);
    print_rest(terminal, analysis.contour_arc_count(), shown);
}

void print_summary(Terminal& terminal, const Arguments& arguments, const Volume& volume, const Analysis& analysis) {
    print_counts(terminal, volume, analysis);
    switch (arguments.detail) {
        case TreeDetail::events: print_largest_zones(terminal, volume, analysis); break;
        case TreeDetail::levels: print_levels(terminal, volume, analysis); break;
        case TreeDetail::elements: print_elements(terminal, volume, analysis); break;
        case TreeDetail::contours: print_contours(terminal, volume, analysis); break;
    }
    const std::string file = shell_word(arguments.file) + reading_options(arguments);
    terminal.next("isoatlas objects " + file + "    # the significant objects");
    terminal.next("isoatlas tree " + file + " -o tree.json    # also .graphml .csv .vtu");
}

void write_file(Terminal& terminal, const Arguments& arguments, const Volume& volume, const Analysis& analysis) {
    {
        const WritingGuard guard;
        write_tree(arguments.output, volume, analysis, {.detail = arguments.detail, .all = arguments.all});
    }
    if (!arguments.json) {
        terminal.out() << shown_name(arguments.output) << ": " << counted(analysis.event_count(), "event") << ", detail "
                       << detail_name(arguments.detail) << ", " << interpolant_of(volume, analysis) << '\n';
        return;
    }
    print(terminal, tree_file_document(arguments, volume.info, analysis));
}

}  // namespace

int run_tree(const Arguments& arguments, Terminal& terminal) {
    if (!arguments.output.empty()) check_output(arguments, {".json", ".graphml", ".csv", ".vtu"});
    if (arguments.selects) return run_simplified_tree(arguments, terminal);
    Source source(arguments, terminal);
    const Analysis analysis = source.analysis(false);
    Volume volume;  // the document needs the header only
    volume.info = source.info();
    stop_if_interrupted();
    if (!arguments.output.empty()) {
        write_file(terminal, arguments, volume, analysis);
    } else if (arguments.json) {
        write_tree_json(terminal.out(), volume, analysis, {.detail = arguments.detail, .all = arguments.all});
    } else {
        print_summary(terminal, arguments, volume, analysis);
    }
    return 0;
}

}  // namespace isoatlas::cli

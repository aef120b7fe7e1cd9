// isoatlas handles: the isovalues at which tunnels open and close.
#include <algorithm>

#include <fmt/format.h>

#include "data/object_directory.h"
#include "data/source.h"
#include "text/document.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kTunnelsShown = 24;

Json handle_json(const Handle& handle, const VolumeInfo& info) {
    Json json{{"opens", info.calibration.reported(handle.opens)}, {"closes", info.calibration.reported(handle.closes)}};
    if (handle.is_open) json["open"] = true;
    json["event"] = handle.event.number();
    json["opened_at"] = handle.opened_at;
    json["closed_at"] = handle.closed_at;
    return json;
}

std::string place_text(const std::array<double, 3>& p) { return fmt::format("{},{},{}", p[0], p[1], p[2]); }

void print_text(Terminal& terminal, Source& source, const std::vector<Handle>& handles, bool exact, std::int64_t shown) {
    const Scale scale(source.info());
    Table table({{"#"}, {"opens"}, {"closes"}, {"opened at", true}, {"closed at", true}});
    for (std::int64_t i = 0; i < shown; ++i) {
        const Handle& handle = handles[static_cast<std::size_t>(i)];
        table.add({fmt::format("{}", i + 1), scale.brief(handle.opens), scale.brief(handle.closes), place_text(handle.opened_at),
                   handle.is_open ? "open when its object merges" : place_text(handle.closed_at)});
    }
    terminal.say(fmt::format("{}; pairs are {}; {}", counted(static_cast<std::int64_t>(handles.size()), "tunnel"),
                             exact ? "exact" : "approximate: the tunnel that opened last closes first",
                             interpolant_text(source.info(), source.interpolant(), source.tunnel_height())));
    table.print(terminal);
    if (shown < static_cast<std::int64_t>(handles.size()))
        terminal.say(fmt::format("and {} more", count_text(static_cast<std::int64_t>(handles.size()) - shown)));
}

/// The highest voxel of --object (of low values: the lowest).
VoxelId wanted_voxel(const Arguments& arguments, Source& source, Terminal& terminal) {
    const ObjectReference& reference = arguments.objects[0];
    if (reference.kind == ObjectReference::Kind::voxel) return VoxelId(reference.number);
    ObjectDirectory directory(arguments, source, terminal);
    const ChosenObject object = directory.find(arguments.objects).front();
    source.release_trees();
    if (!object.is_contour) return VoxelId(object.voxel);
    throw Error(ErrorKind::usage, {.what = title_of(object) + " is a cavity, and tunnels are those of objects", .next = "give an object"});
}

EventId wanted_event(const Arguments& arguments, const Source& source, VoxelId voxel, const Analysis& analysis) {
    const bool is_voxel = voxel.number() >= 0 && voxel.number() < analysis.extent().voxels();
    const EventId event = is_voxel ? event_of_highest(analysis, voxel) : EventId::none();
    if (event.exists()) return event;
    throw Error(ErrorKind::not_found, {.file = arguments.file,
                                       .what = fmt::format("{} is not the {} voxel of an object", voxel_word(voxel.number()),
                                                           polarity_of(source.info()) == Polarity::low ? "lowest" : "highest"),
                                       .expected = "an object of the table",
                                       .next = "isoatlas objects " + shell_word(arguments.file) + " lists objects"});
}

std::vector<Handle> find_handles(const Arguments& arguments, Source& source, Terminal& terminal) {
    const double min = source.selection().min_persistence;
    const VoxelId voxel = arguments.objects.empty() ? VoxelId::none() : wanted_voxel(arguments, source, terminal);
    const Analysis analysis = source.analysis(false);
    if (!arguments.exact) return pair_handles(analysis, min);
    const EventId event = arguments.objects.empty() ? EventId::none() : wanted_event(arguments, source, voxel, analysis);
    return pair_handles_exactly(source.volume(), analysis, {.min_persistence = min, .event = event}, source.context());
}

void check_handles_arguments(const Arguments& arguments) {
    if (!arguments.exact && !arguments.objects.empty())
        throw Error(ErrorKind::usage, {.what = "--object applies to exact pairs only", .next = "add --exact"});
    if (arguments.objects.size() > 1) throw Error(ErrorKind::usage, {.what = "one object at a time", .next = "give --object once"});
    if (!arguments.objects.empty() && arguments.objects[0].tau)
        throw Error(ErrorKind::usage, {.what = "tunnels are those of an object at all its isovalues", .next = "omit @ and the isovalue"});
}

}  // namespace

int run_handles(const Arguments& arguments, Terminal& terminal) {
    check_handles_arguments(arguments);
    Source source(arguments, terminal);
    const std::vector<Handle> handles = find_handles(arguments, source, terminal);
    const auto all = static_cast<std::int64_t>(handles.size());
    const std::int64_t top = arguments.top > 0 ? arguments.top : kTunnelsShown, shown = std::min(all, top);
    if (!arguments.json) {
        print_text(terminal, source, handles, arguments.exact, shown);
        return 0;
    }
    Json head = document("handles", source.info(), source.interpolant(), source.tunnel_height());
    head["pairs"] = arguments.exact ? "exact" : "approximate";
    head["tunnels"] = all;
    print(terminal, head, "handles", shown,
          [&](std::int64_t i) { return handle_json(handles[static_cast<std::size_t>(i)], source.info()); });
    return 0;
}

}  // namespace isoatlas::cli

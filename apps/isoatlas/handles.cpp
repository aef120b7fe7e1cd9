// isoatlas handles: from which isovalue to which does a tunnel live?
#include <algorithm>

#include <fmt/format.h>

#include "document.h"
#include "source.h"
#include "table.h"
#include "terminal.h"
#include "values.h"
#include "verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kDefaultTop = 24;

Json handle_json(const Handle& handle, const VolumeInfo& info) {
    Json json{{"opens", info.calibration.reported(handle.opens)}, {"closes", info.calibration.reported(handle.closes)}};
    json["event"] = handle.event;
    json["opened_at"] = handle.opened_at;
    json["closed_at"] = handle.closed_at;
    return json;
}

std::string place_text(const std::array<double, 3>& p) { return fmt::format("{},{},{}", p[0], p[1], p[2]); }

void print_text(Terminal& terminal, Source& source, const std::vector<Handle>& handles, std::int64_t shown) {
    const Scale scale(source.info());
    Table table({{"#"}, {"opens"}, {"closes"}, {"opened at", true}, {"closed at", true}});
    for (std::int64_t i = 0; i < shown; ++i) {
        const Handle& handle = handles[static_cast<std::size_t>(i)];
        table.add({fmt::format("{}", i + 1), scale.brief(handle.opens), scale.brief(handle.closes), place_text(handle.opened_at),
                   place_text(handle.closed_at)});
    }
    terminal.say(fmt::format("{}; pairs are approximate: the tunnel that opened last closes first; {}",
                             counted(static_cast<std::int64_t>(handles.size()), "tunnel"),
                             interpolant_text(source.info(), source.interpolant(), source.tunnel_height())));
    table.print(terminal);
    if (shown < static_cast<std::int64_t>(handles.size()))
        terminal.say(fmt::format("and {} more", count_text(static_cast<std::int64_t>(handles.size()) - shown)));
}

}  // namespace

int run_handles(const Arguments& arguments, Terminal& terminal) {
    Source source(arguments, terminal);
    const Analysis analysis = source.analysis(false);
    const std::vector<Handle> handles = pair_handles(analysis, source.selection().least_persistence);
    const auto all = static_cast<std::int64_t>(handles.size());
    const std::int64_t top = arguments.top > 0 ? arguments.top : kDefaultTop, shown = std::min(all, top);
    if (!arguments.json) {
        print_text(terminal, source, handles, shown);
        return 0;
    }
    Json head = document("handles", source.info(), source.interpolant(), source.tunnel_height());
    head["pairs"] = "approximate";
    head["tunnels"] = all;
    print(terminal, head, "handles", shown,
          [&](std::int64_t i) { return handle_json(handles[static_cast<std::size_t>(i)], source.info()); });
    return 0;
}

}  // namespace isoatlas::cli

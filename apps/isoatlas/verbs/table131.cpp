// isoatlas table131: table 13.1 of the dissertation, for any volume.
#include <cmath>

#include <fmt/format.h>

#include "data/source.h"
#include "text/document.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

Json json_of(const Spread& spread) { return {{"max", spread.max}, {"average", spread.average}, {"min", spread.min}}; }

Json json_of(const SearchWay& way) {
    return {{"cells_visited", json_of(way.visited)},
            {"cells_loaded", json_of(way.loaded)},
            {"load_utility", json_of(way.load_utility)},
            {"travel_utility", json_of(way.travel_utility)},
            {"loaded_percent", json_of(way.loaded_percent)}};
}

class Printer {
public:
    Printer() : table_({{"", true}, {"max"}, {"average"}, {"min"}}) {}
    void head(const std::string& title) { table_.add({title, "", "", ""}); }
    void counts(const std::string& title, const Spread& s) {
        table_.add({title, count_text(static_cast<std::int64_t>(s.max)), count_text(std::llround(s.average)),
                    count_text(static_cast<std::int64_t>(s.min))});
    }
    void percents(const std::string& title, const Spread& s) {
        table_.add({title, fmt::format("{:.1f}", s.max), fmt::format("{:.1f}", s.average), fmt::format("{:.1f}", s.min)});
    }
    void way(const std::string& title, const SearchWay& way) {
        head(title);
        counts("  cells visited", way.visited);
        counts("  cells loaded", way.loaded);
        percents("  load utility, %", way.load_utility);
        percents("  travel utility, %", way.travel_utility);
        percents("  cells loaded, % of all", way.loaded_percent);
    }
    void print(Terminal& terminal) const { table_.print(terminal); }

private:
    Table table_;
};

void print_text(Terminal& terminal, const SearchTable& table, const std::string& interpolant) {
    Printer printer;
    printer.counts("points in a zone", table.zone_points);
    printer.counts("active cells", table.active);
    printer.percents("active cells, % of all", table.active_percent);
    printer.way("zone files (the dissertation's)", table.zone_files);
    printer.way("bricks (of a store)", table.bricks);
    printer.print(terminal);
    terminal.out() << '\n'
                   << counted(table.cells, "cell") << ", " << counted(table.zones, "zone") << ", " << counted(table.isovalues, "isovalue")
                   << " (one between neighbouring critical values); " << interpolant << '\n';
}

}  // namespace

int run_table131(const Arguments& arguments, Terminal& terminal) {
    Source source(arguments, terminal);
    const Volume& volume = source.volume();
    const Analysis analysis = source.analysis(true);
    const SearchTable table = search_table(volume, analysis, source.context());
    if (!arguments.json) {
        print_text(terminal, table, interpolant_text(source.info(), source.interpolant(), source.tunnel_height()));
        return 0;
    }
    Json json = document("table131", source.info(), source.interpolant(), source.tunnel_height());
    json["cells"] = table.cells;
    json["zones"] = table.zones;
    json["isovalues"] = table.isovalues;
    json["zone_points"] = json_of(table.zone_points);
    json["active_cells"] = json_of(table.active);
    json["active_percent"] = json_of(table.active_percent);
    json["zone_files"] = json_of(table.zone_files);
    json["bricks"] = json_of(table.bricks);
    print(terminal, json);
    return 0;
}

}  // namespace isoatlas::cli

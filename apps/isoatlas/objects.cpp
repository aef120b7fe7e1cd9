// isoatlas objects: the table people come for, or every object at one isovalue.
#include <algorithm>
#include <cmath>

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

/// Voxel counts, and physical sizes where they say something else.
class Sizes {
public:
    Sizes(const VolumeInfo& info, double largest) : unit_(measure_unit(info, largest)), flat_(info.extent.rank == 2) {}

    void add_titles(std::vector<Table::Column>& columns) const {
        columns.push_back({"voxels"});
        if (is_physical()) columns.push_back({std::string(flat_ ? "area" : "volume") + " [" + unit_.name + "]"});
        columns.push_back({flat_ ? "holes" : "tunnels"});
        if (!flat_) columns.push_back({"cavities"});
    }
    void add(std::vector<std::string>& row, std::int64_t voxels, double measure, std::int64_t b1, std::int64_t b2) const {
        row.push_back(count_text(voxels));
        if (is_physical()) row.push_back(measure_text(measure * unit_.factor));
        row.push_back(dashed(b1));
        if (!flat_) row.push_back(dashed(b2));
    }

private:
    [[nodiscard]] bool is_physical() const { return unit_.name != "voxels"; }
    static std::string dashed(std::int64_t count) { return count == 0 ? "-" : count_text(count); }
    static std::string measure_text(double measure) {
        return measure < 1000 ? fmt::format("{:.4g}", measure) : count_text(static_cast<std::int64_t>(std::round(measure)));
    }

    MeasureUnit unit_;
    bool flat_;
};

template <class Objects>
double largest_measure(const Objects& objects) {
    double largest = 0;
    for (const auto& object : objects) largest = std::max(largest, object.measure);
    return largest;
}

std::string extract_command(const Arguments& arguments, std::int64_t id, const std::string& tau) {
    return fmt::format("isoatlas extract {}{} --tau {} --object {} -o object.ply", shell_word(arguments.file), reading_options(arguments),
                       tau, id);
}

// The table: objects at their own best isovalues.

Json entry_json(const ObjectEntry& entry, const VolumeInfo& info, const Scale& scale) {
    Json json{{"id", entry.id}, {"event", entry.event}};
    json["appears"] = number(scale.reported(entry.appears));
    json["merges"] = number(scale.reported(entry.merges));
    json["best_tau"] = scale.reported(entry.best_tau);
    json["chi"] = 1 - entry.tunnels + entry.cavities;
    json["b1"] = entry.tunnels;
    json["b2"] = entry.cavities;
    json["tunnels"] = entry.tunnels;
    json["cavities"] = entry.cavities;
    json["voxels"] = entry.voxels;
    json["measure"] = entry.measure;
    json["hypervolume"] = entry.hypervolume * info.calibration.slope;
    json["position"] = entry.position;
    json["position_physical"] = to_physical(info.geometry, entry.position);
    json["note"] = entry.note;
    return json;
}

void print_table_json(Terminal& terminal, Source& source, const ObjectTable& table) {
    const VolumeInfo& info = source.info();
    const Scale scale(info);
    Json head = document("objects", info, source.interpolant(), source.tunnel_height());
    head["tau"] = nullptr;
    head["branches"] = table.branches;
    head["noise"] = table.noise * info.calibration.slope;
    add_reads(head, source.reads());
    print(terminal, head, "objects", static_cast<std::int64_t>(table.entries.size()),
          [&](std::int64_t i) { return entry_json(table.entries[static_cast<std::size_t>(i)], info, scale); });
}

std::string best_tau_text(const ObjectEntry& entry, const Scale& scale) {
    return scale.text_within(entry.best_tau, entry.tau_low, entry.tau_high);
}

void tell_table(Terminal& terminal, Source& source, const ObjectTable& table) {
    const VolumeInfo& info = source.info();
    const auto lines = static_cast<std::int64_t>(table.entries.size());
    const std::string noise = table.noise > 0 ? fmt::format("; noise about {:.3g}", table.noise * info.calibration.slope) : "";
    terminal.say(fmt::format("{} in all; {} to look at, some objects at several isovalues{}; {}",
                             counted(table.branches, "maximum", "maxima"), counted(lines, "line"), noise,
                             interpolant_text(info, source.interpolant(), source.tunnel_height())));
}

void print_table_text(Terminal& terminal, const Arguments& arguments, Source& source, const ObjectTable& table) {
    const Scale scale(source.info());
    const Sizes sizes(source.info(), largest_measure(table.entries));
    std::vector<Table::Column> columns{{"#"}, {"id"}, {"appears"}, {"merges"}, {"best tau"}};
    sizes.add_titles(columns);
    columns.push_back({"note", true});
    Table text(columns);
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const ObjectEntry& entry = table.entries[i];
        std::vector<std::string> row{fmt::format("{}", i + 1), fmt::format("{}", entry.id), scale.brief(entry.appears),
                                     scale.brief(entry.merges), best_tau_text(entry, scale)};
        sizes.add(row, entry.voxels, entry.measure, entry.tunnels, entry.cavities);
        row.push_back(entry.note);
        text.add(row);
    }
    tell_table(terminal, source, table);
    text.print(terminal);
    if (table.entries.empty()) {
        terminal.say("nothing rises above the noise; --all lists everything");
        return;
    }
    terminal.next(extract_command(arguments, table.entries[0].id, best_tau_text(table.entries[0], scale)));
}

int list_best(const Arguments& arguments, Terminal& terminal) {
    Source source(arguments, terminal);
    const std::int64_t top = arguments.top > 0 ? arguments.top : arguments.all ? 0 : kDefaultTop;
    const ObjectTable table = source.objects({.top = top, .gate = !arguments.all});
    if (arguments.json) {
        print_table_json(terminal, source, table);
    } else {
        print_table_text(terminal, arguments, source, table);
    }
    return 0;
}

// One isovalue: every object.

Json object_json(const CutObject& object, const Cut& cut) {
    Json contours = Json::array();
    for (std::int64_t i = 0; i < object.contour_count; ++i) {
        const CutContour& contour = cut.contours[static_cast<std::size_t>(object.first_contour + i)];
        contours.push_back({{"id", contour.id}, {"genus", contour.genus}, {"shell", contour.shell == Shell::outer ? "outer" : "inner"}});
    }
    return {{"id", object.id},
            {"chi", object.chi},
            {"b1", object.b1},
            {"b2", object.b2},
            {"voxels", object.voxels},
            {"measure", object.measure},
            {"box", {{"low", object.box_low}, {"high", object.box_high}}},
            {"contours", std::move(contours)}};
}

void print_cut_json(Terminal& terminal, const Source& source, const Cut& cut, std::int64_t shown, double tau) {
    Json head = document("objects", source.info(), cut.interpolant, cut.tunnel_height);
    head["tau"] = tau;
    head["object_count"] = cut.objects.size();
    head["contour_count"] = cut.contours.size();
    head["active_cells"] = cut.active_cells;
    add_reads(head, source.reads());
    print(terminal, head, "objects", shown, [&](std::int64_t i) { return object_json(cut.objects[static_cast<std::size_t>(i)], cut); });
}

std::string box_text(const CutObject& object, int rank) {
    std::string text;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(rank); ++axis) {
        text += fmt::format("{}{}..{}", axis > 0 ? " x " : "", object.box_low[axis], object.box_high[axis]);
    }
    return text;
}

void print_cut_text(Terminal& terminal, const Arguments& arguments, const VolumeInfo& info, const Cut& cut, std::int64_t shown) {
    const Sizes sizes(info, largest_measure(cut.objects));
    std::vector<Table::Column> columns{{"#"}, {"id"}};
    sizes.add_titles(columns);
    columns.insert(columns.end(), {{"contours"}, {"box", true}});
    Table text(columns);
    for (std::int64_t i = 0; i < shown; ++i) {
        const CutObject& object = cut.objects[static_cast<std::size_t>(i)];
        std::vector<std::string> row{fmt::format("{}", i + 1), fmt::format("{}", object.id)};
        sizes.add(row, object.voxels, object.measure, object.b1, object.b2);
        row.insert(row.end(), {count_text(object.contour_count), box_text(object, info.extent.rank)});
        text.add(row);
    }
    const auto all = static_cast<std::int64_t>(cut.objects.size());
    terminal.say(fmt::format("{} with {} at {}; {}", counted(all, "object"),
                             counted(static_cast<std::int64_t>(cut.contours.size()), "contour"), *arguments.tau,
                             interpolant_text(info, cut.interpolant, cut.tunnel_height)));
    text.print(terminal);
    if (shown < all) terminal.say(fmt::format("and {} more", count_text(all - shown)));
    terminal.next(extract_command(arguments, cut.objects[0].id, fmt::format("{}", *arguments.tau)));
}

int list_at(const Arguments& arguments, Terminal& terminal) {
    Source source(arguments, terminal);
    const Cut at = source.cut(source.tau(), false);
    const auto all = static_cast<std::int64_t>(at.objects.size());
    const std::int64_t shown = arguments.top > 0 ? std::min(all, arguments.top) : all;
    if (arguments.json) {
        print_cut_json(terminal, source, at, shown, *arguments.tau);
    } else {
        print_cut_text(terminal, arguments, source.info(), at, shown);
    }
    return 0;
}

}  // namespace

int run_objects(const Arguments& arguments, Terminal& terminal) {
    return arguments.tau ? list_at(arguments, terminal) : list_best(arguments, terminal);
}

}  // namespace isoatlas::cli

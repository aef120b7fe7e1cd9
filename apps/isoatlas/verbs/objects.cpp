// isoatlas objects: the table of significant objects, or every object at one isovalue.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "data/assume_inputs.h"
#include "data/object_directory.h"
#include "data/source.h"
#include "text/cavity_table.h"
#include "text/document.h"
#include "text/entry_json.h"
#include "text/simplified.h"
#include "text/sizes.h"
#include "text/table.h"
#include "text/terminal.h"
#include "text/values.h"
#include "verbs/verbs.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kObjectsShown = 24;

std::string extract_command(const Arguments& arguments, const std::string& reference) {
    return fmt::format("isoatlas extract {}{} --object {} -o object.ply", shell_word(arguments.file), reading_options(arguments),
                       reference);
}

// The table: objects at their best isovalues.

Json entry_json(const ObjectTable& table, std::size_t i, const VolumeInfo& info, ObjectDirectory& directory,
                const std::vector<std::string>& called, const Card& card) {
    const ObjectEntry& entry = table.entries[i];
    const Scale scale(info);
    Json json{{"id", entry.id}, {"event", entry.event.number()}};
    const std::int64_t number = directory.number_of(entry);
    add_number_and_name(json, number, directory.name_of(entry));
    json["reference"] = with_polarity(number == 0 ? voxel_word(entry.id) : std::to_string(number), polarity_of(info));
    add_isovalues_and_topology(json, table, entry, scale);
    add_size_and_place(json, entry, info, joined_notes(note_of(entry, called), likeness_note(card, i, called)));
    json["like"] = likeness_json(card, static_cast<std::int64_t>(card.line) + 1, card.line == i);
    if (scale.is_low()) json["border"] = border_json(entry.border);
    return json;
}

/// Number of objects, which may have several lines.
std::int64_t shown_objects(const ObjectTable& table) {
    std::set<std::array<double, 4>> branches;  // no two objects have the same peak and the same size
    for (const ObjectEntry& entry : table.entries) {
        const auto top = static_cast<double>(entry.branch_top.number());
        branches.insert({entry.appears, entry.merges, entry.hypervolume, top});
    }
    return static_cast<std::int64_t>(branches.size());
}

/// cavities: listed too; may be null.
void print_table_json(Terminal& terminal, Source& source, ObjectDirectory& directory, const ObjectTable& table,
                      const CavityTable* cavities = nullptr) {
    const VolumeInfo& info = source.info();
    const std::vector<std::string> called = references_of(table, directory, "");
    const std::vector<Card> cards = cards_of(table, info.extent);
    Json head = document("objects", info, source.interpolant(), source.tunnel_height());
    head["tau"] = nullptr;
    head["branches"] = table.branches;
    head["hidden"] = table.branches - shown_objects(table);
    head["noise"] = table.noise * info.calibration.slope;
    const ValueRange range = source.range();
    head["noise_part"] = range.high > range.low ? table.noise / (range.high - range.low) : 0;
    if (cavities != nullptr) add_cavities(head, *cavities, info, directory);
    add_reads(head, source.reads());
    print(terminal, head, "objects", static_cast<std::int64_t>(table.entries.size()), [&](std::int64_t i) {
        const auto line = static_cast<std::size_t>(i);
        return entry_json(table, line, info, directory, called, cards[line]);
    });
}

std::string best_tau_text(const ObjectEntry& entry, const Scale& scale) {
    return scale.text_within(entry.best_tau, entry.tau_low, entry.tau_high);
}

void tell_table(Terminal& terminal, Source& source, const ObjectTable& table) {
    const VolumeInfo& info = source.info();
    const Scale scale(info);
    const auto lines = static_cast<std::int64_t>(table.entries.size());
    const std::string noise = table.noise > 0 ? fmt::format("; noise about {:.3g}", table.noise * info.calibration.slope) : "";
    terminal.say(fmt::format("{} in all, {} hidden; {} listed, some objects at several isovalues{}; {}",
                             scale.is_low() ? counted(table.branches, "minimum", "minima") : counted(table.branches, "maximum", "maxima"),
                             count_text(table.branches - shown_objects(table)), counted(lines, "line"), noise,
                             interpolant_text(info, source.interpolant(), source.tunnel_height())));
}

/// Recommended isovalues without a line of their own.
void tell_other_isovalues(Terminal& terminal, const ObjectTable& table, const std::vector<std::string>& called, const Scale& scale) {
    std::set<std::pair<std::int64_t, double>> told;
    for (const ObjectEntry& entry : table.entries) told.emplace(entry.branch_top.number(), entry.best_tau);
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        std::vector<RecommendedIsovalue> others = isovalues_of(table.isovalues, table.entries[i].branch_top.number());
        std::erase_if(others, [&](const RecommendedIsovalue& isovalue) { return !told.emplace(isovalue.branch_top, isovalue.tau).second; });
        tell_isovalues(terminal, called[i], others, scale);
    }
}

/// Objects of low values may reach the border; those that do not are cavities of others.
std::string with_border(const std::string& note, const ObjectEntry& entry, const VolumeInfo& info) {
    if (polarity_of(info) == Polarity::high) return note;
    const std::string border = entry.border.is_known() && entry.border.sides == 0 ? "cavity" : border_text(entry.border, info.extent);
    return joined_notes(note, border);
}

void print_table_text(Terminal& terminal, const Arguments& arguments, Source& source, ObjectDirectory& directory,
                      const ObjectTable& table) {
    const Scale scale(source.info());
    const Sizes sizes(source.info(), largest_measure(table.entries));
    const std::vector<std::string> numbers = numbers_of(table, directory, ""), called = references_of(table, directory, "");
    const std::vector<Card> cards = cards_of(table, source.info().extent);
    const bool has_name = has_names(table, directory);
    std::vector<Table::Column> columns{{"#"}};
    if (has_name) columns.push_back({"name", true});
    columns.insert(columns.end(), {{"id"}, {"appears"}, {"merges"}, {"best tau" + in_unit(source.info())}});
    sizes.add_titles(columns);
    columns.insert(columns.end(), {{"reason", true}, {"note", true}});
    Table text(columns);
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const ObjectEntry& entry = table.entries[i];
        std::vector<std::string> row{numbers[i]};
        if (has_name) row.push_back(directory.name_of(entry));
        row.insert(row.end(), {voxel_word(entry.id), scale.brief(entry.appears), scale.brief(entry.merges), best_tau_text(entry, scale)});
        sizes.add(row, entry.voxels, entry.measure, entry.tunnels, entry.cavities);
        const std::optional<RecommendedIsovalue> best = isovalue_of(table, entry);
        const std::string note = joined_notes(note_of(entry, called), likeness_note(cards[i], i, called));
        row.insert(row.end(), {best ? name_of(best->reason) : "", with_border(note, entry, source.info())});
        text.add(row);
    }
    tell_table(terminal, source, table);
    text.print(terminal);
    if (const std::string advice = noise_advice(arguments, source.info()); !advice.empty()) terminal.say("note: " + advice);
    tell_other_isovalues(terminal, table, called, scale);
    if (table.entries.empty()) {
        terminal.say("no object is above the noise level; --all lists all objects");
        return;
    }
    const bool has_number = numbers[0] != "-";
    terminal.next(extract_command(arguments, has_number ? numbers[0] : called[0] + "@" + best_tau_text(table.entries[0], scale)));
}

/// Cavities; with --both after the objects.
int list_cavities(const Arguments& arguments, Terminal& terminal, Source& source, const RankOptions& options) {
    ObjectDirectory directory(arguments, source, terminal);
    const bool is_numbered = !arguments.all && !arguments.selects;
    if (!arguments.both) {
        const CavityTable cavities = source.cavities(options);
        if (is_numbered) directory.know(cavities);
        print_cavities(terminal, arguments, source, cavities, directory);
        return 0;
    }
    const auto [table, cavities] = source.objects_and_cavities(options);
    if (is_numbered) directory.know(table), directory.know(cavities);
    if (arguments.json) {
        print_table_json(terminal, source, directory, table, &cavities);
        return 0;
    }
    print_table_text(terminal, arguments, source, directory, table);
    terminal.out() << '\n';
    print_cavities(terminal, arguments, source, cavities, directory);
    return 0;
}

int list_best(const Arguments& arguments, Terminal& terminal) {
    if (arguments.all && arguments.selects)
        throw Error(ErrorKind::usage, {.what = "--all and a selection contradict each other", .next = "isoatlas objects --help"});
    if (!arguments.curve.empty()) check_output(arguments, arguments.curve, {".csv", ".svg", ".json"});
    Source source(arguments, terminal);
    const std::int64_t top = arguments.top > 0 ? arguments.top : arguments.all ? 0 : kObjectsShown;
    RankOptions options{.top = top, .gate = !arguments.all};
    if (arguments.selects) {
        options.selection = source.selection();
        if (arguments.top == 0) options.top = 0;
    }
    if (!arguments.curve.empty()) write_curves(arguments, source);
    if (arguments.cavities || arguments.both) return list_cavities(arguments, terminal, source, options);
    const ObjectTable table = source.objects(options);
    ObjectDirectory directory(arguments, source, terminal);
    if (!arguments.all && !arguments.selects) directory.know(table);
    if (arguments.json) {
        print_table_json(terminal, source, directory, table);
    } else {
        print_table_text(terminal, arguments, source, directory, table);
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
    std::vector<Table::Column> columns{{"label"}, {"id"}};  // no numbers of the table
    sizes.add_titles(columns);
    columns.insert(columns.end(), {{"contours"}, {"box", true}});
    Table text(columns);
    for (std::int64_t i = 0; i < shown; ++i) {
        const CutObject& object = cut.objects[static_cast<std::size_t>(i)];
        std::vector<std::string> row{fmt::format("{}", i + 1), voxel_word(object.id)};
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
    terminal.next(extract_command(arguments, fmt::format("{}@{}", voxel_word(cut.objects[0].id), *arguments.tau)));
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
    if (arguments.inputs.are_labels) return list_label_objects(arguments, terminal);
    if (arguments.polarity == PolarityChoice::both) return run_objects_of_both(arguments, terminal);
    if (arguments.tau && (arguments.selects || !arguments.curve.empty())) {
        throw Error(ErrorKind::usage, {.what = "a selection applies to the table of best isovalues, not to one isovalue",
                                       .next = "omit --tau, or the selection"});
    }
    if (arguments.tau && (arguments.cavities || arguments.both)) {
        throw Error(ErrorKind::usage,
                    {.what = "--tau lists the objects at an isovalue, --cavities and --both the best isovalues of cavities",
                     .next = "isoatlas label --cavities --tau T labels the cavities at an isovalue"});
    }
    return arguments.tau ? list_at(arguments, terminal) : list_best(arguments, terminal);
}

}  // namespace isoatlas::cli

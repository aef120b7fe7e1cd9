#include "text/cavity_table.h"

#include "text/entry_json.h"

#include <fmt/format.h>

#include "data/source.h"
#include "text/sizes.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {
namespace {

Json entry_json(const CavityTable& table, std::size_t i, const VolumeInfo& info, ObjectDirectory& directory,
                const std::vector<std::string>& called) {
    const CavityEntry& entry = table.entries[i];
    const Scale scale(info);
    Json json{{"id", entry.id}};
    add_number_and_name(json, directory.number_of(entry), directory.name_of(entry));
    add_isovalues(json, entry, scale);
    json["reason"] = name_of(entry.reason);
    json["isovalues"] = isovalues_json(isovalues_of(table.isovalues, entry.branch_minimum), scale);
    json["object"] = entry.object;
    json["tunnels"] = entry.tunnels;
    json["islands"] = entry.islands;
    add_size_and_place(json, entry, info, note_of(entry, called));
    return json;
}

std::string best_tau_text(const CavityEntry& entry, const Scale& scale) {
    return scale.text_within(entry.best_tau, entry.tau_low, entry.tau_high);
}

void print_text(Terminal& terminal, const Arguments& arguments, const VolumeInfo& info, const CavityTable& table,
                ObjectDirectory& directory) {
    const std::vector<std::string> numbers = numbers_of(table, directory, "c"), called = references_of(table, directory, "c");
    const bool has_name = has_names(table, directory);
    const Scale scale(info);
    const Sizes sizes(info, largest_measure(table.entries));
    std::vector<Table::Column> columns{{"cavity"}};
    if (has_name) columns.push_back({"name", true});
    columns.insert(columns.end(), {{"id"}, {"appears"}, {"merges"}, {"best tau"}});
    sizes.add_titles(columns, "islands");
    columns.insert(columns.end(), {{"inside"}, {"reason", true}, {"note", true}});
    Table text(columns);
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        const CavityEntry& entry = table.entries[i];
        std::vector<std::string> row{numbers[i]};
        if (has_name) row.push_back(directory.name_of(entry));
        row.insert(row.end(), {voxel_word(entry.id), scale.brief(entry.appears), scale.brief(entry.merges), best_tau_text(entry, scale)});
        sizes.add(row, entry.voxels, entry.measure, entry.tunnels, entry.islands);
        row.insert(row.end(), {voxel_word(entry.object), name_of(entry.reason), note_of(entry, called)});
        text.add(row);
    }
    terminal.say(fmt::format("{} in all; {} listed", counted(table.branches, "cavity", "cavities"),
                             counted(static_cast<std::int64_t>(table.entries.size()), "cavity", "cavities")));
    text.print(terminal);
    for (std::size_t i = 0; i < table.entries.size(); ++i) {
        std::vector<RecommendedIsovalue> others = isovalues_of(table.isovalues, table.entries[i].branch_minimum);
        if (!others.empty()) others.erase(others.begin());
        tell_isovalues(terminal, called[i], others, scale);
    }
    if (table.entries.empty()) {
        terminal.say("no significant cavities; --all lists all of them");
        return;
    }
    const CavityEntry& first = table.entries[0];
    const std::string reference = numbers[0] == "-" ? called[0] + "@" + best_tau_text(first, scale) : called[0];
    terminal.next(
        fmt::format("isoatlas extract {}{} --contour {} -o cavity.ply", shell_word(arguments.file), reading_options(arguments), reference));
}

}  // namespace

void add_cavities(Json& json, const CavityTable& table, const VolumeInfo& info, ObjectDirectory& directory) {
    json["cavity_branches"] = table.branches;
    const std::vector<std::string> called = references_of(table, directory, "c");
    Json& list = json["cavities"] = Json::array();
    for (std::size_t i = 0; i < table.entries.size(); ++i) list.push_back(entry_json(table, i, info, directory, called));
}

void print_cavities(Terminal& terminal, const Arguments& arguments, Source& source, const CavityTable& table, ObjectDirectory& directory) {
    const VolumeInfo& info = source.info();
    if (!arguments.json) return print_text(terminal, arguments, info, table, directory);
    const std::vector<std::string> called = references_of(table, directory, "c");
    Json head = document("cavities", info, source.interpolant(), source.tunnel_height());
    head["branches"] = table.branches;
    head["noise"] = table.noise * info.calibration.slope;
    add_reads(head, source.reads());
    print(terminal, head, "objects", static_cast<std::int64_t>(table.entries.size()),
          [&](std::int64_t i) { return entry_json(table, static_cast<std::size_t>(i), info, directory, called); });
}

}  // namespace isoatlas::cli

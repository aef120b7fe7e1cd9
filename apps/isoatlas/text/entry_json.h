// Members that the tables of objects and cavities have in common. Entry: ObjectEntry, CavityEntry.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <isoatlas/isoatlas.h>

#include "data/object_directory.h"
#include "options/object_reference.h"
#include "text/document.h"
#include "text/terminal.h"
#include "text/values.h"

namespace isoatlas::cli {

template <class Entry>
void add_isovalues(Json& json, const Entry& entry, const Scale& scale) {
    json["appears"] = number(scale.reported(entry.appears));
    json["merges"] = number(scale.reported(entry.merges));
    json["best_tau"] = scale.reported(entry.best_tau);
}

[[nodiscard]] inline Json isovalues_json(const std::vector<RecommendedIsovalue>& isovalues, const Scale& scale) {
    Json list = Json::array();
    for (const RecommendedIsovalue& isovalue : isovalues) {
        Json json{{"tau", scale.reported(isovalue.tau)}, {"reason", name_of(isovalue.reason)}, {"prominence", number(isovalue.prominence)}};
        if (isovalue.cavity >= 0) json["cavity"] = isovalue.cavity;
        list.push_back(json);
    }
    return list;
}

/// Of an object of the table.
inline void add_isovalues_and_topology(Json& json, const ObjectTable& table, const ObjectEntry& entry, const Scale& scale) {
    add_isovalues(json, entry, scale);
    const std::optional<RecommendedIsovalue> best = isovalue_of(table, entry);
    json["reason"] = best ? Json(name_of(best->reason)) : Json(nullptr);
    json["isovalues"] = isovalues_json(isovalues_of(table.isovalues, entry.branch_top.number()), scale);
    json["chi"] = 1 - entry.tunnels + entry.cavities;
    json["b1"] = entry.tunnels;
    json["b2"] = entry.cavities;
    json["tunnels"] = entry.tunnels;
    json["cavities"] = entry.cavities;
}

/// Prints the other recommended isovalues of an entry; nothing if there are none.
/// entry: how it is called.
inline void tell_isovalues(Terminal& terminal, const std::string& entry, const std::vector<RecommendedIsovalue>& others,
                           const Scale& scale) {
    std::string text;
    for (const RecommendedIsovalue& isovalue : others) {
        const std::string cavity = isovalue.cavity < 0 ? "" : ", cavity " + voxel_word(isovalue.cavity);
        text += fmt::format("{} {} ({}{})", text.empty() ? "" : ",", scale.brief(isovalue.tau), name_of(isovalue.reason), cavity);
    }
    if (!text.empty()) terminal.say(fmt::format("{} also at{}", entry, text));
}

/// Its number in the table of significant ones and the name that a user gave it; null: it has none.
inline void add_number_and_name(Json& json, std::int64_t number, const std::string& name) {
    json["number"] = number == 0 ? Json(nullptr) : Json(number);
    json["name"] = name.empty() ? Json(nullptr) : Json(name);
}

/// "inside 3", where entries of the table are called so.
template <class Entry>
std::string note_of(const Entry& entry, const std::vector<std::string>& called) {
    return entry.note.starts_with("inside ") ? "inside " + called[static_cast<std::size_t>(entry.inside)] : entry.note;
}

/// "like 1 (84 %)": it is on the card of line 1; empty: it has its own card. called: every line of the table.
[[nodiscard]] inline std::string likeness_note(const Card& card, std::size_t line, const std::vector<std::string>& called) {
    return card.line == line ? "" : fmt::format("like {} ({} %)", called[card.line], std::lround(100 * card.overlap));
}

/// line: from 1, in the list that is printed; 0: it is not in the list.
[[nodiscard]] inline Json likeness_json(const Card& card, std::int64_t line, bool is_own) {
    if (is_own || line == 0) return nullptr;
    return {{"line", line}, {"overlap", card.overlap}};
}

[[nodiscard]] inline std::string joined_notes(const std::string& note, const std::string& other) {
    return note.empty() || other.empty() ? note + other : note + ", " + other;
}

/// Number of every line of a table: "2", "c3"; "-": it has none.
template <class Table>
std::vector<std::string> numbers_of(const Table& table, ObjectDirectory& directory, const std::string& letter) {
    std::vector<std::string> numbers;
    for (const auto& entry : table.entries) {
        const std::int64_t number = directory.number_of(entry);
        numbers.push_back(number == 0 ? "-" : letter + std::to_string(number));
    }
    return numbers;
}

/// The same, or the voxel of a line without a number.
template <class Table>
std::vector<std::string> references_of(const Table& table, ObjectDirectory& directory, const std::string& letter) {
    std::vector<std::string> called = numbers_of(table, directory, letter);
    for (std::size_t i = 0; i < called.size(); ++i) {
        if (called[i] == "-") called[i] = voxel_word(table.entries[i].id);
    }
    return called;
}

template <class Table>
bool has_names(const Table& table, ObjectDirectory& directory) {
    return std::ranges::any_of(table.entries, [&](const auto& entry) { return !directory.name_of(entry).empty(); });
}

template <class Entry>
void add_size_and_place(Json& json, const Entry& entry, const VolumeInfo& info, const std::string& note) {
    json["voxels"] = entry.voxels;
    json["measure"] = entry.measure;
    json["hypervolume"] = entry.hypervolume * info.calibration.slope;
    json["position"] = entry.position;
    json["position_physical"] = to_physical(info.geometry, entry.position);
    json["note"] = note;
}

[[nodiscard]] inline Json border_json(const BorderContact& border) {
    if (!border.is_known()) return nullptr;
    return {{"sides", sides_text(border)}, {"part", border.part}};
}

}  // namespace isoatlas::cli

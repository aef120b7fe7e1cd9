// Members that the tables of objects and cavities have in common. Entry: ObjectEntry, CavityEntry.
#pragma once

#include <fmt/format.h>
#include <isoatlas/isoatlas.h>

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

/// Prints the other recommended isovalues of an entry; nothing if there are none.
inline void tell_isovalues(Terminal& terminal, std::size_t entry, const std::vector<RecommendedIsovalue>& others, const Scale& scale) {
    std::string text;
    for (const RecommendedIsovalue& isovalue : others) {
        const std::string cavity = isovalue.cavity < 0 ? "" : fmt::format(", cavity {}", isovalue.cavity);
        text += fmt::format("{} {} ({}{})", text.empty() ? "" : ",", scale.brief(isovalue.tau), name_of(isovalue.reason), cavity);
    }
    if (!text.empty()) terminal.say(fmt::format("{} also at{}", entry + 1, text));
}

template <class Entry>
void add_size_and_place(Json& json, const Entry& entry, const VolumeInfo& info) {
    json["voxels"] = entry.voxels;
    json["measure"] = entry.measure;
    json["hypervolume"] = entry.hypervolume * info.calibration.slope;
    json["position"] = entry.position;
    json["position_physical"] = to_physical(info.geometry, entry.position);
    json["note"] = entry.note;
}

}  // namespace isoatlas::cli

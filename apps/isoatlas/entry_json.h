// Members that the tables of bright and of dark objects have in common. Entry: ObjectEntry, DarkEntry.
#pragma once

#include <isoatlas/isoatlas.h>

#include "document.h"
#include "values.h"

namespace isoatlas::cli {

template <class Entry>
void add_isovalues(Json& json, const Entry& entry, const Scale& scale) {
    json["appears"] = number(scale.reported(entry.appears));
    json["merges"] = number(scale.reported(entry.merges));
    json["best_tau"] = scale.reported(entry.best_tau);
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

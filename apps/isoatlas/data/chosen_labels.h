// One label volume of chosen objects, each at its own isovalue.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "data/sides.h"

namespace isoatlas::cli {

struct LabelledObject {
    ChosenObject object;
    Segment segment;  ///< number: its label
};

struct ChosenLabels {
    std::vector<std::uint32_t> of_voxel;  ///< 0: none
    std::vector<LabelledObject> objects;  ///< by label; those without a voxel of their own too
};

/// The label of an object is its number, that of a cavity follows the numbers of the table; what has no number, or that of another one,
/// gets the next label that is free. Objects are nested: a voxel has the label of the innermost one, that with the highest isovalue, of
/// objects that are the same the one that comes first. Cavities lie inside objects: the innermost is the one with the lowest isovalue.
/// Objects of low values are nested among themselves, the innermost has the lowest isovalue; where one and an object of high values hold
/// the same voxel, the one with fewer labelled voxels has it. Together with others they get the next free labels. Throws Error{not_found}
/// for an object that does not exist at its isovalue. Cost: a cut for every isovalue; of cavities an analysis of the volume.
[[nodiscard]] ChosenLabels chosen_labels(const Arguments& arguments, Sides& sides, const std::vector<ChosenObject>& objects);

}  // namespace isoatlas::cli

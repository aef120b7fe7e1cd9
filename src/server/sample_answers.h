// Answers about samples: a slice, the volume in fewer values, what holds a voxel.
#pragma once

#include <vector>

#include "isoatlas/atlas.h"
#include "server/request.h"

namespace isoatlas {

/// An entry of the atlas, as it stands in /api/atlas.
struct NamedEntry {
    std::int64_t id;  ///< of the object, or of the contour around the dark object
    double tau;       ///< stored
    std::int64_t voxels;
    bool is_cavity;
};

/// Questions with the words of server/service.h. All throw Error: usage (words), input (damaged store), cancelled. entries: in the order of
/// /api/atlas.
[[nodiscard]] Response slice_answer(const Atlas& atlas, const Request& request, const Context& context);
[[nodiscard]] Response volume_answer(const Atlas& atlas, const Request& request, const Context& context);
[[nodiscard]] Response at_answer(const Atlas& atlas, const std::vector<NamedEntry>& entries, const Request& request,
                                 const Context& context);

}  // namespace isoatlas

// Responses about samples: a slice, the downsampled volume, the objects that contain a voxel.
#pragma once

#include <vector>

#include "isoatlas/atlas.h"
#include "server/object_words.h"
#include "server/request.h"

namespace isoatlas {

/// An entry of the atlas, as in /api/atlas.
struct NamedEntry {
    std::int64_t id;  ///< of the object, or of the contour around the cavity
    double tau;       ///< stored
    std::int64_t voxels;
    bool is_cavity;
    Polarity polarity = Polarity::high;
};

/// Requests of server/service.h. All throw Error: usage (query parameters), input (damaged store), cancelled. entries: in the order of
/// /api/atlas.
[[nodiscard]] Response slice_answer(const Atlas& atlas, const Request& request, const Context& context);
[[nodiscard]] Response volume_answer(const Atlas& atlas, const Request& request, const Context& context);
[[nodiscard]] Response at_answer(const NumberedSides& sides, const std::vector<NamedEntry>& entries, const Request& request,
                                 const Context& context);

}  // namespace isoatlas

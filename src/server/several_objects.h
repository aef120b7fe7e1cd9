// Files of several objects, each at an isovalue of its own: one file of surfaces, or one label volume.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/atlas.h"
#include "isoatlas/object_names.h"
#include "server/object_words.h"
#include "server/request.h"

namespace isoatlas {

struct SeveralObjects {
    NumberedSides sides;
    std::vector<ObjectName> names, low_names;
    std::int64_t max_triangles = 0;  ///< of each surface
};

/// The file that `isoatlas extract --object ... --object ...` writes. Throws Error: usage (query parameters), not_found, resource,
/// cancelled.
[[nodiscard]] Response surfaces_answer(const SeveralObjects& all, const Request& request, const Context& context);
/// The file that `isoatlas label --object ... --object ...` writes, without the table beside it.
[[nodiscard]] Response segmentation_answer(const SeveralObjects& all, const Request& request, const Context& context);

}  // namespace isoatlas

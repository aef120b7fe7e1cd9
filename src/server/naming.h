// Names of objects and cavities, read and changed by a viewer: /api/names, /api/name.
#pragma once

#include <mutex>
#include <vector>

#include "isoatlas/atlas.h"
#include "isoatlas/object_names.h"
#include "server/object_words.h"
#include "server/request.h"

namespace isoatlas {

/// The file beside the store is read for every request: other programs change it too.
class Naming {
public:
    explicit Naming(bool is_read_only) : is_read_only_(is_read_only) {}

    /// docs/schema/server-names. Throws Error{input} for a damaged file.
    [[nodiscard]] Response names(const StoreSides& sides, const Request& request) const;
    /// Gives a name, or takes it away: an empty one. The answer is that of names(). Throws Error: usage, not_found, input, resource.
    [[nodiscard]] Response change(const NumberedSides& sides, const Request& request);
    /// No names of a damaged file.
    [[nodiscard]] static std::vector<ObjectName> usable_names(const Atlas& atlas);

private:
    const bool is_read_only_;
    std::mutex mutex_;  ///< of changes
};

}  // namespace isoatlas

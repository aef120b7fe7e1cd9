// Levels of detail beside the store of a viewer (isoatlas/levels.h).
#pragma once

#include <array>
#include <mutex>
#include <optional>

#include "isoatlas/levels.h"

namespace isoatlas {

struct MeshWanted {
    std::int64_t triangles = 0;          ///< at most
    std::optional<Viewpoint> from = {};  ///< fine where it is near to the eye, a pixel from the exact surface; else equally fine everywhere
};

class StoreLevels {
public:
    /// The level with at most so many triangles, or the coarsest one; nothing: there are no levels of the surface, or it has no more
    /// triangles. Looks for the file once. Throws Error{input} for a damaged file, or one of another store.
    [[nodiscard]] std::optional<SeenSurface> find(const Atlas& atlas, const SurfaceOptions& options, double tau, const MeshWanted& wanted);

private:
    struct Side {
        std::once_flag looked;
        std::optional<Levels> levels;
    };
    std::array<Side, 2> sides_;  ///< by polarity
};

}  // namespace isoatlas

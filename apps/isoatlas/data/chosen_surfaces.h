// The surfaces of chosen objects, each at its own isovalue.
#pragma once

#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

#include "data/sides.h"

namespace isoatlas::cli {

struct ChosenSurface {
    ChosenObject object;
    NamedSurface named;  ///< the name is the title of the object
};

/// options: of all, without objects and contours. notes: receives what is not written twice. Throws Error{not_found} for an object that
/// does not exist at its isovalue.
[[nodiscard]] std::vector<ChosenSurface> chosen_surfaces(Sides& sides, const std::vector<ChosenObject>& objects,
                                                         const SurfaceOptions& options, std::vector<std::string>& notes);

/// "head.glb" for object 2 with the name skull: "head-2-skull.glb"; with an isovalue of its own "head-2-skull-at-1367.glb".
[[nodiscard]] std::string split_name(const std::string& output, const ChosenObject& object);

/// 8 bits a channel.
[[nodiscard]] std::array<std::uint8_t, 3> bytes_of(const Colour& colour);

}  // namespace isoatlas::cli

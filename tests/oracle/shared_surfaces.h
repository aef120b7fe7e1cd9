// Eleven surfaces of real volumes, where the shared data lies beside the checkout.
#pragma once

#include <array>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "isoatlas/volume.h"

namespace oracle {

struct SharedSurface {
    const char* volume;
    double tau;
    bool is_small;  ///< some ten thousand triangles
};

inline constexpr std::array<SharedSurface, 11> kSharedSurfaces{{{"fuel", 50, true},
                                                                {"neghip", 60, true},
                                                                {"neghip", 120, true},
                                                                {"headsq", 500, false},
                                                                {"headsq", 1200, false},
                                                                {"tooth", 500, false},
                                                                {"tooth", 1000, false},
                                                                {"engine", 80, false},
                                                                {"engine", 150, false},
                                                                {"bonsai", 40, false},
                                                                {"bonsai", 120, false}}};

/// Calls use(surface, volume, how many variants to check): `few` of the small surfaces, or `many` of all with ISOATLAS_ALL_DATA=1, of one
/// volume with its name for 1. False: there is no shared data.
template <class Use>
bool for_shared_surfaces(int few, int many, const Use& use) {
    const std::filesystem::path data = std::filesystem::path(ISOATLAS_SOURCE_DIR).parent_path() / "shared" / "data";
    if (!std::filesystem::is_directory(data)) return false;
    const char* chosen = std::getenv("ISOATLAS_ALL_DATA");
    const std::string wanted = chosen == nullptr ? "" : chosen;
    bool is_found = false;
    for (const SharedSurface& surface : kSharedSurfaces) {
        const std::string name = surface.volume;
        if (wanted.empty() ? !surface.is_small : wanted != "1" && wanted != name) continue;
        is_found = true;
        const auto reader = isoatlas::open_volume((data / name / (name + ".nrrd")).string(), {});
        use(surface, load_volume(*reader), wanted.empty() ? few : many);
    }
    if (!is_found) throw std::runtime_error("ISOATLAS_ALL_DATA is neither 1 nor one of the volumes: " + wanted);
    return true;
}

}  // namespace oracle

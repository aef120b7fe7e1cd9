// Shell: the side of its object that a contour lies on.
#pragma once

#include <cstdint>

namespace isoatlas {

enum class Shell : std::uint8_t {
    outer,  ///< towards the outside
    inner,  ///< the wall of a cavity
};

}  // namespace isoatlas

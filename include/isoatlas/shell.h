// Shell: on which side of its object does a contour lie?
#pragma once

#include <cstdint>

namespace isoatlas {

enum class Shell : std::uint8_t {
    outer,  ///< towards the outside
    inner,  ///< the wall of a cavity
};

}  // namespace isoatlas

// A turntable of an object, as one picture.
#pragma once

#include <string>

#include "isoatlas/page.h"
#include "isoatlas/render.h"

namespace isoatlas {

struct Turntable {
    std::string image;  ///< a data: URI of a WebP picture, frames from left to right; empty: nothing to draw
    std::int64_t frames = 0, side = 0;
};

/// The first frame is the best view; the others rotate around the up axis.
[[nodiscard]] Turntable draw_turntable(Surface surface, const Colour& colour, const PageOptions& options, const Context& context);

/// A 2D volume in grey with its contours at an isovalue: one frame.
[[nodiscard]] Turntable draw_still(const Volume& volume, double tau, const Colour& colour, const PageOptions& options,
                                   const Context& context);

}  // namespace isoatlas

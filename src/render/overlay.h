// Overlays of a picture: the scale bar and the legend.
#pragma once

#include "isoatlas/render.h"

namespace isoatlas {

void draw_overlay(const Scene& scene, const Camera& camera, const RenderOptions& options, Image& image);

}  // namespace isoatlas

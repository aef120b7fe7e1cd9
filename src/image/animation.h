// Shared by the writers of animations.
#pragma once

#include "isoatlas/image.h"

namespace isoatlas {

/// Throws Error{usage} for no frames, frames of different sizes, sides above `max`, or frames per second outside of 0.1 .. 100.
void check_animation(const Animation& animation, std::int64_t max);

}  // namespace isoatlas

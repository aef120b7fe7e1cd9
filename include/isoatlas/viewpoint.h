// From where a surface is seen: how fine it must be there.
#pragma once

#include <numbers>
#include <optional>

#include "isoatlas/vec3.h"

namespace isoatlas {

/// Of a picture from top to bottom, in radians, where nobody chooses another: 30 degrees.
inline constexpr double kFieldOfView = std::numbers::pi / 6;

/// The cone around a picture, its tip in the eye.
struct ViewCone {
    Vec3 direction{};       ///< of any length above 0
    double half_angle = 0;  ///< radians, above 0 and below pi/2
};

struct Viewpoint {
    Vec3 eye{};                         ///< physical
    double pixel = 0;                   ///< how wide a pixel is at a physical distance of 1 from the eye, physical; above 0
    double near = 0;                    ///< what is nearer to the eye than this counts as being there, physical; above 0
    std::optional<ViewCone> cone = {};  ///< what is seen; without one: all around
};

/// Of an eye before a picture of 1080 lines that is kFieldOfView high. near: as in Viewpoint, such as the shortest step of a grid.
[[nodiscard]] Viewpoint viewpoint_of_picture(const Vec3& eye, double near);

/// Throws Error{usage} where a number is not what Viewpoint and ViewCone say, or a place is not finite.
void require_viewpoint(const Viewpoint& from);

}  // namespace isoatlas

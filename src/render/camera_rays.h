// From pixels to rays and back.
#pragma once

#include "isoatlas/render.h"
#include "render/vectors.h"

namespace isoatlas {

/// The point at t is origin + t * direction; direction has length 1.
struct Ray {
    Vec3 origin, direction;
};

/// A camera with its axes: right, up, toward the eye; perpendicular unit vectors.
class CameraRays {
public:
    CameraRays(const Camera& camera, std::int64_t width, std::int64_t height);

    /// Through a point of the picture, in pixels from its upper left corner. Orthographic rays begin `behind` before the target's plane.
    [[nodiscard]] Ray through(double x, double y, double behind) const;
    /// Pixel position and distance in front of the target's plane.
    [[nodiscard]] Vec3 project(const Vec3& point) const;
    /// Of an eye in perspective; infinite for parallel rays. What is not nearer than this to the target's plane is behind the eye.
    [[nodiscard]] double eye_depth() const;
    [[nodiscard]] std::int64_t width() const { return static_cast<std::int64_t>(width_); }    ///< of the picture, in pixels
    [[nodiscard]] std::int64_t height() const { return static_cast<std::int64_t>(height_); }  ///< of the picture, in pixels
    [[nodiscard]] double pixel_size() const { return pixel_; }                                ///< physical, in the target's plane

    Vec3 right, up, toward;

private:
    Camera camera_;
    double width_, height_, pixel_;
};

}  // namespace isoatlas

// SeenLengths: how many pixels lengths are, seen from a viewpoint.
#pragma once

#include <optional>

#include "isoatlas/viewpoint.h"

namespace isoatlas {

class SeenLengths {
public:
    /// Throws Error{usage} as require_viewpoint().
    explicit SeenLengths(const Viewpoint& from);

    /// How many pixels a length is at most within a ball; a sixteenth of that where the ball is outside the view. All physical.
    [[nodiscard]] double pixels(double length, const Vec3& centre, double radius) const;

private:
    /// Notation: a point is h along the axis of the cone and r beside it.
    struct Cone {
        Vec3 axis;
        double sine, cosine;  ///< of its half angle
    };
    [[nodiscard]] bool may_see(const Vec3& away, double radius) const;

    Viewpoint from_;
    std::optional<Cone> cone_;
};

}  // namespace isoatlas

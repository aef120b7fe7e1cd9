// Rays inside a solid: where they leave it.
#pragma once

#include <memory>
#include <optional>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

class SolidRays {
public:
    /// surface: closed, counter-clockwise seen from outside, of fewer than 2^32 points; must live as long as this. Throws Error{resource}.
    SolidRays(const Surface& surface, const Context& context);
    ~SolidRays();
    SolidRays(const SolidRays&) = delete;
    SolidRays& operator=(const SolidRays&) = delete;

    struct Exit {
        double length;  ///< of the way there
        double facing;  ///< cosine of the angle between the direction and the outward normal of the triangle
    };
    /// From a point of the surface along a unit direction to the first triangle that faces away and does not meet at that point.
    [[nodiscard]] std::optional<Exit> way_out(std::size_t point, const Vec3& direction) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas

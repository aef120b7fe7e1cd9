// Ray tracing of surfaces: Coordinates are those of the frame: the scene in the unit ball.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "isoatlas/render.h"
#include "render/camera_rays.h"
#include "render/scene_box.h"

namespace isoatlas {

/// Maps physical coordinates to a frame in which the scene fills the unit ball, where floats are accurate enough for any volume.
struct Frame {
    Vec3 centre{};
    double radius = 1;

    [[nodiscard]] Vec3 inside(const Vec3& p) const { return scale(minus(p, centre), 1 / radius); }
    [[nodiscard]] Vec3 outside(const Vec3& p) const { return along(centre, radius, p); }
};

/// A crossing of a ray and a surface.
struct Crossing {
    double t;
    std::int64_t object;  ///< position in Scene::objects
    Vec3 normal;          ///< smooth, unit, towards lower values
    Vec3 face_normal;     ///< of the triangle, unit
    [[nodiscard]] bool enters(const Ray& ray) const { return dot(face_normal, ray.direction) < 0; }
};

/// Clipped interval of a ray: t in (begin, end).
struct Gap {
    double begin = 0, end = -1;
    [[nodiscard]] bool holds(double t) const { return begin < t && t < end; }
    [[nodiscard]] bool empty() const { return !(begin < end); }
};

/// Part of a ray in all of the half-spaces (given in the frame); nullopt: none.
Gap gap_of(const std::vector<HalfSpace>& removed, const Ray& ray);

class RaySurfaces {
public:
    enum class Which : std::uint8_t { opaque, transparent };

    /// The scene must live as long as this. removed: in the frame. Throws Error: usage (2D), unsupported (more than 2^32 points).
    RaySurfaces(const Scene& scene, Which which, const Frame& frame, const std::vector<HalfSpace>& removed, int threads);
    ~RaySurfaces();
    RaySurfaces(const RaySurfaces&) = delete;
    RaySurfaces& operator=(const RaySurfaces&) = delete;

    [[nodiscard]] bool empty() const;
    /// The first crossing; where objects touch (the caps at the border of a volume), that of the one with the highest isovalue.
    [[nodiscard]] std::optional<Crossing> first(const Ray& ray) const;
    /// All crossings up to `max`, by t; at the same t lower isovalues first. Replaces the contents of `crossings`.
    void all(const Ray& ray, double max, std::vector<Crossing>& crossings) const;
    /// Is the ray occluded between t = min and max, outside the clipped part?
    [[nodiscard]] bool blocked(const Ray& ray, double min, double max) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace isoatlas

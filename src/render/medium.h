// Volume rendering of a participating medium: emission and absorption, composited front to back (Max, 1995).
#pragma once

#include <functional>

#include "isoatlas/render.h"
#include "render/camera_rays.h"
#include "render/empty_space.h"
#include "render/footprint.h"
#include "render/gradient_grid.h"
#include "render/lights.h"
#include "render/ray_surfaces.h"
#include "render/shadow_grid.h"
#include "render/transfer.h"
#include "render/trilinear.h"

namespace isoatlas {

/// Accumulated light along a ray.
struct Gathered {
    Vec3 light{};
    double opacity = 0;
};

/// A segment of a ray with matter in it.
struct MatterSegment {
    double begin, end;  ///< t
    OpticalProperties matter;
};

class Medium {
public:
    /// The scene must live as long as this. lights: null: the medium is unlit. solid: surfaces that cast shadows on the medium.
    /// Throws Error{unsupported} for a rectilinear grid, and for more than 2^24 samples along an axis.
    Medium(const Scene& scene, const Frame& frame, const Lights* lights, const RaySurfaces& solid, int threads);

    /// Adds the medium between t = begin and end of a ray of the frame, `shift` in [0, 1): offset of the segments within a step.
    void march(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const;
    /// Calls visit(segment) for every segment with matter between t = begin and end, front to back, until it returns false.
    void visit_matter(const Ray& ray, double begin, double end, double shift, const std::function<bool(const MatterSegment&)>& visit) const;
    /// Pixels with matter somewhere along their rays, and some around them.
    [[nodiscard]] Footprint footprint(const CameraRays& camera) const;
    [[nodiscard]] double step() const { return step_; }  ///< length of a segment, in the frame
    /// Visibility of the key light from a point of the frame; 1 without shadows.
    [[nodiscard]] double lit(const Vec3& point) const { return shadow_.light(voxel_of(point)); }

private:
    /// A ray in samples, and where it is inside of the volume.
    struct Passage {
        Vec3 origin, way;
        double begin, end;
    };
    Medium(const Scene& scene, const Frame& frame, const Lights* lights, const BlockRanges& blocks, const RaySurfaces& solid, int threads);
    [[nodiscard]] Vec3 voxel_of(const Vec3& point) const;       ///< sample position of a point of the frame
    [[nodiscard]] Vec3 voxel_direction(const Vec3& way) const;  ///< the same for a difference
    void go(const Ray& ray, double begin, double end, double shift, const Lights* lights, Gathered& gathered) const;
    template <class T>
    void go_through(const Ray& ray, double begin, double end, double shift, const Lights* lights, Gathered& gathered) const;
    /// Calls take(ends of segments) until it returns false.
    template <class T, class Take>
    void walk(const Trilinear<T>& values, const Passage& passage, double shift, const Take& take) const;
    [[nodiscard]] Passage passage_of(const Ray& ray, double begin, double end) const;
    [[nodiscard]] ShadowGrid shadows(const RaySurfaces& solid, int threads) const;

    const Volume* volume_;
    const Lights* lights_;
    Frame frame_;
    Transfer transfer_;
    EmptySpaceGrid blocks_;
    Mat3 to_voxel_{};  ///< rows: physical difference to sample difference
    double step_ = 1;  ///< in the frame
    ShadowGrid shadow_;
    GradientGrid gradients_;  ///< none: differences of samples
};

}  // namespace isoatlas

// A volume as glowing matter that rays go through: emission and absorption, composited front to back (Max, 1995).
#pragma once

#include <memory>
#include <vector>

#include "isoatlas/render.h"
#include "render/camera_rays.h"
#include "render/lights.h"
#include "render/ray_surfaces.h"
#include "render/transfer.h"

namespace isoatlas::render {

/// Light that has come together so far along a ray.
struct Gathered {
    Vec3 light{};
    double opacity = 0;
};

class Medium {
public:
    /// The scene must live as long as this. lights: null, then matter has its own colour. solid: what throws shadows on matter.
    /// Throws Error{unsupported} for a rectilinear grid.
    Medium(const Scene& scene, const Frame& frame, const Lights* lights, const RaySurfaces& solid, int threads);

    /// Adds the matter between t = begin and end of a ray of the frame, `shift` in [0, 1): where in a step the first one ends.
    void march(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const;
    /// How much of the key light reaches a point of the frame; 1 without shadows.
    [[nodiscard]] double lit(const Vec3& point) const;

private:
    /// The block at a place: is anything in it visible, and how far does a ray go on in it?
    struct BlockAhead {
        bool visible;
        double length;
    };
    struct Blocks {
        std::array<std::int64_t, 3> count{};
        std::vector<std::uint8_t> visible;
    };
    [[nodiscard]] Vec3 voxel_of(const Vec3& point) const;       ///< sample position of a point of the frame
    [[nodiscard]] Vec3 voxel_direction(const Vec3& way) const;  ///< the same of a difference
    [[nodiscard]] double value_at(const Vec3& voxel) const { return value_at_(*volume_, voxel); }
    [[nodiscard]] Vec3 slope_at(const Vec3& voxel) const;  ///< towards lower values, in the frame, unit length or zero
    [[nodiscard]] Vec3 shaded(const Matter& matter, const Vec3& voxel, const Ray& ray) const;
    [[nodiscard]] BlockAhead block_ahead(const Vec3& voxel, const Vec3& way) const;
    void find_visible_blocks(int threads);
    void find_shadows(const RaySurfaces& solid, int threads);

    const Volume* volume_;
    const Lights* lights_;
    Frame frame_;
    Transfer transfer_;
    double (*value_at_)(const Volume&, const Vec3&);
    Mat3 to_voxel_{};  ///< rows: physical difference to sample difference
    double step_ = 1;  ///< in the frame
    Blocks blocks_;
    std::array<std::int64_t, 3> shadow_count_{};
    std::vector<float> shadow_;  ///< part of the key light, on a coarse grid; empty: no shadows
};

}  // namespace isoatlas::render

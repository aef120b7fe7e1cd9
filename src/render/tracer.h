// Traces one camera ray through everything along it, front to back.
#pragma once

#include <cstdint>
#include <vector>

#include "isoatlas/render.h"
#include "render/layers.h"
#include "render/lights.h"
#include "render/medium.h"
#include "render/optics.h"
#include "render/ray_surfaces.h"

namespace isoatlas {

/// Light along a ray, in parts (see Shade), and the hit surface. Colours are premultiplied.
struct Seen {
    Vec3 glow{};               ///< light without shadows
    Shade shade{};             ///< of the opaque surface
    double opacity = 0;        ///< of everything together
    std::int64_t object = -1;  ///< of the opaque surface; -1: none
    double depth = 0;          ///< t of the opaque surface
    Vec3 normal{};
    double open_sky = 1, open_key = 1;  ///< visibility of the lights
};

/// Scratch memory.
struct Workspace {
    std::vector<Crossing> crossings;
    std::vector<Layer> layers;
};

class Tracer {
public:
    /// The scene must live as long as this.
    Tracer(const Scene& scene, const Frame& frame, const CameraRays& camera, bool shading, int threads);

    /// ray: in the frame. seed and sample: which random numbers.
    [[nodiscard]] Seen trace(const Ray& ray, std::uint32_t seed, std::uint32_t sample, Workspace& work) const;

    /// False: rays through the pixel meet nothing.
    [[nodiscard]] bool shows(std::int64_t x, std::int64_t y) const { return !footprint_ || footprint_->shows(x, y); }

private:
    void add_sheets(const Ray& ray, double max, const Gap& gap, Workspace& work) const;
    void gather(const Ray& ray, double max, const Gap& gap, const RayNumbers& numbers, const std::vector<Layer>& layers, Seen& seen) const;
    void march(const Ray& ray, double begin, double end, const Gap& gap, const RayNumbers& numbers, Gathered& gathered) const;
    [[nodiscard]] std::optional<Crossing> first_opaque(const Ray& ray, const Gap& gap, std::vector<Crossing>& crossings) const;
    void add_opaque(const Ray& ray, const Crossing& crossing, Seen& seen) const;
    void look_around(const Ray& ray, const Crossing& crossing, std::uint32_t seed, std::uint32_t sample, Seen& seen) const;
    [[nodiscard]] std::optional<Crossing> cut_face(const Ray& ray, const Gap& gap, const std::vector<Crossing>& crossings) const;

    const Scene& scene_;
    bool shading_;
    std::vector<HalfSpace> removed_;  ///< in the frame
    RaySurfaces opaque_, transparent_;
    RaySlices slices_;
    Lights lights_;
    std::optional<Medium> medium_;
    std::optional<Footprint> footprint_;  ///< of the medium, if there is nothing else
    std::optional<Optics> optics_;        ///< none: the default model, which is that of the medium
    std::vector<Vec3> albedo_;            ///< of every object
    double lift_;                         ///< offset of rays to lights above a surface
};

}  // namespace isoatlas

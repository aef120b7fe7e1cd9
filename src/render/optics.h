// Optical models of volume rendering other than the shaded default one: absorption, emission, single and multiple scattering (Max, 1995).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "isoatlas/render.h"
#include "render/medium.h"
#include "render/ray_surfaces.h"

namespace isoatlas {

/// Which of the numbers of samples.h a ray has.
struct RayNumbers {
    double shift = 0;        ///< of the segments of the ray within a step, [0, 1)
    std::uint32_t seed = 0;  ///< of its paths
};

class Optics {
public:
    /// All must live as long as this. to_key: direction to the lamp where the scene has none. solid: surfaces that cast shadows. removed:
    /// in the frame; what is there takes no light.
    Optics(const SceneVolume& volume, const Medium& medium, const Vec3& to_key, const RaySurfaces& solid,
           const std::vector<HalfSpace>& removed);

    /// Adds the medium between t = begin and end of a ray of the frame.
    void march(const Ray& ray, double begin, double end, const RayNumbers& numbers, Gathered& gathered) const;
    /// What comes from the lamp to a point and is scattered into a direction there, for albedo 1 and white matter.
    [[nodiscard]] double lamplight(const Vec3& point, const Vec3& direction) const;

private:
    /// Where light is scattered: the matter's colour there, and how much of the ray's light was taken so far.
    struct Event {
        Vec3 point{}, colour{};
        double weight = 0;
    };
    struct Flight;
    using Visit = std::function<bool(const MatterSegment&)>;
    void visit(const Ray& ray, double begin, double end, double shift, const Visit& visit) const;
    void absorb(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const;
    void emit(const Ray& ray, double begin, double end, double shift, Gathered& gathered) const;
    [[nodiscard]] Event scatter_once(const Ray& ray, double begin, double end, const RayNumbers& numbers, Gathered& gathered) const;
    [[nodiscard]] Vec3 scatter_on(const Event& first, const Vec3& direction, std::uint32_t seed) const;
    [[nodiscard]] Flight fly(const Ray& ray, double u, double shift) const;

    OpticalModel model_;
    Scattering scattering_;
    const Medium& medium_;
    const RaySurfaces& solid_;
    const std::vector<HalfSpace>& removed_;
    Vec3 to_light_;
};

/// Phase function of Henyey and Greenstein (1941) times 4 pi: its mean over all directions is 1. cosine: of the angle by which light turns.
[[nodiscard]] double phase_of(double asymmetry, double cosine);
/// A cosine that has this distribution, for u in [0, 1).
[[nodiscard]] double phase_cosine(double asymmetry, double u);

}  // namespace isoatlas

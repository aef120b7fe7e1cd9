// Methods that make the surface of an isovalue, each as its paper describes it, with its defects.
//
// Surfaces are open where they leave the volume: the methods know nothing outside of it. A sample is High when its value is at least tau.
// In the literature: chapter 3 of the dissertation, a survey of most of these; docs/methods.md.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "isoatlas/context.h"
#include "isoatlas/method_info.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

enum class SurfaceMethod : std::uint8_t {
    connected_contours,
    marching_cubes,
    asymptotic_decider,
    marching_cubes_33,
    dividing_cubes,  ///< makes points
    five_tetrahedra,
    six_tetrahedra,
    spider_web,
    trilinear
};

using SurfaceMethodInfo = MethodInfo<SurfaceMethod>;
/// In the order of the dissertation; the last two are the product.
[[nodiscard]] std::span<const SurfaceMethodInfo> surface_methods();
[[nodiscard]] const SurfaceMethodInfo& info_of(SurfaceMethod method);
/// Does it make points instead of triangles?
[[nodiscard]] constexpr bool makes_points(SurfaceMethod method) { return method == SurfaceMethod::dividing_cubes; }

/// A surface as points with normals, which point to lower values.
struct PointCloud {
    Array<Vec3> points;                   ///< physical
    Array<std::array<float, 3>> normals;  ///< unit length
};

/// What an extraction has looked at. Cells as in cell_search.h; of connected contours: squares of slices.
struct ExtractionCost {
    std::int64_t active = 0;
    std::int64_t cells = 0;  ///< looked at
    std::int64_t bytes = 0;  ///< held at most, beside the samples and the result: counted from sizes of containers
};

/// Of a method that makes points the surface is empty, of the others the cloud is.
struct Extraction {
    Surface surface;  ///< physical coordinates, without normals and ids
    PointCloud points;
    ExtractionCost cost;
};

inline constexpr int kMaxDivisions = 64;
struct ExtractorOptions {
    int divisions = 2;  ///< Dividing Cubes: small cubes along each axis of a cell, 1 to kMaxDivisions
};

/// A method on the samples of one volume.
class Extractor {
public:
    Extractor() = default;
    Extractor(const Extractor&) = delete;
    Extractor& operator=(const Extractor&) = delete;
    virtual ~Extractor() = default;

    /// tau: a stored value. Throws Error: usage (not a finite number), cancelled. Cost: O(cells + result); the comparators use one thread.
    /// Dividing Cubes: O(cells + active cells * divisions^3).
    [[nodiscard]] virtual Extraction extract(double tau, const Context& context = {}) const = 0;
};

/// The samples are borrowed: the volume must live as long as the result. Throws Error{usage}: a 2D volume, divisions out of range.
[[nodiscard]] std::unique_ptr<Extractor> make_extractor(SurfaceMethod method, const Volume& volume, const ExtractorOptions& options = {});

}  // namespace isoatlas

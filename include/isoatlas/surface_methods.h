// Methods that make the surface of an isovalue, each as its paper describes it, with its defects.
//
// Surfaces are open where they leave the volume: the methods know nothing outside of it. A sample is High when its value is at least tau.
// In the literature: chapter 3 of the dissertation, a survey of all of these; docs/methods.md.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "isoatlas/context.h"
#include "isoatlas/surface.h"
#include "isoatlas/volume.h"

namespace isoatlas {

enum class SurfaceMethod : std::uint8_t {
    connected_contours,
    marching_cubes,
    asymptotic_decider,
    five_tetrahedra,
    six_tetrahedra,
    spider_web,
    trilinear
};

struct SurfaceMethodInfo {
    SurfaceMethod method;
    std::string_view name;     ///< "six-tetrahedra"
    std::string_view title;    ///< "Six tetrahedra a cell"
    std::string_view section;  ///< of the dissertation; empty: none
    std::string_view source;   ///< authors, title, year
};
/// In the order of the dissertation; the last two are the product.
[[nodiscard]] std::span<const SurfaceMethodInfo> surface_methods();
[[nodiscard]] const SurfaceMethodInfo& info_of(SurfaceMethod method);

/// Points in physical coordinates, without normals and ids. Throws Error: usage (tau is not a finite number; a 2D volume), cancelled. Cost:
/// O(cells); the comparators use one thread.
[[nodiscard]] Surface extract_by(SurfaceMethod method, const Volume& volume, double tau, const Context& context = {});

/// Edges with one triangle that do not lie in an end of the volume: the rims of holes. inspect() (isoatlas/surface.h) tells the rest. info:
/// of the volume that the surface was made from. Cost: a sort of the edges.
[[nodiscard]] std::int64_t count_hole_edges(const Surface& surface, const VolumeInfo& info);

/// A surface as points with normals, which point to lower values.
struct PointCloud {
    Array<Vec3> points;                   ///< physical
    Array<std::array<float, 3>> normals;  ///< unit length
};

inline constexpr int kMaxDivisions = 64;
/// Dividing Cubes (section 3.3): the small cubes with Highs and Lows, `divisions` of them along each axis of a cell (1 to kMaxDivisions).
/// Errors: as extract_by(). Cost: O(cells + active cells * divisions^3).
[[nodiscard]] PointCloud divide_cubes(const Volume& volume, double tau, int divisions, const Context& context = {});

}  // namespace isoatlas

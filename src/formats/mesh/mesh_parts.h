// What the mesh formats write: one surface, or several with names and colours, seen in the space of the file.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/srgb.h"
#include "formats/common/connectivity.h"
#include "formats/common/precision.h"
#include "isoatlas/surface.h"

namespace isoatlas {

/// A surface in another anatomical space: signs of coordinates, nothing is copied. Where the spaces are mirror images, triangles and
/// segments are reversed: triangles are counter-clockwise seen from the Low side in either.
class TurnedSurface {
public:
    /// `space`: of three letters when that of the surface is LPS, RAS or LAS; else that of the surface.
    TurnedSurface(const Surface& surface, const std::string& space);

    [[nodiscard]] const Surface& surface() const { return *surface_; }
    [[nodiscard]] std::array<double, 3> point(std::size_t i) const { return turned(surface_->points[i]); }
    [[nodiscard]] std::array<float, 3> normal(std::size_t i) const { return turned(surface_->normals[i]); }
    [[nodiscard]] std::array<std::int64_t, 3> triangle(std::size_t i) const {
        const auto& t = surface_->triangles[i];
        return is_mirrored_ ? std::array<std::int64_t, 3>{t[0], t[2], t[1]} : t;
    }
    [[nodiscard]] std::array<std::int64_t, 2> segment(std::size_t i) const {
        const auto& s = surface_->segments[i];
        return is_mirrored_ ? std::array<std::int64_t, 2>{s[1], s[0]} : s;
    }

private:
    template <class T>
    [[nodiscard]] std::array<T, 3> turned(const std::array<T, 3>& p) const {
        const auto turn = [&](std::size_t a) { return flips_[a] ? T{0} - p[a] : p[a]; };  // 0 - x keeps zeros positive
        return {turn(0), turn(1), turn(2)};
    }

    const Surface* surface_;
    std::array<bool, 3> flips_{};
    bool is_mirrored_ = false;
};

struct MeshPart {
    TurnedSurface turned;
    std::string name;
    SrgbBytes colour{};
    std::int64_t first_point = 0;                  ///< in a file with one list of points
    std::span<const SimplifiedSurface> coarser{};  ///< for .glb
    [[nodiscard]] const Surface& surface() const { return turned.surface(); }
};

/// At least one part. The surfaces must outlive it.
struct MeshParts {
    std::vector<MeshPart> parts;
    bool named = false;  ///< several surfaces with names and colours; else one without
    std::string space;   ///< of the points in the file
    std::string unit;
    std::int64_t points = 0, triangles = 0, segments = 0;
    bool has_normals = false, has_object = false, has_contour = false;  ///< in all parts

    [[nodiscard]] bool has_coarser() const {
        return std::ranges::any_of(parts, [](const MeshPart& part) { return !part.coarser.empty(); });
    }
    [[nodiscard]] bool is_curves() const { return segments > 0; }
    [[nodiscard]] bool says_space() const { return space == "LPS" || space == "RAS"; }  ///< in the words of 3D Slicer
};
/// Throws Error{usage} for arrays of different length, indices out of range, curves beside triangles, different spaces or units.
[[nodiscard]] MeshParts mesh_parts(const Surface& surface, const SurfaceFileOptions& options, const std::string& file,
                                   std::span<const SimplifiedSurface> coarser = {});
[[nodiscard]] MeshParts mesh_parts(std::span<const NamedSurface> surfaces, const SurfaceFileOptions& options, const std::string& file);

/// Of all parts; of low values when all of them are.
[[nodiscard]] Connectivity connectivity_of(const MeshParts& parts);

/// Of the points in a file.
[[nodiscard]] std::string turned_space(const std::string& space, PointSpace wanted);

/// That the positions of all parts need.
[[nodiscard]] Real position_precision(const MeshParts& parts);

/// Provenance, a line each: generator, tau, space, unit, interpolant, tunnel height; of named parts number, tau, colour and name.
[[nodiscard]] std::string comment_lines(const MeshParts& parts, const std::string& comment_mark);

}  // namespace isoatlas

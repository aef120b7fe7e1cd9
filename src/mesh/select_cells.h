// Object and contour of every point, and selection of contours.
// In the literature: flexible isosurfaces, single contours by their arc (Carr, Snoeyink, Path seeds and flexible isosurfaces, 2003).
#pragma once

#include <optional>

#include "isoatlas/surface.h"
#include "levelset/components.h"
#include "mesh/hits.h"
#include "mesh/layout.h"

namespace isoatlas {

/// Writes the contour number (of Components) of the hits of row (y, z) to Surface::contour.
void write_contours(const Components& components, const MeshDomain& domain, std::int64_t y, std::int64_t z, const RowOffsets& place,
                    Surface& surface);
/// The same for the hits of a line.
void write_contours(const Components& components, const HighBits& high, const HitLine& line, Surface& surface);

/// The contours that the options select, as flags; empty: all of them.
/// Throws Error: usage (not a voxel), not_found (a Low voxel, no such contour at tau).
[[nodiscard]] IdArray<ContourNumber, std::uint8_t> chosen_contours(const TauLevel& level, const Components& components,
                                                                   const SurfaceOptions& options);

/// What a surface is cut out of.
struct ChosenComponents {
    std::optional<Components> all{};                  ///< none: points need not know their component
    IdArray<ContourNumber, std::uint8_t> contours{};  ///< those that are chosen; empty: all

    [[nodiscard]] const Components* get() const { return all ? &*all : nullptr; }
};
[[nodiscard]] ChosenComponents choose_components(const TauLevel& level, const ExtractOptions& options, const Context& context);

/// Replaces contour numbers by ids as in Cut: fills Surface::object and Surface::contour.
void write_ids(const Components& components, const Context& context, Surface& surface);

}  // namespace isoatlas

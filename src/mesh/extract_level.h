// extract() of classified samples.
// In the literature: isosurface extraction (Lorensen, Cline, Marching Cubes, 1987).
#pragma once

#include <cstdint>
#include <functional>

#include "isoatlas/surface.h"
#include "levelset/tau_level.h"

namespace isoatlas {

struct ChosenComponents;

/// Is the orientation of triangles (segments) opposite to that in voxel coordinates? A 2D image is seen from +z where it can be.
[[nodiscard]] bool is_mirrored(const VolumeInfo& info);

/// Do these options select components?
[[nodiscard]] bool selects_components(const SurfaceOptions& options);
[[nodiscard]] inline bool needs_representatives(const SurfaceOptions& options) { return options.ids || selects_components(options); }

/// Throws Error{resource} where a surface has more triangles (segments) than SurfaceOptions::max_triangles. about: "at least ", where they
/// are not all counted.
void require_triangles(std::int64_t triangles, const SurfaceOptions& options, const char* about = "");

/// What a surface says of itself, apart from points and triangles.
void describe(Surface& surface, const VolumeInfo& info, double tau, Interpolant interpolant, double tunnel_height);

[[nodiscard]] Surface extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context);
/// Into an existing surface, whose memory is used again. cells: receives the number of active cells, unless it is null.
void extract_level(const TauLevel& level, const ExtractOptions& options, const Context& context, Surface& surface,
                   std::int64_t* cells = nullptr);
/// What is made of a surface. hits: its points on edges of the grid alone.
enum class ExtractionParts : std::uint8_t { none, hits, all };
/// Asked when the triangles (segments) of all components are counted, before memory is taken for them.
using PartsWanted = std::function<ExtractionParts(std::int64_t triangles)>;
/// The parts that are wanted, of choose_components(level, options, context) (mesh/select_cells.h). Returns which are made: hits are those
/// of all components, with contour numbers where these are known (of Components), and there are no ids.
ExtractionParts extract_parts(const PartsWanted& wanted, const TauLevel& level, const ExtractOptions& options,
                              const ChosenComponents& components, const Context& context, Surface& surface, std::int64_t* cells);
/// All active cells. Cost: O(voxels / 64).
[[nodiscard]] std::int64_t count_cells(const TauLevel& level, Boundary boundary, const Context& context);

}  // namespace isoatlas

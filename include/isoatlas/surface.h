// Surface: the isosurface of a volume at tau as a closed, oriented, embedded 2-manifold (Spider Web), whole or per object or contour.
//
// Points are in physical coordinates (see Geometry). Triangles are counter-clockwise seen from the Low side: normals point to lower values.
// 2D volumes give closed curves: `segments` instead of `triangles`, the High side on the left.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isoatlas/array.h"
#include "isoatlas/cut.h"
#include "isoatlas/polarity.h"
#include "isoatlas/volume.h"

namespace isoatlas {

class Sink;

struct Surface {
    Array<std::array<double, 3>> points;
    Array<std::array<float, 3>> normals;  ///< unit length, per point; empty when not requested
    Array<std::array<std::int64_t, 3>> triangles;
    Array<std::array<std::int64_t, 2>> segments;  ///< 2D only
    Array<std::int64_t> object;                   ///< per point, id as in Cut; empty when not requested
    Array<std::int64_t> contour;                  ///< per point, id as in Cut; empty when not requested
    double tau = 0;                               ///< stored value
    double reported_tau = 0;                      ///< calibrated value
    std::string space = "unknown";                ///< of the points
    std::string unit;
    bool closed = true;                                ///< false: open at the border of the volume (Boundary::open)
    Interpolant interpolant = Interpolant::trilinear;  ///< that extract() used; write_surface() records it in the file
    double tunnel_height = 0;                          ///< of ExtractOptions: difference of stored values; trilinear only
    double reported_tunnel_height = 0;                 ///< calibrated
    Polarity polarity = Polarity::high;                ///< low: of objects of low values; the normals point to higher ones
};

/// closed: samples outside the volume are -infinity, caps close every surface. open: the caps are left off.
enum class Boundary : std::uint8_t { closed, open };
/// full: an articulation point for every hit set, as in the dissertation. compact: fewer triangles, the same topology.
enum class SurfaceStyle : std::uint8_t { compact, full };
enum class ShellChoice : std::uint8_t { all, outer, inner };

/// What to extract and how it is triangulated.
struct SurfaceOptions {
    Boundary boundary = Boundary::closed;
    SurfaceStyle style = SurfaceStyle::compact;
    std::vector<std::int64_t> objects;   ///< voxel indices: the objects at tau that contain them; empty: all
    std::vector<std::int64_t> contours;  ///< contour ids as in Cut; empty: all
    ShellChoice shell = ShellChoice::all;
    bool normals = true;
    bool ids = true;                 ///< fill Surface::object and Surface::contour
    std::int64_t max_triangles = 0;  ///< more (2D: segments) are refused before memory is taken for them; 0: any number
};

/// Of a volume: a store has the interpolant that it was built with, and takes SurfaceOptions.
struct ExtractOptions {
    Interpolant interpolant = Interpolant::trilinear;
    double tunnel_height = 0;  ///< trilinear: tunnels of at most this height (difference of stored values) are left out
    SurfaceOptions surface{};
};

/// Cost: O(volume) scan plus O(surface). Throws Error: not_found for an object or contour that does not exist at tau, resource
/// for more triangles than allowed (of the whole surface, where the selection is not known before).
/// The same bytes for any thread count.
[[nodiscard]] Surface extract(const Volume& volume, double tau, const ExtractOptions& options = {}, const Context& context = {});

/// Properties of a triangle mesh, decided on indices alone (degenerate triangles on coordinates).
struct SurfaceReport {
    std::int64_t points = 0, triangles = 0, edges = 0;
    std::int64_t boundary_edges = 0;       ///< edges with one triangle
    std::int64_t non_manifold_edges = 0;   ///< edges with more than two
    std::int64_t misoriented_edges = 0;    ///< edges whose two triangles run the same way
    std::int64_t non_manifold_points = 0;  ///< points whose triangles are not one fan
    std::int64_t unused_points = 0;
    std::int64_t zero_area_triangles = 0;     ///< repeated or collinear points
    std::int64_t coincident_points = 0;       ///< points equal in all coordinates to an earlier one
    std::vector<std::int64_t> component_chi;  ///< Euler number of each component, in order of the first point
    [[nodiscard]] bool is_closed() const { return boundary_edges == 0 && non_manifold_edges == 0; }
    [[nodiscard]] bool is_manifold() const { return non_manifold_edges == 0 && non_manifold_points == 0; }
    [[nodiscard]] bool is_oriented() const { return misoriented_edges == 0; }
    [[nodiscard]] bool has_no_zero_area() const { return zero_area_triangles == 0; }
};
[[nodiscard]] SurfaceReport inspect(std::span<const std::array<double, 3>> points, std::span<const std::array<std::int64_t, 3>> triangles);

/// The space of the points in .ply, .stl, .obj, .vtp and .vtkhdf, of volumes whose space is LPS, RAS or LAS; others keep theirs. lps: as
/// medical programs write meshes, 3D Slicer among them. volume: that of the volume. .glb has axes of its own (docs/formats.md#glb).
enum class PointSpace : std::uint8_t { lps, ras, volume };

struct SurfaceFileOptions {
    PointSpace space = PointSpace::lps;
};

/// What a file says of the points of a surface in this space: "LPS", "RAS", "unknown", ...; "glTF" of .glb: metres, y up.
[[nodiscard]] std::string space_in_file(const std::string& path, const std::string& space, const SurfaceFileOptions& options = {});

/// The format follows the name: .ply (binary), .stl (binary), .obj, .vtp, .glb, .vtkhdf. Written to a temporary name and renamed: never
/// half a file. Returns warnings for the user (STL keeps no ids, float32 cannot separate points, ...). Throws Error: usage (unknown
/// extension), resource.
std::vector<std::string> write_surface(const std::string& path, const Surface& surface, const SurfaceFileOptions& options = {});
/// The same into a sink (isoatlas/sink.h).
std::vector<std::string> write_surface(Sink& sink, const Surface& surface, const SurfaceFileOptions& options = {});

/// A surface with fewer triangles than the exact one (level_of_detail.h).
struct SimplifiedSurface {
    Surface surface;
    double distance;  ///< no point of either surface is farther from the other, in the unit that was asked for
};

/// With coarser and coarser versions, which a viewer draws where the surface is small: .glb alone (MSFT_lod). They have the objects of the
/// surface; their distances are in the unit of its points. Throws Error: usage (another format), and as above.
std::vector<std::string> write_surface(const std::string& path, const Surface& surface, std::span<const SimplifiedSurface> coarser,
                                       const SurfaceFileOptions& options = {});

/// A surface with what it is called and drawn with; each may have an isovalue of its own.
struct NamedSurface {
    Surface surface;
    std::string name;                          ///< UTF-8
    std::array<std::uint8_t, 3> colour;        ///< red, green, blue: sRGB
    std::vector<SimplifiedSurface> coarser{};  ///< as above
};
/// Several surfaces in one file: .glb (a node with a name and a material each), .obj (groups), .ply .stl .vtp .vtkhdf (one mesh; .ply
/// has the number of the surface, from 1, as `object` of each point; .vtp and .vtkhdf as the array `Object`, and the names in field data).
/// They are of one volume: Throws Error: usage (none; different spaces or units; curves beside triangles), and as write_surface().
std::vector<std::string> write_surfaces(const std::string& path, std::span<const NamedSurface> surfaces,
                                        const SurfaceFileOptions& options = {});
std::vector<std::string> write_surfaces(Sink& sink, std::span<const NamedSurface> surfaces, const SurfaceFileOptions& options = {});

/// Reads back what write_surface writes, but for .vtkhdf, and the usual variants of the same formats from other tools. STL points are
/// merged when bit-equal. Of .glb that write_surface wrote: the points in the space and unit of the volume; of another .glb: as its nodes
/// place them. Throws Error: input, unsupported.
struct Mesh {
    Array<std::array<double, 3>> points;
    Array<std::array<std::int64_t, 3>> triangles;
    Array<std::int64_t> object, contour;  ///< when the file has them; of write_surfaces(): the number of the surface, from 1
    std::string space = "unknown";        ///< of the points, when the file says it as write_surface() and 3D Slicer do
    std::string unit{};                   ///< of lengths; empty: the file does not say
};
[[nodiscard]] Mesh read_mesh(const std::string& path);

}  // namespace isoatlas

#include "oracle/exact/embedding.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "formats/common/precision.h"
#include "isoatlas/isoatlas.h"
#include "oracle/exact/crossings.h"
#include "oracle/tunnels.h"
#include "unit/formats/mesh/mesh_samples.h"

namespace oracle {
namespace {

using isoatlas::Mesh;
using isoatlas::Surface;
using isoatlas::SurfaceOptions;
using isoatlas::SurfaceReport;
using isoatlas::Volume;
using Numbers = std::vector<std::int64_t>;

isoatlas::Context one_thread() {
    isoatlas::Context context;
    context.threads = 1;
    return context;
}

void place(isoatlas::Geometry& geometry, Placement placement) {
    if (placement == Placement::own) return;
    geometry = {};
    if (placement == Placement::voxel) return;
    geometry.spacing = {0.3, 1, 2.7};
    geometry.origin = {-120.3, 87.1, 311.7};
    if (placement == Placement::oblique) geometry.direction = {{{1, 0.6, 0.36}, {0, 0.8, 0.48}, {0, 0, 0.8}}};
}

bool is_oblique(const isoatlas::Geometry& geometry) {
    const auto along_an_axis = [](double x) { return x == 0 || std::abs(x) == 1; };
    return !std::ranges::all_of(geometry.direction, [&](const isoatlas::Vec3& row) { return std::ranges::all_of(row, along_an_axis); });
}

Numbers sorted(Numbers numbers) {
    std::ranges::sort(numbers);
    return numbers;
}

std::string text_of(const Numbers& numbers) {
    std::ostringstream out;
    for (const std::int64_t number : numbers) out << " " << number;
    return out.str();
}

/// Euler numbers of the contours at tau, by the arcs of the contour tree.
Numbers chi_of_tree(const isoatlas::Analysis& analysis, double tau) {
    Numbers chi;
    for (std::int64_t i = 0; i < analysis.contour_arc_count(); ++i) {
        const isoatlas::ContourArc arc = analysis.contour_arc(i);
        if (arc.value_low < tau && tau <= arc.value_high) chi.push_back(2 - 2 * arc.genus);
    }
    return sorted(chi);
}

Numbers chi_of_cut(const Volume& volume, double tau) {
    Numbers chi;
    for (const isoatlas::CutContour& contour : isoatlas::cut(volume, tau, {}, one_thread()).contours) chi.push_back(2 - 2 * contour.genus);
    return sorted(chi);
}

/// What inspect() and the exact predicates find wrong; crossings are left to the caller.
std::string fault_of(const SurfaceReport& report, const Crossings& found, bool closed) {
    if (closed && !report.is_closed()) return "not closed";
    if (!report.is_manifold()) return "not a manifold";
    if (!report.is_oriented()) return "not oriented";
    if (!report.has_no_zero_area() || found.flat > 0) return "flat triangles";
    if (report.unused_points > 0) return "unused points";
    return report.coincident_points > 0 ? "coincident points" : "";
}

/// Points that are equal in all bits become one.
Mesh welded(const Mesh& mesh) {
    Mesh result;
    std::map<std::array<double, 3>, std::int64_t> numbers;
    for (const auto& triangle : mesh.triangles) {
        auto& target = result.triangles.emplace_back();
        for (int i = 0; i < 3; ++i) {
            const auto& point = mesh.points[triangle[i]];
            const auto [place, is_new] = numbers.try_emplace(point, static_cast<std::int64_t>(result.points.size()));
            if (is_new) result.points.push_back(point);
            target[i] = place->second;
        }
    }
    return result;
}

class Checker {
public:
    Checker(const Surface& surface, const Numbers& chi, bool oblique, EmbeddingTally& tally)
        : surface_(surface), chi_(chi), oblique_(oblique), tally_(tally) {}

    std::string fault() {
        const SurfaceReport report = isoatlas::inspect(surface_.points, surface_.triangles);
        const Crossings found = find_crossings(surface_.points, surface_.triangles);
        ++tally_.meshes;
        tally_.triangles += report.triangles;
        tally_.pairs += found.pairs;
        if (const std::string fault = fault_of(report, found, surface_.closed); !fault.empty()) return fault;
        if (found.crossings > 0) return "crossings, first " + found.first;
        if (!surface_.closed) return "";
        if (sorted(report.component_chi) != chi_)
            return "components have Euler numbers" + text_of(sorted(report.component_chi)) + ", expected" + text_of(chi_);
        return fault_in_files();
    }

private:
    std::string fault_in_files() {
        static const mesh_samples::Folder folder;
        const bool keeps_double = isoatlas::position_precision(surface_) == isoatlas::Real::f64;
        tally_.kept_double += keeps_double;
        const bool is_written =
            surface_.triangles.size() > 2000 || tally_.rounded_meshes % 7 == 0;  // the disk is slower than all else here
        if (is_written) {
            isoatlas::write_surface(folder / "surface.ply", surface_, {.space = isoatlas::PointSpace::volume});
            const std::string fault = fault_in_ply(isoatlas::read_mesh(folder / "surface.ply"), keeps_double);
            if (!fault.empty()) return "PLY: " + fault;
        }
        if (keeps_double) return "";  // STL has float32 only, and the writer of PLY knows that this is too coarse here
        if (is_written) isoatlas::write_surface(folder / "surface.stl", surface_, {.space = isoatlas::PointSpace::volume});
        const std::string fault = fault_in_rounded(is_written ? isoatlas::read_mesh(folder / "surface.stl") : rounded());
        return fault.empty() ? "" : "float32: " + fault;
    }

    /// As it comes back from STL.
    [[nodiscard]] Mesh rounded() const {
        Mesh mesh{surface_.points, surface_.triangles, {}, {}};
        for (auto& point : mesh.points) {
            for (double& x : point) x = static_cast<double>(static_cast<float>(x));
        }
        return welded(mesh);
    }

    /// The points are those of the surface, rounded or not, and welding them changes nothing.
    std::string fault_in_ply(const Mesh& mesh, bool keeps_double) const {
        if (mesh.triangles.size() != surface_.triangles.size() || mesh.points.size() != surface_.points.size()) return "counts differ";
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const double x = surface_.points[i][axis];
                if (mesh.points[i][axis] != (keeps_double ? x : static_cast<double>(static_cast<float>(x)))) return "points differ";
            }
        }
        const Mesh joined = welded(mesh);
        const SurfaceReport report = isoatlas::inspect(joined.points, joined.triangles);
        if (const std::string fault = fault_of(report, {}, true); !fault.empty()) return fault;
        return sorted(report.component_chi) == chi_ ? "" : "Euler numbers differ";
    }

    std::string fault_in_rounded(const Mesh& mesh) {
        const SurfaceReport report = isoatlas::inspect(mesh.points, mesh.triangles);
        const Crossings found = find_crossings(mesh.points, mesh.triangles);
        ++tally_.rounded_meshes;
        tally_.rounded_pairs += found.pairs;
        tally_.oblique_meshes += oblique_;
        tally_.oblique_crossed += oblique_ && found.crossings > 0;
        if (const std::string fault = fault_of(report, found, true); !fault.empty()) return fault;
        if (sorted(report.component_chi) != chi_) return "Euler numbers differ";
        // Rounding keeps the planes between cells apart when they lie along the axes. Otherwise sheets a few ulps apart may cross.
        return found.crossings > 0 && !oblique_ ? "crossings, first " + found.first : "";
    }

    const Surface& surface_;
    const Numbers& chi_;
    bool oblique_;
    EmbeddingTally& tally_;
};

double distance(const isoatlas::Vec3& p, const isoatlas::Vec3& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); }

/// Of a surface in voxels.
void measure(const Surface& surface, EmbeddingTally& tally) {
    for (const auto& t : surface.triangles) {
        const isoatlas::Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
        const isoatlas::Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        const double area = std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
        const std::array<double, 3> side{distance(a, b), distance(b, c), distance(c, a)};
        tally.shortest_edge = std::min(tally.shortest_edge, *std::ranges::min_element(side));
        tally.min_height = std::min(tally.min_height, area / *std::ranges::max_element(side));
    }
}

}  // namespace

std::string embedding_fault(Volume volume, const std::vector<double>& isovalues, const std::vector<Placement>& placements,
                            EmbeddingTally& tally) {
    const isoatlas::Analysis analysis = isoatlas::analyse(volume, {.zones = false}, one_thread());
    for (const double tau : isovalues) {
        const Numbers chi = chi_of_cut(volume, tau);
        std::ostringstream where;
        where.precision(17);
        where << "tau " << tau;
        if (chi != chi_of_tree(analysis, tau)) return where.str() + ": cut and tree disagree";
        const auto tunnels = count_tunnels(volume, tau);
        for (std::size_t shape = 0; shape < tunnels.size(); ++shape) tally.tunnels[shape] += tunnels[shape];
        for (const Placement placement : placements) {
            place(volume.info.geometry, placement);
            for (const auto style : {isoatlas::SurfaceStyle::compact, isoatlas::SurfaceStyle::full}) {
                for (const auto boundary : {isoatlas::Boundary::closed, isoatlas::Boundary::open}) {
                    if (boundary == isoatlas::Boundary::open && placement != placements.front()) continue;  // a part of the closed one
                    SurfaceOptions options;
                    options.boundary = boundary;
                    options.style = style;
                    options.normals = options.ids = false;
                    const Surface surface = isoatlas::extract(volume, tau, {.surface = options}, one_thread());
                    if (placement == Placement::voxel) measure(surface, tally);
                    const std::string fault = Checker(surface, chi, is_oblique(volume.info.geometry), tally).fault();
                    if (fault.empty()) continue;
                    where << ", placement " << static_cast<int>(placement) << ", style " << static_cast<int>(style) << ", boundary "
                          << static_cast<int>(boundary) << ": " << fault;
                    return where.str();
                }
            }
        }
    }
    return "";
}

std::string EmbeddingTally::text() const {
    std::ostringstream out;
    out << meshes << " meshes, " << triangles << " triangles, " << pairs << " pairs of triangles; rounded to float32 " << rounded_meshes
        << " meshes, " << rounded_pairs << " pairs; too fine for float32 " << kept_double << "; oblique ones that cross after rounding "
        << oblique_crossed << " of " << oblique_meshes << "; open tunnels";
    for (std::size_t shape = 0; shape < tunnels.size(); ++shape) out << " " << kTunnelShapes[shape] << ": " << tunnels[shape];
    if (shortest_edge < 1e300) out << "; shortest edge " << shortest_edge << ", least height " << min_height << " voxels";
    return out.str();
}

int repetitions() {
    const char* trials = std::getenv("ISOATLAS_TRIALS");
    return trials == nullptr ? 1 : std::max(1, std::atoi(trials) / 200);
}

}  // namespace oracle

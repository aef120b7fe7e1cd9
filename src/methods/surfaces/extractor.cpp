#include <utility>

#include "isoatlas/environment.h"
#include "isoatlas/error.h"
#include "isoatlas/surface_methods.h"
#include "methods/surfaces/cell_by_cell.h"
#include "methods/surfaces/contour_stack.h"
#include "methods/surfaces/dividing_cubes.h"
#include "methods/surfaces/loops.h"
#include "methods/surfaces/marching_cubes_33.h"
#include "methods/surfaces/spider_web.h"
#include "methods/surfaces/tetrahedra.h"

namespace isoatlas {
namespace {

constexpr std::array<SurfaceMethodInfo, 9> kMethods{{
    {SurfaceMethod::connected_contours, "connected-contours", "Connected contours of slices", "3.1",
     "Fuchs, Kedem, Uselton, Optimal surface reconstruction from planar contours, 1977", "n + p q log p, polygons of p and q corners"},
    {SurfaceMethod::marching_cubes, "marching-cubes", "Marching Cubes of 1987", "3.2", "Lorensen, Cline, Marching Cubes, 1987", "n"},
    {SurfaceMethod::asymptotic_decider, "asymptotic-decider", "Asymptotic decider", "3.2", "Nielson, Hamann, The asymptotic decider, 1991",
     "n"},
    {SurfaceMethod::marching_cubes_33, "marching-cubes-33", "Marching Cubes 33", "3.2",
     "Chernyaev, Marching Cubes 33: construction of topologically correct isosurfaces, 1995", "n"},
    {SurfaceMethod::dividing_cubes, "dividing-cubes", "Dividing Cubes", "3.3",
     "Cline, Lorensen, Ludke, Crawford, Teeter, Two algorithms for the three-dimensional reconstruction of tomograms, 1988",
     "n + k d^3, d divisions"},
    {SurfaceMethod::five_tetrahedra, "five-tetrahedra", "Five tetrahedra a cell", "3.5",
     "Doi, Koide, An efficient method of triangulating equi-valued surfaces by using tetrahedral cells, 1991", "n"},
    {SurfaceMethod::six_tetrahedra, "six-tetrahedra", "Six tetrahedra a cell", "3.5", "Kuhn, Some combinatorial lemmas in topology, 1960",
     "n"},
    {SurfaceMethod::spider_web, "spider-web", "Spider Web", "3.4",
     "Karron, The Spider Web algorithm for surface construction in noisy volume data, 1992", "n"},
    {SurfaceMethod::trilinear, "trilinear", "Spider Web, trilinear interiors", "", "isoatlas", "n"},
}};

/// For all methods: refuses isovalues that are none, says what surface it is, and turns triangles counter-clockwise seen from the Lows in
/// physical space, too.
class Checked final : public Extractor {
public:
    Checked(const Volume& volume, bool is_product, std::unique_ptr<Extractor> extractor)
        : volume_(volume), is_product_(is_product), extractor_(std::move(extractor)) {}
    Extraction extract(double tau, const Context& context) const override {
        const EnvironmentScope scope(context);
        require_isovalue(tau);
        Extraction result = extractor_->extract(tau, context);
        if (is_product_) return result;
        Surface& surface = result.surface;
        surface.tau = tau, surface.reported_tau = volume_.info.calibration.reported(tau);
        surface.space = volume_.info.geometry.space, surface.unit = volume_.info.geometry.unit;
        surface.closed = false;
        if (handedness(volume_.info.geometry) < 0) {
            for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
        }
        return result;
    }

private:
    const Volume& volume_;
    bool is_product_;
    std::unique_ptr<Extractor> extractor_;
};

/// Each adds the triangles of one cell.
constexpr auto kMarchingCubes = [](const Index3& cell, auto& points) { add_loops(cell, FaceRule::fewer_are_separate, points); };
constexpr auto kAsymptoticDecider = [](const Index3& cell, auto& points) { add_loops(cell, FaceRule::asymptotic_decider, points); };
constexpr auto kMarchingCubes33 = [](const Index3& cell, auto& points) { add_cell_of_33(cell, points); };
constexpr auto kFiveTetrahedra = [](const Index3& cell, auto& points) { add_tetrahedra(cell, true, points); };
constexpr auto kSixTetrahedra = [](const Index3& cell, auto& points) { add_tetrahedra(cell, false, points); };

template <class AddCell>
std::unique_ptr<Extractor> cell_by_cell(const Volume& volume, AddCell add) {
    return std::make_unique<CellByCell<AddCell>>(volume, add);
}

std::unique_ptr<Extractor> extractor_of(SurfaceMethod method, const Volume& volume, const ExtractorOptions& options) {
    switch (method) {
        case SurfaceMethod::connected_contours: return std::make_unique<ConnectedContours>(volume);
        case SurfaceMethod::marching_cubes: return cell_by_cell(volume, kMarchingCubes);
        case SurfaceMethod::asymptotic_decider: return cell_by_cell(volume, kAsymptoticDecider);
        case SurfaceMethod::marching_cubes_33: return cell_by_cell(volume, kMarchingCubes33);
        case SurfaceMethod::dividing_cubes: return std::make_unique<DividingCubes>(volume, options.divisions);
        case SurfaceMethod::five_tetrahedra: return cell_by_cell(volume, kFiveTetrahedra);
        case SurfaceMethod::six_tetrahedra: return cell_by_cell(volume, kSixTetrahedra);
        case SurfaceMethod::spider_web: return std::make_unique<SpiderWeb>(volume, Interpolant::faces);
        case SurfaceMethod::trilinear: return std::make_unique<SpiderWeb>(volume, Interpolant::trilinear);
    }
    throw Error(ErrorKind::usage, {.what = "no such surface method"});
}

}  // namespace

std::span<const SurfaceMethodInfo> surface_methods() { return kMethods; }

const SurfaceMethodInfo& info_of(SurfaceMethod method) { return kMethods[static_cast<std::size_t>(method)]; }

std::unique_ptr<Extractor> make_extractor(SurfaceMethod method, const Volume& volume, const ExtractorOptions& options) {
    if (volume.info.extent.rank != 3)
        throw Error(ErrorKind::usage,
                    {.where = volume.info.path, .what = "an image has curves, not surfaces", .next = "choose a 3D volume"});
    if (options.divisions < 1 || options.divisions > kMaxDivisions)
        throw Error(ErrorKind::usage, {.where = "divisions of a cell", .expected = "1 to " + std::to_string(kMaxDivisions)});
    const bool is_product = method == SurfaceMethod::spider_web || method == SurfaceMethod::trilinear;
    return std::make_unique<Checked>(volume, is_product, extractor_of(method, volume, options));
}

}  // namespace isoatlas

#include "compare/pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/shapes.h"

namespace isoatlas::cli {
namespace {

constexpr std::int64_t kMostCells = 1'000'000, kEnoughCells = 400'000;  ///< active ones
constexpr std::size_t kMostMarks = 30'000;
constexpr double kMarkPixels = 1.6;                    ///< radius
constexpr std::int64_t kFewSamples = 27;               ///< so few are drawn, and the grid between them
constexpr double kCellsAround = 25, kCellsAbove = 20;  ///< the same view of all such volumes: single cells are set side by side
constexpr double kCellsMargin = 1.15;                  ///< for the caption
constexpr Colour kGridColour{0.35, 0.37, 0.42};
constexpr double kOverlap = 1.3;  ///< of tiles: points lie up to half a diagonal beside the surface, which leaves gaps

std::int64_t active_cells(const Volume& volume, double tau) {
    CellSearchCost cost;
    static_cast<void>(make_cell_search(SearchMethod::brute_force, volume)->active(tau, cost));
    return cost.active;
}

/// The middle of the volume, a part of each axis.
SampleBox middle_of(const Extent& extent, std::int64_t part) {
    SampleBox box{{0, 0, 0}, extent.size};
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t size = std::max<std::int64_t>(std::min<std::int64_t>(2, extent.size[axis]), extent.size[axis] / part);
        box.begin[axis] = (extent.size[axis] - size) / 2;
        box.end[axis] = box.begin[axis] + size;
    }
    return box;
}

/// Rods along edges and balls on triangles without area. Returns false where there are more than can be drawn.
bool mark(const Surface& surface, const SurfaceDefects& defects, double radius, Shapes& marks) {
    std::size_t left = kMostMarks;
    for (const auto* edges : {&defects.hole_edges, &defects.non_manifold_edges}) {
        for (const SurfaceDefects::Edge& edge : *edges) {
            if (left == 0) return false;
            --left;
            marks.add_rod(surface.points[edge[0]], surface.points[edge[1]], radius);
        }
    }
    for (const std::int64_t triangle : defects.zero_area_triangles) {
        if (left == 0) return false;
        --left;
        marks.add_ball(surface.points[surface.triangles[triangle][0]], 1.5 * radius);
    }
    return true;
}

/// Rods between neighbouring samples, and balls on those that are High: of small volumes, in which single cells are looked at.
Surface grid_of(const Volume& volume, double tau) {
    constexpr double kRod = 0.008, kBall = 0.05;  // radius, of the smallest spacing
    const Extent& extent = volume.info.extent;
    const Geometry& geometry = volume.info.geometry;
    Shapes shapes;
    if (extent.voxels() > kFewSamples) return {};
    const double unit = std::ranges::min(geometry.spacing);
    for (std::int64_t i = 0; i < extent.voxels(); ++i) {
        const auto place = [&](const Index3& at) {
            return to_physical(geometry, {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
        };
        const Index3 here = extent.voxel(i);
        if (volume.value(i) >= tau) shapes.add_ball(place(here), kBall * unit);
        for (int axis = 0; axis < 3; ++axis) {
            Index3 next = here;
            if (++next[axis] < extent.size[axis]) shapes.add_rod(place(here), place(next), kRod * unit);
        }
    }
    add_normals(shapes.surface());
    return std::move(shapes.surface());
}

/// Its sides are those of the small cubes: points of one cell are that far from each other.
Surface tiles_of(const PointCloud& cloud, const Vec3& sides) {
    Shapes tiles;
    for (std::int64_t i = 0; i < std::ssize(cloud.points); ++i) {
        const auto& normal = cloud.normals[i];
        tiles.add_tile(cloud.points[i], {normal[0], normal[1], normal[2]}, sides);
    }
    return std::move(tiles.surface());
}

}  // namespace

std::optional<SampleBox> picture_box(const Volume& volume, double tau) {
    if (active_cells(volume, tau) <= kMostCells) return std::nullopt;
    for (std::int64_t part = 2;; part *= 2) {
        const SampleBox box = middle_of(volume.info.extent, part);
        if (box.size().product() <= kEnoughCells || active_cells(crop(volume, box), tau) <= kEnoughCells) return box;
    }
}

void SurfacePictures::choose_camera(const Surface& reference) {
    has_camera_ = true;
    is_empty_ = reference.triangles.empty();
    if (is_empty_) return;
    Scene scene;
    grid_ = grid_of(volume_, tau_);
    if (!grid_.triangles.empty()) {
        scene.objects.push_back({.surface = grid_});
        camera_ = fit_camera(scene, view_from(kCellsAround, kCellsAbove), options());
        camera_.height *= kCellsMargin;
        return;
    }
    scene.objects.push_back({.surface = reference});
    camera_ = fit_camera(scene, best_view(scene, {0, 0, 1}, context_), options());
}

RenderOptions SurfacePictures::options() const {
    return {.width = kSide,
            .height = kSide,
            .background = use_ == PictureUse::page ? Background::transparent : Background::light,
            .samples = 3};
}

void SurfacePictures::draw(const ComparedMethod& method, Scene scene, bool shows_all) {
    scene.objects.push_back({.surface = grid_, .colour = kGridColour});
    std::erase_if(scene.objects, [](const SceneObject& object) { return object.surface.triangles.empty(); });
    RenderOptions own = options();
    if (use_ == PictureUse::sheet) own.caption = {method.title};
    pictures_.push_back({method.name, render_scene(scene, camera_, own, context_), shows_all});
}

void SurfacePictures::add(const ExtractedSurface& one, const SurfaceInHand& made) {
    if (!has_camera_) choose_camera(made.result.surface);
    if (is_empty_) return;
    Scene scene;
    if (one.is_points) {
        Vec3 sides = volume_.info.geometry.spacing;
        for (double& side : sides) side *= kOverlap / one.method.divisions;
        scene.objects.push_back({.surface = tiles_of(made.result.points, sides), .colour = palette(0)});
        draw(one.method, std::move(scene), true);
        return;
    }
    Surface surface = made.result.surface;
    add_normals(surface);
    SplitSurface both = split(surface, made.difference.misplaced_triangles);
    Shapes marks;
    const bool shows_all = mark(surface, made.defects, kMarkPixels * pixel(), marks);
    scene.objects.push_back({.surface = std::move(both.rest), .colour = palette(0)});
    scene.objects.push_back({.surface = std::move(both.part), .colour = kMisplacedColour});
    scene.objects.push_back({.surface = std::move(marks.surface()), .colour = kDefectColour});
    draw(one.method, std::move(scene), shows_all);
}

void SurfacePictures::add_ray_casting() {
    if (is_empty_) return;
    constexpr double kOpaque = 0.9999, kStep = 0.05;  // of a voxel: sheets that are thinner are missed
    const Vec3& spacing = volume_.info.geometry.spacing;
    const double extinction = extinction_of(kOpaque, kStep * std::min({spacing[0], spacing[1], spacing[2]}));
    const double high =
        visit_samples(volume_, [](auto samples) { return static_cast<double>(*std::max_element(samples.begin(), samples.end())); });
    Scene scene;
    scene.volume.volume = &volume_;
    scene.volume.curves.push_back(
        {.points = {{tau_, 0}, {tau_, extinction}, {std::max(tau_ + 1, high), extinction}}, .colour = palette(0)});
    scene.volume.sample_distance = kStep;
    draw({.title = "Ray casting"}, std::move(scene), true);
}

Image sheet_of(const std::vector<MethodPicture>& pictures) {
    constexpr std::int64_t kColumns = 4;
    const auto count = std::ssize(pictures);
    if (count == 0) return blank_picture({.width = SurfacePictures::kSide, .height = SurfacePictures::kSide, .caption = {"no surface"}});
    const std::int64_t columns = std::min(kColumns, count), rows = (count + columns - 1) / columns, side = SurfacePictures::kSide;
    Image sheet(columns * side, rows * side);
    std::ranges::fill(sheet.rgba, std::uint8_t{255});
    for (std::int64_t i = 0; i < count; ++i) {
        const Image& picture = pictures[static_cast<std::size_t>((i + count - 1) % count)].image;
        for (std::int64_t y = 0; y < side; ++y)
            std::copy_n(picture.at(0, y), 4 * side, sheet.at(i % columns * side, i / columns * side + y));
    }
    return sheet;
}

}  // namespace isoatlas::cli

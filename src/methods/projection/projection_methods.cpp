#include "isoatlas/projection_methods.h"

#include <algorithm>
#include <cmath>

#include "isoatlas/environment.h"
#include "methods/projection/projector.h"
#include "render/colours.h"

namespace isoatlas {
namespace {

constexpr std::array<ProjectionMethodInfo, 3> kMethods{
    {{ProjectionMethod::ray_casting, "ray-casting", "Ray casting", "Levoy, Display of surfaces from volume data, 1988"},
     {ProjectionMethod::splatting, "splatting", "Splatting in sheets", "Westover, Footprint evaluation for volume rendering, 1990"},
     {ProjectionMethod::shear_warp, "shear-warp", "Shear-warp factorisation",
      "Lacroute, Levoy, Fast volume rendering using a shear-warp factorization of the viewing transformation, 1994"}}};
constexpr double kFineStep = 1.0 / 32;

void require(bool holds, const char* what, const char* expected, ErrorKind kind = ErrorKind::usage) {
    if (!holds) throw Error(kind, {.what = what, .expected = expected});
}

void check(const SceneVolume& volume, const Camera& camera, const ProjectionOptions& options) {
    constexpr std::int64_t kMaxSide = 16384;
    const auto within = [](auto value, auto low, auto high) { return value >= low && value <= high; };
    require(volume.volume != nullptr, "there is no volume to project", "a volume");
    require(volume.volume->info.extent.rank == 3, "a 2D volume has no projection", "a 3D volume");
    require(volume.volume->info.geometry.coordinates[0].empty(), "rectilinear grids are not projected", "even spacing",
            ErrorKind::unsupported);
    require(camera.projection == Projection::orthographic, "a perspective is not projected", "an orthographic camera");
    require(within(options.width, 1, kMaxSide) && within(options.height, 1, kMaxSide), "the size of the picture is out of range",
            "1 to 16384");
    require(within(options.step, 1.0 / 64, 16.0), "the step along rays is out of range", "1/64 to 16");
    require(within(options.kernel, 0.3, 3.0), "the kernel of splatting is out of range", "0.3 to 3");
}

std::vector<float> values_of(const Volume& volume) {
    std::vector<float> values(volume.info.extent.voxels());
    visit_samples(volume,
                  [&](auto samples) { std::ranges::transform(samples, values.begin(), [](auto v) { return static_cast<float>(v); }); });
    return values;
}

std::array<double, 2> range_of(const SceneVolume& volume, const std::vector<float>& values) {
    if (volume.range) return *volume.range;
    const auto [low, high] = std::ranges::minmax(values);
    return {static_cast<double>(low), static_cast<double>(high)};
}

ProjectedPicture projected(ProjectionMethod method, const SceneVolume& volume, const Camera& camera, const ProjectionOptions& options,
                           const Context& context) {
    check(volume, camera, options);
    const VolumeInfo& info = volume.volume->info;
    std::vector<float> values = values_of(*volume.volume);
    const Transfer transfer(volume, 1, range_of(volume, values));
    Projector projector{info, std::move(values), transfer, CameraRays(camera, options.width, options.height), options, context, {}, {}};
    for (int a = 0; a < 3; ++a) {
        for (int r = 0; r < 3; ++r) projector.axis[a][r] = info.geometry.direction[r][a] * info.geometry.spacing[a];
    }
    for (int a = 0; a < 3; ++a) {
        const Vec3 normal = cross(projector.axis[(a + 1) % 3], projector.axis[(a + 2) % 3]);
        projector.inverse[a] = scale(normal, 1 / dot(projector.axis[a], normal));
    }
    ProjectedPicture picture = projector.blank();
    switch (method) {
        case ProjectionMethod::ray_casting: cast_rays(projector, picture); break;
        case ProjectionMethod::splatting: splat(projector, picture); break;
        case ProjectionMethod::shear_warp: shear_and_warp(projector, picture); break;
    }
    return picture;
}

}  // namespace

std::span<const ProjectionMethodInfo> projection_methods() { return kMethods; }

const ProjectionMethodInfo& info_of(ProjectionMethod method) { return kMethods[static_cast<std::size_t>(method)]; }

ProjectedPicture project_by(ProjectionMethod method, const SceneVolume& volume, const Camera& camera, const ProjectionOptions& options,
                            const Context& context) {
    const EnvironmentScope scope(context);
    return projected(method, volume, camera, options, context);
}

ProjectedPicture projected_integral(const SceneVolume& volume, const Camera& camera, const ProjectionOptions& options,
                                    const Context& context) {
    const EnvironmentScope scope(context);
    ProjectionOptions fine = options;
    fine.step = kFineStep;
    return projected(ProjectionMethod::ray_casting, volume, camera, fine, context);
}

PictureError picture_error(const ProjectedPicture& picture, const ProjectedPicture& exact) {
    require(picture.width == exact.width && picture.height == exact.height, "the pictures have different sizes", "two of one size");
    PictureError error;
    double squares = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            const double difference = static_cast<double>(picture.pixels[i][c]) - static_cast<double>(exact.pixels[i][c]);
            squares += difference * difference, error.largest = std::max(error.largest, std::abs(difference));
        }
    }
    error.root_mean_square = std::sqrt(squares / (4 * static_cast<double>(picture.pixels.size())));
    return error;
}

Image image_of(const ProjectedPicture& picture) {
    Image image(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const auto& pixel = picture.pixels[i];
        const double opacity = static_cast<double>(pixel[3]);
        for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * i + c] = opacity > 0 ? srgb_byte(static_cast<double>(pixel[c]) / opacity) : 0;
        image.rgba[4 * i + 3] = byte_of(opacity);
    }
    return image;
}

}  // namespace isoatlas

// Methods that project a volume onto a picture, each as its paper describes it, with its errors: in image order a ray for every pixel, in
// object order a footprint for every sample, or slices that are sheared and composited.
//
// All see absorption and emission (OpticalModel::absorption_emission) without lights, through an orthographic camera.
// In the literature: chapter 2 of the dissertation; Levoy, Display of surfaces from volume data, 1988; Westover, Footprint evaluation for
// volume rendering, 1990; Lacroute, Levoy, Fast volume rendering using a shear-warp factorization of the viewing transformation, 1994.
// docs/methods.md.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "isoatlas/context.h"
#include "isoatlas/render.h"

namespace isoatlas {

enum class ProjectionMethod : std::uint8_t { ray_casting, splatting, shear_warp };

struct ProjectionMethodInfo {
    ProjectionMethod method;
    std::string_view name;    ///< "shear-warp"
    std::string_view title;   ///< "Shear-warp factorisation"
    std::string_view source;  ///< authors, title, year
};
[[nodiscard]] std::span<const ProjectionMethodInfo> projection_methods();
[[nodiscard]] const ProjectionMethodInfo& info_of(ProjectionMethod method);

struct ProjectionOptions {
    std::int64_t width = 256, height = 256;  ///< 1 to 16384
    double step = 1;                         ///< of ray casting, in the smallest spacing; 1/64 to 16
    double kernel = 0.6;                     ///< of splatting: standard deviation of the Gaussian, in samples; 0.3 to 3
};

/// Linear light, premultiplied, and opacity. Row 0 is the top one, x runs fastest.
struct ProjectedPicture {
    std::int64_t width = 0, height = 0;
    std::vector<std::array<float, 4>> pixels{};
    std::int64_t samples = 0;  ///< values that were looked at: along rays, of samples with a footprint, of resampled slices
};

/// The volume's transfer function counts, and of the camera all but its projection, which has to be orthographic. Throws Error: usage (a
/// number out of range, no volume, a perspective), unsupported (rectilinear grids), cancelled. Cost: ray casting O(pixels * samples of a
/// ray), splatting O(visible samples * pixels of a footprint + slices * pixels), shear-warp O(samples). On one thread; a copy of the
/// samples.
[[nodiscard]] ProjectedPicture project_by(ProjectionMethod method, const SceneVolume& volume, const Camera& camera,
                                          const ProjectionOptions& options = {}, const Context& context = {});

/// The integral that the methods approximate: rays with 32 samples in the smallest spacing.
[[nodiscard]] ProjectedPicture projected_integral(const SceneVolume& volume, const Camera& camera, const ProjectionOptions& options = {},
                                                  const Context& context = {});

/// Over all pixels and their four numbers.
struct PictureError {
    double root_mean_square = 0, largest = 0;
};
/// Throws Error{usage} for pictures of different sizes.
[[nodiscard]] PictureError picture_error(const ProjectedPicture& picture, const ProjectedPicture& exact);

/// In sRGB, on a transparent background.
[[nodiscard]] Image image_of(const ProjectedPicture& picture);

}  // namespace isoatlas

// Volume rendering on the page of a comparison: optical models, and methods that project matter, with their errors.
#pragma once

#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

struct ModelPicture {
    std::string name, title;
    double seconds = 0;
    Image image{};
};

struct ProjectionPicture {
    std::string name, title, source;
    double seconds = 0;
    std::int64_t samples = 0;  ///< values looked at
    PictureError error{};      ///< against the integral
    Image image{};
};

struct VolumePictures {
    std::vector<ModelPicture> models{};
    std::vector<ProjectionPicture> projections{};
    std::int64_t side = 0;  ///< pixels
};

/// What is at least tau as matter, the denser the higher, from the camera of the surfaces. None of a rectilinear grid.
[[nodiscard]] VolumePictures make_volume_pictures(const Volume& volume, double tau, const Camera& camera, const Context& context);

/// A section of the page; empty: there are no pictures.
[[nodiscard]] std::string volume_pictures_html(const VolumePictures& pictures);

}  // namespace isoatlas::cli

// What the user wants to see in a picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <isoatlas/isoatlas.h>

namespace isoatlas::cli {

/// As typed.
struct PictureWords {
    std::vector<double> taus, opacities;
    std::vector<std::string> objects, colours;
    std::string cut, view = "auto", size = "768x768", background = "light";
};

/// --object ID or ID@T
struct ShownObject {
    std::int64_t id = 0;
    std::optional<double> tau;  ///< calibrated
};

enum class CutShape : std::uint8_t { none, octant, half, planes };

struct PictureArguments {
    std::vector<double> taus;  ///< calibrated
    std::vector<ShownObject> objects;
    std::vector<double> opacities;
    std::vector<Colour> colours;
    CutShape cut = CutShape::none;
    std::vector<HalfSpace> planes;  ///< of CutShape::planes
    std::optional<View> view;       ///< none: the best one
    std::int64_t width = 768, height = 768;
    Background background = Background::light;
    int samples = 4;
    bool perspective = false, plain = false;
};

/// Throws Error{usage} that names the option and what it takes.
void convert_picture(const PictureWords& words, PictureArguments& picture);

/// The scene with everything the arguments ask for but the cut. Throws Error: usage, not_found.
class Source;
struct Arguments;
[[nodiscard]] Scene scene_of(const Arguments& arguments, Source& source);
/// The part that --cut takes away, seen from `view`.
[[nodiscard]] std::vector<HalfSpace> removed_part(const PictureArguments& picture, const Scene& scene, const View& view);

}  // namespace isoatlas::cli

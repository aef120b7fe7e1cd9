// Pictures of surfaces from one camera, with what is wrong with them in colour.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/comparison.h"

namespace isoatlas::cli {

/// Colours of the pictures and of their legend: bone, and two that everybody tells from it and from each other.
inline constexpr Colour kDefectColour{0.86, 0.08, 0.08}, kMisplacedColour{0.0, 0.42, 0.78};

struct MethodPicture {
    std::string name;  ///< of the method; empty: ray casting
    Image image;       ///< with a transparent background
    bool shows_all_defects = true;
};

/// Surfaces of a million active cells are no pictures, and in noise connected contours of two million take minutes and gigabytes: the box
/// in the middle of a volume that has fewer active cells; none: all of it.
[[nodiscard]] std::optional<SampleBox> picture_box(const Volume& volume, double tau);

/// page: transparent. sheet: light, with the names of the methods.
enum class PictureUse : std::uint8_t { page, sheet };

/// Draws what run_extractors() shows.
class SurfacePictures {
public:
    /// The volume must live as long as this.
    SurfacePictures(const Volume& volume, double tau, PictureUse use, const Context& context)
        : volume_(volume), tau_(tau), use_(use), context_(context) {
        context_.progress = {};
    }

    /// The first one chooses the camera: its best view; of a few cells always the same one, with the grid between the samples.
    void add(const ExtractedSurface& one, const SurfaceInHand& made);
    /// The first crossing of each ray with the isosurface of the trilinear function, without triangles.
    void add_ray_casting();
    /// None before there is a surface.
    [[nodiscard]] const Camera* camera() const { return has_camera_ && !is_empty_ ? &camera_ : nullptr; }
    /// In the order in which they were added.
    [[nodiscard]] const std::vector<MethodPicture>& pictures() const { return pictures_; }

    static constexpr std::int64_t kSide = 480;  ///< pixels

private:
    void choose_camera(const Surface& reference);
    void draw(const ComparedMethod& method, Scene scene, bool shows_all);
    [[nodiscard]] RenderOptions options() const;
    [[nodiscard]] double pixel() const { return camera_.height / static_cast<double>(kSide); }

    const Volume& volume_;
    double tau_;
    PictureUse use_;
    Context context_;
    bool has_camera_ = false, is_empty_ = true;
    Camera camera_;
    Surface grid_;  ///< of the samples of a small volume
    std::vector<MethodPicture> pictures_;
};

/// Pictures in rows; ray casting, the last one, comes first.
[[nodiscard]] Image sheet_of(const std::vector<MethodPicture>& pictures);

}  // namespace isoatlas::cli

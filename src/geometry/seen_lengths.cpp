#include "geometry/seen_lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/vectors.h"
#include "isoatlas/error.h"

namespace isoatlas {
namespace {

constexpr double kPictureLines = 1080;
constexpr double kUnseen = 1.0 / 16;  // coarse, and not so coarse that a turn of the view shows it before finer parts are there

}  // namespace

Viewpoint viewpoint_of_picture(const Vec3& eye, double near) {
    return {.eye = eye, .pixel = 2 * std::tan(kFieldOfView / 2) / kPictureLines, .near = near};
}

void require_viewpoint(const Viewpoint& from) {
    const auto require = [](bool holds, const char* what, const char* expected) {
        if (!holds) throw Error(ErrorKind::usage, {.what = what, .expected = expected});
    };
    require(std::isfinite(norm(from.eye)), "the eye of a view is at no place", "three finite numbers");
    require(from.pixel > 0 && from.near > 0, "a length of a view is not positive", "more than 0");
    if (!from.cone) return;
    const double length = norm(from.cone->direction);
    require(length > 0 && std::isfinite(length), "a view has no direction", "three finite numbers, not all 0");
    require(from.cone->half_angle > 0 && from.cone->half_angle < std::numbers::pi / 2, "the angle of a view",
            "above 0 and less than half a turn");
}

SeenLengths::SeenLengths(const Viewpoint& from) : from_(from) {
    require_viewpoint(from);
    if (!from.cone) return;
    const double length = norm(from.cone->direction);
    Vec3 axis = from.cone->direction;
    for (double& x : axis) x /= length;
    cone_ = Cone{axis, std::sin(from.cone->half_angle), std::cos(from.cone->half_angle)};
}

/// The distance r cosine - h sine from the mantle is at most that from the cone.
bool SeenLengths::may_see(const Vec3& away, double radius) const {
    const double along = dot(away, cone_->axis);
    const double beside = std::sqrt(std::max(0.0, dot(away, away) - along * along));
    return beside * cone_->cosine - along * cone_->sine <= radius;
}

double SeenLengths::pixels(double length, const Vec3& centre, double radius) const {
    const Vec3 away = minus(centre, from_.eye);
    const double found = length / (from_.pixel * std::max(norm(away) - radius, from_.near));
    return cone_ && !may_see(away, radius) ? found * kUnseen : found;
}

}  // namespace isoatlas

// Round solids with known topology: tori, shells, and the scene of `make demo`.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/portable.h"
#include "phantom/fill.h"
#include "phantom/makers.h"

namespace isoatlas {
namespace {

struct Point {
    double x, y, z;
};

double length(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }
double distance(const Point& p, const Point& q) { return length(p.x - q.x, p.y - q.y, p.z - q.z); }

/// Distance to a circle around the z axis through `centre`.
double circle_distance(const Point& p, const Point& centre, double radius) {
    return length(length(p.x - centre.x, p.y - centre.y, 0) - radius, p.z - centre.z, 0);
}

double segment_distance(const Point& p, const Point& a, const Point& b) {
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const double along = ((p.x - a.x) * ux + (p.y - a.y) * uy + (p.z - a.z) * uz) / (ux * ux + uy * uy + uz * uz);
    const double t = std::clamp(along, 0.0, 1.0);
    return distance(p, {a.x + t * ux, a.y + t * uy, a.z + t * uz});
}

/// `height` up to distance `core`, then falling linearly to 0 at `core + flank`.
double plateau(double d, double core, double flank, double height) { return height * std::clamp((core + flank - d) / flank, 0.0, 1.0); }

/// The scene of the demo; lengths are fractions of the volume's side.
double scene(const Point& p) {
    constexpr Point kFirst{0.30, 0.36, 0.50}, kSecond{0.68, 0.36, 0.50}, kRing{0.66, 0.76, 0.50};
    constexpr double kFlank = 0.05;
    const double from_first = distance(p, kFirst);
    double value = plateau(from_first, 0.17, kFlank, 180);
    value = std::max(value, plateau(distance(p, kSecond), 0.12, kFlank, 220));
    value = std::max(value, plateau(segment_distance(p, kFirst, kSecond), 0.05, kFlank, 160));
    value = std::max(value, plateau(circle_distance(p, kRing, 0.12), 0.03, kFlank, 200));
    value = std::max(value, plateau(segment_distance(p, kSecond, {0.66, 0.64, 0.50}), 0.012, kFlank, 90));
    // The hidden shell: a crust of 250 around a hollow of 60, invisible from outside below 180.
    value = std::max(value, plateau(std::fabs(from_first - 0.10), 0.022, kFlank, 250));
    if (from_first < 0.10) value = std::min(value, std::max(60.0, plateau(0.10 - from_first, 0.022, 0.03, 250)));
    return value;
}

}  // namespace

Volume torus_chain(const PhantomOptions& options) {
    const double side = static_cast<double>(options.size);
    const double radius = 0.3 * side, unit = 0.15 * side;
    const auto step = static_cast<std::int64_t>(std::ceil(2 * radius));
    const std::int64_t thickness = (options.size + 1) / 2;
    const double middle_y = (side - 1) / 2, middle_z = static_cast<double>(thickness - 1) / 2;
    const auto last = static_cast<double>(options.genus - 1);
    return fill<float>(options.size + (options.genus - 1) * step, options.size, thickness,
                       [&](std::int64_t x, std::int64_t y, std::int64_t z) {
                           const Point p{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
                           const double nearest = std::floor((p.x - middle_y) / (2 * radius) + 0.5);
                           const double centre = middle_y + 2 * radius * std::clamp(nearest, 0.0, last);
                           return 1 - circle_distance(p, {centre, middle_y, middle_z}, radius) / unit;
                       });
}

Volume nested_shells(const PhantomOptions& options) {
    const double middle = static_cast<double>(options.size - 1) / 2;
    const double period = (middle - 1) / static_cast<double>(options.shells);
    return fill<float>(options.size, options.size, options.size, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        const Point p{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        const double turns = distance(p, {middle, middle, middle}) / period;
        return turns >= static_cast<double>(options.shells) ? 0.0 : 0.5 - 0.5 * cos_turns(turns);
    });
}

Volume demo(const PhantomOptions& options) {
    Geometry geometry;
    geometry.spacing = {0.5, 0.5, 0.5};
    geometry.unit = "mm";
    const double scale = 1 / static_cast<double>(options.size);
    return fill<float>(
        options.size, options.size, options.size,
        [scale](std::int64_t x, std::int64_t y, std::int64_t z) {
            return scene(
                {(static_cast<double>(x) + 0.5) * scale, (static_cast<double>(y) + 0.5) * scale, (static_cast<double>(z) + 0.5) * scale});
        },
        geometry);
}

}  // namespace isoatlas

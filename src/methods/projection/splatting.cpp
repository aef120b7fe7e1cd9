// Splatting (Westover, 1990): every sample is a Gaussian ball of matter, whose footprint is added to a sheet; sheets are the slices that
// are most parallel to the picture, composited front to back.
#include <algorithm>
#include <numbers>

#include "base/cancel.h"
#include "methods/projection/projector.h"

namespace isoatlas {
namespace {

constexpr double kReach = 12;  // square of the distance, in standard deviations, at which a footprint ends; exp(-6) of it lies outside

/// The projected kernel, in pixels: exp(-(a u^2 + 2 b u v + c v^2) / 2) times `top`.
struct Footprint {
    double a, b, c, top, reach_u, reach_v;
};

class Splatter {
public:
    Splatter(const Projector& projector, ProjectedPicture& picture)
        : projector_(projector), picture_(picture), sheet_(picture.pixels.size()) {
        const CameraRays& rays = projector.rays;
        for (int a = 0; a < 3; ++a) {
            const Vec3& way = projector.axis[a];
            right_[a] = dot(way, rays.right) / rays.pixel_size(), down_[a] = -dot(way, rays.up) / rays.pixel_size();
        }
        const double variance = projector.options.kernel * projector.options.kernel;
        const double uu = variance * dot(right_, right_), uv = variance * dot(right_, down_), vv = variance * dot(down_, down_);
        const double determinant = uu * vv - uv * uv;
        // The kernel holds the matter of a sample: its volume over that of a column of a pixel.
        const double volume = std::abs(dot(projector.axis[0], cross(projector.axis[1], projector.axis[2])));
        const double top = volume / (rays.pixel_size() * rays.pixel_size()) / (2 * std::numbers::pi * std::sqrt(determinant));
        footprint_ = {vv / determinant,       -uv / determinant,     uu / determinant, top / -std::expm1(-kReach / 2),
                      std::sqrt(kReach * uu), std::sqrt(kReach * vv)};
    }

    void add(const Index3& sample, float value) {
        const OpticalProperties matter = projector_.matter(value);
        if (!(matter.extinction > 0)) return;
        ++picture_.samples;
        const Vec3 at = projector_.rays.project(to_physical(
            projector_.info.geometry, {static_cast<double>(sample[0]), static_cast<double>(sample[1]), static_cast<double>(sample[2])}));
        const auto [x0, x1] = pixels(at[0], footprint_.reach_u, picture_.width);
        const auto [y0, y1] = pixels(at[1], footprint_.reach_v, picture_.height);
        for (std::int64_t y = y0; y < y1; ++y) {
            for (std::int64_t x = x0; x < x1; ++x) {
                const double u = static_cast<double>(x) + 0.5 - at[0], v = static_cast<double>(y) + 0.5 - at[1];
                const double distance = footprint_.a * u * u + 2 * footprint_.b * u * v + footprint_.c * v * v;
                if (distance > kReach) continue;
                const double length = footprint_.top * std::exp(-distance / 2);
                auto& there = sheet_[x + picture_.width * y];
                for (int c = 0; c < 3; ++c) there[c] += static_cast<float>(length * matter.glow[c]);
                there[3] += static_cast<float>(length * matter.extinction);
            }
        }
    }

    /// Puts the sheet behind the picture, and begins another one.
    void finish() {
        for (std::size_t i = 0; i < sheet_.size(); ++i) {
            auto& [red, green, blue, depth] = sheet_[i];
            if (depth > 0)
                put_behind(picture_.pixels[i], static_cast<double>(depth),
                           {static_cast<double>(red), static_cast<double>(green), static_cast<double>(blue)});
            sheet_[i] = {};
        }
    }

private:
    static std::array<std::int64_t, 2> pixels(double middle, double reach, std::int64_t count) {
        return {std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(middle - reach))),
                std::min(count, static_cast<std::int64_t>(std::ceil(middle + reach)))};
    }

    const Projector& projector_;
    ProjectedPicture& picture_;
    std::vector<std::array<float, 4>> sheet_;  ///< glow and extinction times length
    Vec3 right_{}, down_{};                    ///< of an axis of the grid, in pixels
    Footprint footprint_{};
};

}  // namespace

void splat(const Projector& projector, ProjectedPicture& picture) {
    const Index3& size = projector.info.extent.size;
    const Vec3 way = projector.in_samples(projector.rays.toward);
    int across = 0;  // the axis that sheets are perpendicular to
    for (int a = 1; a < 3; ++a) {
        if (std::abs(dot(unit(projector.axis[a]), projector.rays.toward)) >
            std::abs(dot(unit(projector.axis[across]), projector.rays.toward)))
            across = a;
    }
    Splatter splatter(projector, picture);
    const int first = (across + 1) % 3, second = (across + 2) % 3;
    for (std::int64_t k = 0; k < size[across]; ++k) {
        stop_if_cancelled(projector.context);
        Index3 at{};
        at[across] = way[across] > 0 ? size[across] - 1 - k : k;  // what is nearer to the eye first
        for (at[second] = 0; at[second] < size[second]; ++at[second]) {
            for (at[first] = 0; at[first] < size[first]; ++at[first])
                splatter.add(at, projector.values[projector.info.extent.index(at[0], at[1], at[2])]);
        }
        splatter.finish();
    }
}

}  // namespace isoatlas

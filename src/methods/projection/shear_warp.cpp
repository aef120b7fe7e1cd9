// Shear-warp (Lacroute, Levoy, 1994): slices are shifted so that rays are perpendicular to them, resampled between their four nearest
// samples, composited into a picture of the sheared space, and that picture is warped.
#include <algorithm>

#include "base/cancel.h"
#include "methods/projection/projector.h"

namespace isoatlas {
namespace {

/// Extinction and glow of a sample, or a mean of them.
using Classified = std::array<float, 4>;

class ShearedSpace {
public:
    explicit ShearedSpace(const Projector& projector) : projector_(projector), way_(projector.ray_of(0, 0).direction) {
        for (int a = 1; a < 3; ++a) {
            if (std::abs(way_[a]) > std::abs(way_[across_])) across_ = a;
        }
        const Index3& size = projector.info.extent.size;
        for (std::size_t side = 0; side < 2; ++side) {
            const int axis = axis_of(side);
            slope_[side] = way_[axis] / way_[across_];
            const double shift = -slope_[side] * static_cast<double>(size[across_] - 1);  // of the last slice
            low_[side] = std::floor(std::min(0.0, shift)) - 1;                            // a margin, in which slices fade
            count_[side] = size[axis] + static_cast<std::int64_t>(std::ceil(std::max(0.0, shift)) - low_[side]) + 1;
        }
        sheared_.resize(count_[0] * count_[1]);
    }

    /// Shears and composites all slices. Returns how many values were resampled.
    std::int64_t composite() {
        const std::int64_t slices = projector_.info.extent.size[across_];
        std::int64_t resampled = 0;
        for (std::int64_t k = 0; k < slices; ++k) {
            stop_if_cancelled(projector_.context);
            resampled += add_slice(way_[across_] > 0 ? k : slices - 1 - k);
        }
        return resampled;
    }

    /// The picture of the sheared space where a ray meets slice 0, between its four nearest pixels.
    [[nodiscard]] std::array<float, 4> seen(const Ray& ray) const {
        const double t = -ray.origin[across_] / way_[across_];
        std::array<float, 4> sum{};
        std::array<double, 2> at;
        for (std::size_t side = 0; side < 2; ++side) at[side] = ray.origin[axis_of(side)] + t * way_[axis_of(side)] - low_[side];
        const double u = std::floor(at[0]), v = std::floor(at[1]);
        for (int corner = 0; corner < 4; ++corner) {
            const double x = u + (corner & 1), y = v + (corner >> 1);
            if (x < 0 || y < 0 || x >= static_cast<double>(count_[0]) || y >= static_cast<double>(count_[1])) continue;
            const double weight = (1 - std::abs(at[0] - x)) * (1 - std::abs(at[1] - y));
            const auto& pixel = sheared_[static_cast<std::int64_t>(x) + count_[0] * static_cast<std::int64_t>(y)];
            for (std::size_t c = 0; c < 4; ++c) sum[c] += static_cast<float>(weight) * pixel[c];
        }
        return sum;
    }

private:
    [[nodiscard]] int axis_of(std::size_t side) const { return (across_ + 1 + static_cast<int>(side)) % 3; }

    /// Samples of a slice become matter before they are resampled, with a border of nothing.
    void classify(std::int64_t k) {
        const Index3& size = projector_.info.extent.size;
        const int first = axis_of(0), second = axis_of(1);
        row_ = size[first] + 2;
        slice_.assign(row_ * (size[second] + 2), {});
        Index3 at{};
        at[across_] = k;
        for (at[second] = 0; at[second] < size[second]; ++at[second]) {
            for (at[first] = 0; at[first] < size[first]; ++at[first]) {
                const OpticalProperties matter = projector_.matter(projector_.values[projector_.info.extent.index(at[0], at[1], at[2])]);
                slice_[at[first] + 1 + row_ * (at[second] + 1)] = {static_cast<float>(matter.glow[0]), static_cast<float>(matter.glow[1]),
                                                                   static_cast<float>(matter.glow[2]),
                                                                   static_cast<float>(matter.extinction)};
            }
        }
    }

    std::int64_t add_slice(std::int64_t k) {
        classify(k);
        // Pixel (u, v) lies between samples whose first is (u + shift, v + shift), for all pixels of a slice with the same four weights.
        std::array<std::int64_t, 2> shift;
        std::array<float, 2> part;
        for (std::size_t side = 0; side < 2; ++side) {
            const double place = low_[side] + slope_[side] * static_cast<double>(k), whole = std::floor(place);
            shift[side] = static_cast<std::int64_t>(whole) + 1, part[side] = static_cast<float>(place - whole);
        }
        const double length = 1 / std::abs(way_[across_]);  // of a ray between two slices
        const std::int64_t rows = static_cast<std::int64_t>(slice_.size()) / row_;
        std::int64_t resampled = 0;
        for (std::int64_t v = std::max<std::int64_t>(0, -shift[1]); v < std::min(count_[1], rows - 1 - shift[1]); ++v) {
            for (std::int64_t u = std::max<std::int64_t>(0, -shift[0]); u < std::min(count_[0], row_ - 1 - shift[0]); ++u) {
                std::array<float, 4>& pixel = sheared_[u + count_[0] * v];
                if (1 - pixel[3] < kUnseen) continue;
                const Classified matter = between(&slice_[u + shift[0] + row_ * (v + shift[1])], part);
                ++resampled;
                if (!(matter[3] > 0)) continue;
                const auto depth = [&](std::size_t c) { return length * static_cast<double>(matter[c]); };
                put_behind(pixel, depth(3), {depth(0), depth(1), depth(2)});
            }
        }
        return resampled;
    }

    [[nodiscard]] Classified between(const Classified* first, const std::array<float, 2>& part) const {
        Classified found;
        for (std::size_t c = 0; c < 4; ++c) {
            const float above = first[0][c] + part[0] * (first[1][c] - first[0][c]);
            const float below = first[row_][c] + part[0] * (first[row_ + 1][c] - first[row_][c]);
            found[c] = above + part[1] * (below - above);
        }
        return found;
    }

    const Projector& projector_;
    Vec3 way_;                               ///< of rays, in samples a physical unit
    int across_ = 0;                         ///< slices are perpendicular to this axis
    std::array<double, 2> slope_{}, low_{};  ///< shift of rays between two slices; place of pixel 0 in slice 0
    std::array<std::int64_t, 2> count_{};
    std::vector<std::array<float, 4>> sheared_;
    std::int64_t row_ = 0;
    std::vector<Classified> slice_;
};

}  // namespace

void shear_and_warp(const Projector& projector, ProjectedPicture& picture) {
    ShearedSpace space(projector);
    picture.samples = space.composite();
    for (std::int64_t y = 0; y < picture.height; ++y) {
        for (std::int64_t x = 0; x < picture.width; ++x) picture.pixels[x + picture.width * y] = space.seen(projector.ray_of(x, y));
    }
}

}  // namespace isoatlas

// Separable convolution with a sliding window of slices: a slice is filtered along x and y when it enters the window; the slice in the
// middle becomes the weighted sum of the window. Every sum runs in one order, so the bytes do not depend on the threads.
#include "field/gaussian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "isoatlas/environment.h"

namespace isoatlas {
namespace {

constexpr double kReach = 4;  ///< sigmas
constexpr double kMaxSamples = 1000;

/// Weights of the samples 0, 1, ... away on either side.
using Kernel = std::vector<double>;

Kernel kernel_of(double sigma, std::int64_t radius) {
    Kernel kernel(static_cast<std::size_t>(radius) + 1, 1);
    double sum = 1;
    for (std::size_t d = 1; d < kernel.size(); ++d) {
        const double distance = static_cast<double>(d) / sigma;
        kernel[d] = std::exp(-distance * distance / 2);
        sum += 2 * kernel[d];
    }
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

/// out[i] = sum of kernel[d] * row(at +- d)[i]; beyond the ends the last of `count` rows is repeated. row(r): numbers of row r.
template <class Row>
void add_rows(const Kernel& kernel, std::int64_t at, std::int64_t count, const Row& row, std::span<double> out) {
    const auto* middle = row(at);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = kernel[0] * static_cast<double>(middle[i]);
    for (std::int64_t d = 1; d < static_cast<std::int64_t>(kernel.size()); ++d) {
        const auto *before = row(std::max<std::int64_t>(at - d, 0)), *behind = row(std::min(at + d, count - 1));
        const double weight = kernel[static_cast<std::size_t>(d)];
        for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * (static_cast<double>(before[i]) + static_cast<double>(behind[i]));
    }
}

/// The same along one row.
void add_along(const Kernel& kernel, std::span<const double> row, std::span<double> out) {
    const auto count = static_cast<std::int64_t>(row.size());
    for (std::int64_t x = 0; x < count; ++x)
        add_rows(kernel, x, count, [&](std::int64_t i) { return row.data() + i; }, out.subspan(static_cast<std::size_t>(x), 1));
}

/// A weighted mean lies between the samples it is made of, up to rounding.
template <class T>
T sample_of(double mean) {
    if constexpr (std::is_floating_point_v<T>) {
        return static_cast<T>(mean);
    } else {
        constexpr double kLowest = std::numeric_limits<T>::min(), kHighest = std::numeric_limits<T>::max();
        return static_cast<T>(std::clamp(std::nearbyint(mean), kLowest, kHighest));
    }
}

template <class T>
class Filter {
public:
    Filter(const Extent& extent, const std::array<Kernel, 3>& kernels, T* samples, int threads)
        : extent_(extent), kernels_(kernels), samples_(samples), threads_(threads), window_(2 * kernels[2].size() - 1) {}

    /// Calls done(slices) after each slice.
    template <class Done>
    void run(const Done& done) {
        const auto radius = static_cast<std::int64_t>(kernels_[2].size()) - 1;
        std::int64_t next = 0;
        for (std::int64_t z = 0; z < extent_.size[2]; ++z) {
            for (; next < std::min(z + radius + 1, extent_.size[2]); ++next) filter_slice(next);
            for_rows([&](std::int64_t y, std::span<double> row) {
                const std::int64_t first = y * extent_.size[0];
                add_rows(kernels_[2], z, extent_.size[2], [&](std::int64_t slice) { return kept(slice).data() + first; }, row);
                std::transform(row.begin(), row.end(), samples_ + z * extent_.slice() + first, sample_of<T>);
            });
            done(z + 1);
        }
    }

private:
    [[nodiscard]] std::vector<double>& kept(std::int64_t slice) { return window_[static_cast<std::size_t>(slice) % window_.size()]; }

    /// Along y, then along x.
    void filter_slice(std::int64_t z) {
        const std::int64_t nx = extent_.size[0];
        const T* slice = samples_ + z * extent_.slice();
        std::vector<double>& out = kept(z);
        out.resize(static_cast<std::size_t>(extent_.slice()));
        for_rows([&](std::int64_t y, std::span<double> row) {
            add_rows(kernels_[1], y, extent_.size[1], [&](std::int64_t i) { return slice + i * nx; }, row);
            add_along(kernels_[0], row, std::span(out).subspan(static_cast<std::size_t>(y * nx), row.size()));
        });
    }

    /// Calls work(y, room for a row) for all rows of a slice.
    template <class Work>
    void for_rows(const Work& work) const {
        constexpr std::int64_t kRows = 32;
        for_each_block(threads_, (extent_.size[1] + kRows - 1) / kRows, [&](std::int64_t block) {
            std::vector<double> row(static_cast<std::size_t>(extent_.size[0]));
            for (std::int64_t y = block * kRows; y < std::min((block + 1) * kRows, extent_.size[1]); ++y) work(y, row);
        });
    }

    const Extent& extent_;
    const std::array<Kernel, 3>& kernels_;
    T* samples_;
    int threads_;
    std::vector<std::vector<double>> window_;  ///< slices filtered along x and y, the last ones that came into reach
};

void check(const VolumeInfo& info, double sigma) {
    const Geometry& geometry = info.geometry;
    if (std::ranges::any_of(geometry.coordinates, [](const auto& axis) { return axis.size() > 1; })) {
        throw Error(ErrorKind::usage, {.file = info.path,
                                       .what = "the samples are not equally spaced, so a Gaussian has no fixed weights",
                                       .expected = "a volume with a spacing, not with coordinates",
                                       .next = "resample it to equal spacing first, or take its samples as equally spaced",
                                       .reason = Reason::unequal_spacing});
    }
    double finest = geometry.spacing[0];
    for (int axis = 1; axis < info.extent.rank; ++axis) finest = std::min(finest, geometry.spacing[static_cast<std::size_t>(axis)]);
    if (!(sigma > 0) || !(sigma <= kMaxSamples * finest)) {
        throw Error(ErrorKind::usage, {.file = info.path,
                                       .what = "the sigma of a Gaussian cannot be " + std::to_string(sigma),
                                       .expected = "above 0 and at most 1000 samples: " + std::to_string(kMaxSamples * finest),
                                       .next = "give sigma in the unit of the spacing"});
    }
}

}  // namespace

Index3 gaussian_radius(const VolumeInfo& info, double sigma) {
    check(info, sigma);
    Index3 radius{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_flat = info.extent.size[axis] == 1;
        radius[axis] = is_flat ? 0 : static_cast<std::int64_t>(std::floor(kReach * sigma / info.geometry.spacing[axis] + 0.5));
    }
    return radius;
}

void filter_in_place(VolumeInfo& info, std::byte* samples, double sigma, const Context& context) {
    const Index3 radius = gaussian_radius(info, sigma);
    std::array<Kernel, 3> kernels;
    for (std::size_t axis = 0; axis < 3; ++axis) kernels[axis] = kernel_of(sigma / info.geometry.spacing[axis], radius[axis]);
    visit_type(info.type, [&]<class T>(T) {
        Filter<T>(info.extent, kernels, reinterpret_cast<T*>(samples), context.threads).run([&](std::int64_t) {
            stop_if_cancelled(context);
        });
    });
    info.gaussian = std::hypot(info.gaussian, sigma);
}

Volume gaussian_filter(const Volume& volume, double sigma, const Context& context) {
    const EnvironmentScope scope(context);
    Volume result = volume;
    filter_in_place(result.info, result.bytes.data(), sigma, context);
    return result;
}

Volume gaussian_filter(const Volume& volume, const SampleBox& box, double sigma, const Context& context) {
    const EnvironmentScope scope(context);
    const Extent& extent = volume.info.extent;
    const Index3 radius = gaussian_radius(volume.info, sigma);
    Volume part = crop(volume, box);
    const SampleBox wide{max(box.begin - radius, Index3{}), min(box.end + radius, extent.size)};
    const SampleBox inside{box.begin - wide.begin, box.end - wide.begin};
    Volume around = crop(volume, wide);
    filter_in_place(around.info, around.bytes.data(), sigma, context);
    part.bytes = crop(around, inside).bytes;
    part.info.gaussian = around.info.gaussian;
    return part;
}

}  // namespace isoatlas

// Slab by slab: every slice is filtered along x and y when it first comes into reach of the slab, then weighted sums of slices are taken.
// Sums run in one order, so a sample does not depend on the slab in which it is made.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "base/parallel.h"
#include "field/grid.h"
#include "isoatlas/filter.h"

namespace isoatlas {
namespace {

constexpr double kReach = 4;  ///< sigmas
constexpr double kMostSamples = 1000;

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

/// sample(i) for i in [0, count), weighted around `at`; beyond the ends the last one goes on.
template <class Sample>
double weighted(const Kernel& kernel, std::int64_t at, std::int64_t count, const Sample& sample) {
    double sum = kernel[0] * sample(at);
    for (std::int64_t d = 1; d < static_cast<std::int64_t>(kernel.size()); ++d)
        sum += kernel[static_cast<std::size_t>(d)] * (sample(std::max<std::int64_t>(at - d, 0)) + sample(std::min(at + d, count - 1)));
    return sum;
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
void filter_slice(const T* samples, const Extent& extent, const std::array<Kernel, 3>& kernels, std::vector<double>& row,
                  std::span<double> out) {
    const std::int64_t nx = extent.size[0], ny = extent.size[1];
    for (std::int64_t x = 0; x < nx; ++x) {
        for (std::int64_t y = 0; y < ny; ++y)
            row[static_cast<std::size_t>(y)] =
                weighted(kernels[1], y, ny, [&](std::int64_t i) { return static_cast<double>(samples[x + nx * i]); });
        for (std::int64_t y = 0; y < ny; ++y) out[static_cast<std::size_t>(x + nx * y)] = row[static_cast<std::size_t>(y)];
    }
    for (std::int64_t y = 0; y < ny; ++y) {
        const std::span<double> line = out.subspan(static_cast<std::size_t>(nx * y), static_cast<std::size_t>(nx));
        std::ranges::copy(line, row.begin());
        for (std::int64_t x = 0; x < nx; ++x)
            line[static_cast<std::size_t>(x)] =
                weighted(kernels[0], x, nx, [&](std::int64_t i) { return row[static_cast<std::size_t>(i)]; });
    }
}

/// Slices [slab.z_begin, slab.z_end) of the result; looks at as many slices around them as the last kernel reaches.
template <class T>
void filter_slab(const GridView<T>& grid, const std::array<Kernel, 3>& kernels, const Slab& slab, T* out) {
    const Extent& extent = grid.extent;
    const std::int64_t radius = static_cast<std::int64_t>(kernels[2].size()) - 1, slices = extent.size[2];
    const std::int64_t begin = std::max<std::int64_t>(slab.z_begin - radius, 0), end = std::min(slab.z_end + radius, slices);
    const auto size = static_cast<std::size_t>(extent.slice());
    std::vector<double> row(static_cast<std::size_t>(std::max(extent.size[0], extent.size[1])));
    std::vector<std::vector<double>> flat(static_cast<std::size_t>(end - begin));
    std::int64_t next = begin;
    for (std::int64_t z = slab.z_begin; z < slab.z_end; ++z) {
        for (; next < std::min(z + radius + 1, end); ++next) {
            std::vector<double>& slice = flat[static_cast<std::size_t>(next - begin)];
            slice.resize(size);
            filter_slice(grid.slice(next), extent, kernels, row, slice);
        }
        for (std::size_t i = 0; i < size; ++i)
            *out++ =
                sample_of<T>(weighted(kernels[2], z, slices, [&](std::int64_t s) { return flat[static_cast<std::size_t>(s - begin)][i]; }));
        if (z - radius >= begin) std::vector<double>().swap(flat[static_cast<std::size_t>(z - radius - begin)]);
    }
}

void check(const VolumeInfo& info, double sigma) {
    const Geometry& geometry = info.geometry;
    if (std::ranges::any_of(geometry.coordinates, [](const auto& axis) { return axis.size() > 1; })) {
        throw Error(ErrorKind::usage, {.file = info.path,
                                       .what = "the samples are not equally spaced, so a Gaussian has no fixed weights",
                                       .expected = "a volume with a spacing, not with coordinates",
                                       .next = "resample it to equal spacing first, or take the grid as it is with --voxel"});
    }
    double finest = geometry.spacing[0];
    for (int axis = 1; axis < info.extent.rank; ++axis) finest = std::min(finest, geometry.spacing[static_cast<std::size_t>(axis)]);
    if (!(sigma > 0) || !(sigma <= kMostSamples * finest)) {
        throw Error(ErrorKind::usage, {.file = info.path,
                                       .what = "the sigma of a Gaussian cannot be " + std::to_string(sigma),
                                       .expected = "above 0 and at most 1000 samples: " + std::to_string(kMostSamples * finest),
                                       .next = "give sigma in the unit of the spacing"});
    }
}

template <class T>
void filter_all(const Volume& volume, const std::array<Kernel, 3>& kernels, const Context& context, std::span<T> out) {
    const GridView<T> grid{volume.samples<T>().data(), volume.info.extent};
    const std::int64_t slices = grid.extent.size[2], radius = static_cast<std::int64_t>(kernels[2].size()) - 1;
    const std::int64_t height = context.slab_slices > 0 ? context.slab_slices : std::max<std::int64_t>(4 * radius, 16);
    const std::int64_t slabs = (slices + height - 1) / height;
    std::atomic<bool> cancelled = false;
    for_each_block(context.threads, slabs, [&](std::int64_t i) {
        if (cancelled) return;
        const Slab slab = slab_at(i, height, slices);
        filter_slab(grid, kernels, slab, out.data() + slab.z_begin * grid.extent.slice());
        if (context.cancelled && context.cancelled()) cancelled = true;
    });
    if (cancelled) throw Error(ErrorKind::cancelled, {.what = "cancelled"});
}

}  // namespace

std::array<std::int64_t, 3> gaussian_radius(const VolumeInfo& info, double sigma) {
    check(info, sigma);
    std::array<std::int64_t, 3> radius{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_flat = info.extent.size[axis] == 1;
        radius[axis] = is_flat ? 0 : static_cast<std::int64_t>(std::floor(kReach * sigma / info.geometry.spacing[axis] + 0.5));
    }
    return radius;
}

Volume gaussian_filter(const Volume& volume, double sigma, const Context& context) {
    const std::array<std::int64_t, 3> radius = gaussian_radius(volume.info, sigma);
    std::array<Kernel, 3> kernels;
    for (std::size_t axis = 0; axis < 3; ++axis) kernels[axis] = kernel_of(sigma / volume.info.geometry.spacing[axis], radius[axis]);
    Volume result = make_volume(volume.info.extent, volume.info.type);
    result.info = volume.info;
    result.info.gaussian = std::hypot(volume.info.gaussian, sigma);
    visit_type(volume.info.type, [&]<class T>(T) { filter_all<T>(volume, kernels, context, result.samples<T>()); });
    return result;
}

Volume gaussian_filter(const Volume& volume, const SampleBox& box, double sigma, const Context& context) {
    const Extent& extent = volume.info.extent;
    const std::array<std::int64_t, 3> radius = gaussian_radius(volume.info, sigma);
    SampleBox wide = box, inside{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (box.begin[axis] < 0 || box.end[axis] > extent.size[axis] || box.begin[axis] >= box.end[axis])
            return crop(volume, box);  // throws
        wide.begin[axis] = std::max<std::int64_t>(box.begin[axis] - radius[axis], 0);
        wide.end[axis] = std::min(box.end[axis] + radius[axis], extent.size[axis]);
        inside.begin[axis] = box.begin[axis] - wide.begin[axis];
        inside.end[axis] = box.end[axis] - wide.begin[axis];
    }
    Volume part = crop(gaussian_filter(crop(volume, wide), sigma, context), inside);
    part.info.geometry = crop(volume, box).info.geometry;
    return part;
}

}  // namespace isoatlas

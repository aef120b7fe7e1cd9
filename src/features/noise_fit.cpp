#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/streamed.h"
#include "features/noise.h"
#include "field/sample_range.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kWindows = 125'000;
constexpr std::size_t kMin = 200;    // neighbourhoods of a group
constexpr double kQuantile = 0.3;    // of the regression
constexpr double kWorthwhile = 0.5;  // a slope must leave at most this part of the loss

/// A neighbourhood of 3 samples along each axis.
struct Window {
    double mean;
    double variance;  ///< around the plane that fits best
    double mask;      ///< |second difference along all axes at once|, in standard deviations of white noise: edges along an axis leave none
};

template <class T>
Window window_at(std::span<const T> samples, const Extent& extent, const Index3& p) {
    const std::int64_t deep = extent.rank == 3 ? 1 : 0;
    const double count = deep == 1 ? 27 : 9, squares_of_axis = deep == 1 ? 18 : 6;
    const auto centre = static_cast<double>(samples[extent.index(p[0], p[1], p[2])]);
    constexpr std::array<double, 3> kSecond{1, -2, 1};
    double sum = 0, squares = 0, mask = 0;
    std::array<double, 3> along{};
    for (std::int64_t z = -deep; z <= deep; ++z) {
        for (std::int64_t y = -1; y <= 1; ++y) {
            for (std::int64_t x = -1; x <= 1; ++x) {
                const double f = static_cast<double>(samples[extent.index(p[0] + x, p[1] + y, p[2] + z)]) - centre;
                sum += f, squares += f * f;
                mask += kSecond[x + 1] * kSecond[y + 1] * (deep == 1 ? kSecond[z + 1] : 1) * f;
                along[0] += static_cast<double>(x) * f, along[1] += static_cast<double>(y) * f, along[2] += static_cast<double>(z) * f;
            }
        }
    }
    const double explained = (along[0] * along[0] + along[1] * along[1] + along[2] * along[2]) / squares_of_axis;
    const double rest = squares - sum * sum / count - explained;
    const double free = count - 1 - static_cast<double>(extent.rank);  // degrees of freedom
    return {centre + sum / count, std::max(0.0, rest) / free, std::abs(mask) / std::sqrt(std::pow(6, extent.rank))};
}

/// On a fixed pattern, by ascending mean; not those that are constant at an end of the range.
template <class T>
std::vector<Window> windows_of(std::span<const T> samples, const Extent& extent) {
    std::vector<Window> windows;
    const auto [low, high] = sample_range(samples);
    const std::int64_t stride = std::max<std::int64_t>(1, extent.voxels() / kWindows) | 1;
    for (const std::size_t k : streamed(count_by(0, extent.voxels(), stride), {3 * bytes_of_stride<T>(stride)})) {  // of three slices
        const std::int64_t i = static_cast<std::int64_t>(k) * stride;
        const Index3 p = extent.voxel(i);
        bool is_inside = true;
        for (int axis = 0; axis < extent.rank; ++axis) is_inside = is_inside && p[axis] > 0 && p[axis] + 1 < extent.size[axis];
        if (!is_inside) continue;
        const Window window = window_at(samples, extent, p);
        if (window.variance > 0 || (samples[i] != low && samples[i] != high)) windows.push_back(window);
    }
    std::ranges::sort(windows, {}, &Window::mean);
    return windows;
}

/// A group of neighbourhoods of similar mean.
struct Group {
    double mean, sigma, weight;
};

/// The quantile of size(window) over some windows.
template <class Size>
double quantile(std::span<const Window> windows, std::size_t one_in, const Size& size) {
    std::vector<double> sizes;
    for (const Window& window : windows) sizes.push_back(size(window));
    const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / one_in);
    std::ranges::nth_element(sizes, place);
    return *place;
}

double sigma_around_planes(std::span<const Window> windows) {
    return std::sqrt(quantile(windows, 5, [](const Window& window) { return window.variance; }));
}
double sigma_of_masks(std::span<const Window> windows) {
    return quantile(windows, 2, [](const Window& window) { return window.mask; }) / 0.6745;
}

/// Each group takes some 30 % of what is left, so that few neighbourhoods of high values have groups of their own.
template <class Sigma>
std::vector<Group> groups_of(std::span<const Window> windows, const Sigma& sigma) {
    std::vector<Group> groups;
    while (windows.size() >= kMin) {
        const std::size_t count = windows.size() < 2 * kMin ? windows.size() : std::max(kMin, windows.size() * 3 / 10);
        const std::span<const Window> part = windows.first(count);
        groups.push_back({part[count / 2].mean, sigma(part), static_cast<double>(count)});
        windows = windows.subspan(count);
    }
    std::erase_if(groups, [](const Group& group) { return group.sigma == 0; });
    return groups;
}

double loss_of(const NoiseModel& line, const std::vector<Group>& groups) {
    double loss = 0;
    for (const Group& group : groups) {
        const double above = std::log(group.sigma / line.at(group.mean));
        loss += group.weight * (above > 0 ? kQuantile * above : (kQuantile - 1) * above);
    }
    return loss;
}

/// Quantile regression: a best line goes through two groups, a best constant through one. Slope 0: a constant will do.
NoiseModel line_through(const std::vector<Group>& groups) {
    if (groups.size() < 3) return {};
    NoiseModel flat, steep;
    double flat_loss = std::numeric_limits<double>::infinity(), steep_loss = flat_loss;
    const double low = groups.front().mean, high = groups.back().mean;
    const auto offer = [&](double base, double slope) {
        const NoiseModel line{0, base, slope, low, high};
        const double loss = base > 0 || slope > 0 ? loss_of(line, groups) : std::numeric_limits<double>::infinity();
        NoiseModel& best = slope == 0 ? flat : steep;
        double& min = slope == 0 ? flat_loss : steep_loss;
        if (loss < min) best = line, min = loss;
    };
    for (std::size_t i = 0; i < groups.size(); ++i) {
        offer(groups[i].sigma, 0);
        for (std::size_t j = i + 1; j < groups.size(); ++j) {
            const double width = groups[j].mean - groups[i].mean;
            const double slope = width > 0 ? (groups[j].sigma - groups[i].sigma) / width : 0;
            const double base = groups[i].sigma - slope * (groups[i].mean - low);
            if (slope > 0 && base > 0) offer(base, slope);
        }
    }
    return steep_loss <= kWorthwhile * flat_loss ? steep : NoiseModel{};
}

}  // namespace

NoiseModel fit_noise(const VolumeView& volume) {
    const std::vector<Window> windows = visit_samples(volume, [&](auto samples) { return windows_of(samples, volume.info->extent); });
    NoiseModel model = line_through(groups_of(windows, sigma_around_planes));
    // Structure that grows with the value is not noise: noise shows in the finest differences too.
    if (line_through(groups_of(windows, sigma_of_masks)).slope == 0) model = {};
    model.sigma = estimate_noise(volume);
    return model;
}

double finest_noise(const VolumeView& volume) {
    const std::vector<Window> windows = visit_samples(volume, [&](auto samples) { return windows_of(samples, volume.info->extent); });
    return windows.empty() ? 0 : sigma_of_masks(windows);
}

}  // namespace isoatlas

#include "image/quantise.h"

#include <algorithm>
#include <cmath>

namespace isoatlas {
namespace {

constexpr int kBits = 5, kShift = 8 - kBits, kBins = 1 << (3 * kBits);
constexpr std::size_t kColours = 255;

int bin_of(int r, int g, int b) { return (r >> kShift) << (2 * kBits) | (g >> kShift) << kBits | b >> kShift; }

struct Bin {
    double count = 0;
    std::array<double, 3> sum{};
};

struct Box {
    std::vector<int> bins;
    std::array<double, 3> mean{};
    int axis = 0;
    double error = 0;  ///< sum of squares along the axis in which it is largest
};

double middle(const Bin& bin, int c) { return bin.sum[c] / bin.count; }

void measure(Box& box, const std::vector<Bin>& bins) {
    double count = 0;
    std::array<double, 3> sum{}, squares{};
    for (const int i : box.bins) {
        count += bins[i].count;
        for (int c = 0; c < 3; ++c) {
            sum[c] += bins[i].sum[c];
            squares[c] += bins[i].count * middle(bins[i], c) * middle(bins[i], c);
        }
    }
    box.error = -1;
    for (int c = 0; c < 3; ++c) {
        box.mean[c] = sum[c] / count;
        const double error = squares[c] - sum[c] * box.mean[c];
        if (error > box.error) box.error = error, box.axis = c;
    }
    if (box.bins.size() < 2) box.error = 0;
}

std::vector<Bin> histogram(std::span<const Image> frames) {
    std::vector<Bin> bins(kBins);
    for (const Image& frame : frames) {
        for (std::size_t i = 0; i < frame.rgba.size(); i += 4) {
            const std::uint8_t* p = &frame.rgba[i];
            Bin& bin = bins[bin_of(p[0], p[1], p[2])];
            bin.count += 1;
            for (int c = 0; c < 3; ++c) bin.sum[c] += p[c];
        }
    }
    return bins;
}

std::vector<Box> cut_boxes(const std::vector<Bin>& bins) {
    std::vector<Box> boxes(1);
    for (int i = 0; i < kBins; ++i) {
        if (bins[i].count > 0) boxes[0].bins.push_back(i);
    }
    measure(boxes[0], bins);
    while (boxes.size() < kColours) {
        const auto worst = std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.error < b.error; });
        if (!(worst->error > 1e-6)) break;
        const int axis = worst->axis;
        const double at = worst->mean[axis];
        Box upper;
        const auto above =
            std::stable_partition(worst->bins.begin(), worst->bins.end(), [&](int i) { return middle(bins[i], axis) <= at; });
        upper.bins.assign(above, worst->bins.end());
        worst->bins.erase(above, worst->bins.end());
        if (upper.bins.empty() || worst->bins.empty()) {  // all at the mean, except for rounding
            worst->bins.insert(worst->bins.end(), upper.bins.begin(), upper.bins.end());
            worst->error = 0;
            continue;
        }
        measure(*worst, bins);
        measure(upper, bins);
        boxes.push_back(std::move(upper));
    }
    return boxes;
}

/// Bayer's 8 x 8 matrix: 0 .. 63.
int threshold(std::int64_t x, std::int64_t y) {
    int value = 0;
    for (int bit = 0; bit < 3; ++bit) {
        const int u = static_cast<int>(x >> bit & 1), v = static_cast<int>(y >> bit & 1);
        value = value << 2 | (u ^ v) << 1 | v;
    }
    return value;
}

}  // namespace

Quantiser::Quantiser(std::span<const Image> frames) {
    const std::vector<Bin> bins = histogram(frames);
    double error = 0, count = 0;
    for (const Box& box : cut_boxes(bins)) {
        std::array<std::uint8_t, 3> colour{};
        for (int c = 0; c < 3; ++c) colour[c] = static_cast<std::uint8_t>(std::lround(box.mean[c]));
        colours_.push_back(colour);
        error += box.error;
    }
    for (const Bin& bin : bins) count += bin.count;
    spread_ = std::min(16.0, 2.5 * std::sqrt(error / std::max(1.0, count)));
    nearest_.resize(kBins);
    for (int i = 0; i < kBins; ++i) {
        const int half = 1 << (kShift - 1);
        const int colour[3] = {(i >> (2 * kBits)) << kShift | half, (i >> kBits & 31) << kShift | half, (i & 31) << kShift | half};
        long best = -1;
        for (std::size_t k = 0; k < colours_.size(); ++k) {
            long distance = 0;
            for (int c = 0; c < 3; ++c) distance += static_cast<long>(colour[c] - colours_[k][c]) * (colour[c] - colours_[k][c]);
            if (best < 0 || distance < best) best = distance, nearest_[i] = static_cast<std::uint8_t>(k);
        }
    }
}

std::uint8_t Quantiser::index(const std::uint8_t* pixel, std::int64_t x, std::int64_t y) const {
    const auto shift = static_cast<int>(std::lround(spread_ * ((threshold(x, y) + 0.5) / 64 - 0.5)));
    const auto moved = [&](int c) { return std::clamp(pixel[c] + shift, 0, 255); };
    return nearest_[bin_of(moved(0), moved(1), moved(2))];
}

}  // namespace isoatlas

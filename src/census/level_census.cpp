#include "census/level_census.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/sample_types.h"
#include "base/streamed.h"

namespace isoatlas {
namespace {

using Bin = std::uint16_t;  // 0: padding, below every value; else 1 + the last value that is not above the sample
using Counts = CensusPart::Counts;

constexpr std::int64_t kMaxValues = 65535, kMinValues = 256, kVoxelsOfValue = 256;

struct Binning {
    std::span<const double> value;
    double factor;

    explicit Binning(std::span<const double> values)
        : value(values), factor(values.size() < 2 ? 0 : static_cast<double>(values.size() - 1) / (values.back() - values.front())) {}
    [[nodiscard]] Bin operator()(double x) const {
        std::size_t i = std::min(static_cast<std::size_t>((x - value.front()) * factor), value.size() - 1);
        while (i > 0 && x < value[i]) --i;
        while (i + 1 < value.size() && x >= value[i + 1]) ++i;
        return static_cast<Bin>(i + 1);
    }
};

void count_hit(Bin a, Bin b, CensusPart& part) {
    ++part.hits_high[std::max(a, b)];
    ++part.hits_low[std::min(a, b)];
}

/// The bins of a slice with one layer of padding around.
template <class T>
class Slice {
public:
    explicit Slice(const Extent& extent)
        : nx_(extent.size[0]), ny_(extent.size[1]), bins_(static_cast<std::size_t>((nx_ + 2) * (ny_ + 2))) {}
    /// samples: of the slice; null: padding.
    void load(const T* samples, const Binning& bin) {
        if (samples == nullptr) return std::fill(bins_.begin(), bins_.end(), Bin{0});
        for (std::int64_t y = 0; y < ny_; ++y) {
            Bin* row = bins_.data() + (y + 1) * (nx_ + 2) + 1;
            for (std::int64_t x = 0; x < nx_; ++x) row[x] = bin(static_cast<double>(samples[y * nx_ + x]));
        }
    }
    /// y from -1; position 0 is padding.
    [[nodiscard]] const Bin* row(std::int64_t y) const { return bins_.data() + (y + 1) * (nx_ + 2); }

private:
    std::int64_t nx_, ny_;
    std::vector<Bin> bins_;
};

/// What belongs to row y between two slices (3D), or of one slice (2D: above is null): its samples, the hits on its edges, its cells.
template <class T>
void count_row(const Slice<T>& slice, const Slice<T>* above, std::int64_t y, std::int64_t nx, CensusPart& part) {
    const std::array<const Bin*, 2> row{slice.row(y), slice.row(y + 1)};
    const std::array<const Bin*, 2> far = above == nullptr ? row : std::array<const Bin*, 2>{above->row(y), above->row(y + 1)};
    const auto column = [&](std::int64_t p, auto&& choose) { return choose(choose(row[0][p], row[1][p]), choose(far[0][p], far[1][p])); };
    const auto highest = [](Bin a, Bin b) { return std::max(a, b); };
    const auto lowest = [](Bin a, Bin b) { return std::min(a, b); };
    Bin high = column(0, highest), low = column(0, lowest);
    for (std::int64_t p = 0; p <= nx; ++p) {
        count_hit(row[0][p], row[0][p + 1], part);
        const Bin next_high = column(p + 1, highest), next_low = column(p + 1, lowest);
        ++part.cells_high[std::max(high, next_high)];
        ++part.cells_low[std::min(low, next_low)];
        high = next_high, low = next_low;
        if (p == 0) continue;
        ++part.samples[row[0][p]];
        count_hit(row[0][p], row[1][p], part);
        if (above != nullptr) count_hit(row[0][p], far[0][p], part);
    }
}

/// Suffix sums of the bins: number of samples of at least each value.
Counts from_above(const Counts& of_bin) {
    Counts sums(of_bin.begin() + 1, of_bin.end());
    for (std::size_t i = sums.size(); i-- > 1;) sums[i - 1] += sums[i];
    return sums;
}

}  // namespace

std::vector<double> census_values(double low, double high, bool whole, std::int64_t voxels) {
    const std::int64_t max = std::clamp(voxels / kVoxelsOfValue, kMinValues, kMaxValues);
    const double range = high - low;
    std::vector<double> values{low};
    if (std::isfinite(range)) {
        const std::int64_t steps = whole && range < static_cast<double>(max) ? static_cast<std::int64_t>(range) : max - 1;
        for (std::int64_t i = 1; i < steps; ++i) values.push_back(low + static_cast<double>(i) * (range / static_cast<double>(steps)));
    }
    values.push_back(high);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

CensusPart::CensusPart(std::size_t values)
    : samples(values + 1), cells_high(values + 1), cells_low(values + 1), hits_high(values + 1), hits_low(values + 1) {}

void CensusPart::add(const CensusPart& other) {
    const auto add = [](Counts& counts, const Counts& more) {
        for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += more[i];
    };
    add(samples, other.samples);
    add(cells_high, other.cells_high), add(cells_low, other.cells_low);
    add(hits_high, other.hits_high), add(hits_low, other.hits_low);
}

LevelCensus CensusPart::finish(std::vector<double> values) const {
    return {std::move(values),     from_above(samples),   from_above(cells_high),
            from_above(cells_low), from_above(hits_high), from_above(hits_low)};
}

template <class T>
CensusPart count_layers(const T* slab, std::int64_t begin, const Extent& extent, std::span<const double> values, std::int64_t first,
                        std::int64_t last) {
    CensusPart part(values.size());
    const Binning bin(values);
    const auto slice_at = [&](std::int64_t z) { return z < 0 || z >= extent.size[2] ? nullptr : slab + (z - begin) * extent.slice(); };
    Slice<T> slice(extent), above(extent);
    slice.load(slice_at(first), bin);
    for (std::int64_t z = first; z < last; ++z) {
        if (extent.rank == 3) above.load(slice_at(z + 1), bin);
        for (const std::size_t row : streamed(extent.size[1] + 1, {2 * extent.size[0] * sizeof(T)}))
            count_row(slice, extent.rank == 3 ? &above : nullptr, static_cast<std::int64_t>(row) - 1, extent.size[0], part);
        std::swap(slice, above);
    }
    return part;
}

LevelCensus take_census(const VolumeView& volume, const Context& context) {
    return visit_samples(volume, [&]<class T>(std::span<const T> samples) {
        const Extent& extent = volume.info->extent;
        T low = samples[0], high = samples[0];
        const std::size_t width = extent.size[0];
        for (const std::size_t row : streamed(samples.size() / width, {width * sizeof(T)})) {
            const auto [min, max] = std::ranges::minmax(samples.subspan(row * width, width));
            low = std::min(low, min), high = std::max(high, max);
        }
        std::vector<double> values =
            census_values(static_cast<double>(low), static_cast<double>(high), std::is_integral_v<T>, extent.voxels());
        const std::int64_t first = extent.rank == 3 ? -1 : 0, layers = extent.size[2] - first;
        const std::int64_t blocks = std::min<std::int64_t>(layers, 2 * std::int64_t{thread_count(context.threads)});
        std::vector<CensusPart> parts(static_cast<std::size_t>(blocks), CensusPart(0));
        for_each_block(context.threads, blocks, [&](std::int64_t b) {
            parts[static_cast<std::size_t>(b)] =
                count_layers(samples.data(), 0, extent, values, first + b * layers / blocks, first + (b + 1) * layers / blocks);
        });
        CensusPart all(values.size());
        for (const CensusPart& part : parts) all.add(part);
        return all.finish(std::move(values));
    });
}

LevelCensus::Counts LevelCensus::at(double tau, bool whole) const {
    if (whole) tau = std::ceil(tau);
    // What is at least value[after] is at least tau, and what is at least tau is at least value[before].
    const auto after = static_cast<std::size_t>(std::lower_bound(value.begin(), value.end(), tau) - value.begin());
    if (after == value.size()) return {};
    const std::size_t before = value[after] == tau || after == 0 ? after : after - 1;
    const auto bounds = [&](const std::vector<std::uint64_t>& counts) {
        return Bounds{static_cast<std::int64_t>(counts[after]), static_cast<std::int64_t>(counts[before])};
    };
    const auto active = [&](const std::vector<std::uint64_t>& high, const std::vector<std::uint64_t>& low) {
        const Bounds h = bounds(high), l = bounds(low);
        return Bounds{std::max<std::int64_t>(0, h.min - l.max), h.max - l.min};
    };
    return {bounds(samples), active(hits_high, hits_low), active(cells_high, cells_low)};
}

#define ISOATLAS_CENSUS(T) \
    template CensusPart count_layers(const T*, std::int64_t, const Extent&, std::span<const double>, std::int64_t, std::int64_t);
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_CENSUS)
#undef ISOATLAS_CENSUS

}  // namespace isoatlas

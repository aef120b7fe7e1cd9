#include "measures/voxel_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/cancel.h"
#include "base/parallel.h"
#include "field/negate.h"
#include "measures/symmetric_axes.h"
#include "measures/vectors.h"

namespace isoatlas {
namespace {

constexpr std::int64_t kRowsTogether = 64;  // 2D
constexpr std::int64_t kUnitsTogether = 32;

/// Numbers of the slices, or groups of rows, of a part.
struct Units {
    std::int64_t begin, end;
};
Units units_of(const SampleBox& part, int rank) {
    if (rank == 3) return {part.begin[2], part.end[2]};
    return {part.begin[1] / kRowsTogether, (part.end[1] + kRowsTogether - 1) / kRowsTogether};
}

}  // namespace

struct MeasuredVoxels::Part {
    std::unordered_map<std::int32_t, VoxelSums> of;
};

void VoxelSums::add(const VoxelSums& other) {
    if (other.voxels == 0) return;
    const double difference = other.mean - mean, both = weight + other.weight;
    min = voxels == 0 ? other.min : std::min(min, other.min);
    max = voxels == 0 ? other.max : std::max(max, other.max);
    mean += difference * (other.weight / both);
    squares += other.squares + difference * difference * (weight * (other.weight / both));
    sum += other.sum;
    voxels += other.voxels;
    weight += other.weight;
    for (std::size_t i = 0; i < 3; ++i) first[i] += other.first[i];
    for (std::size_t i = 0; i < 6; ++i) second[i] += other.second[i];
}

MeasuredVoxels::MeasuredVoxels(const VolumeInfo& info, const Components& components, std::span<const std::int64_t> voxels,
                               const Index3& origin)
    : info_(info), components_(components), origin_(origin), boxes_(info.geometry, info.extent) {
    const Extent& extent = info.extent;
    object_.assign(static_cast<std::size_t>(components.objects()), voxels.empty() ? 0 : -1);
    for (const std::int64_t voxel : voxels) {
        const Index3 at = extent.voxel(voxel) - origin;
        const RunRow row = components.runs.row(at[1], at[2]);
        const RunId run = row.run_at(at[0] + 1);
        ISOATLAS_CHECK(row.is_high(run));
        object_[static_cast<std::size_t>(components.of_run[run])] = 0;
    }
    for (std::size_t number = 0; number < object_.size(); ++number) {
        if (object_[number] < 0) continue;
        object_[number] = static_cast<std::int32_t>(places_.size());
        const ObjectNumber object(static_cast<std::int32_t>(number));
        const Index3 highest = components.runs.extent.voxel(components.highest[object].number()) + origin;
        places_.push_back({.id = extent.index(highest), .voxels = 0, .box = {extent.size, {0, 0, 0}}});
    }
    find_places();
}

MeasuredVoxels::MeasuredVoxels(const VolumeInfo& info, const Components& components)
    : info_(info), components_(components), origin_{}, boxes_(info.geometry, info.extent) {
    object_.assign(static_cast<std::size_t>(components.objects()), 0);
    places_.push_back({.id = components.highest[ObjectNumber(0)].number(), .voxels = 0, .box = {info.extent.size, {0, 0, 0}}});
    find_places();
}

/// Boxes and middles of the objects.
void MeasuredVoxels::find_places() {
    const Extent& extent = info_.extent;
    const Components& components = components_;
    const Index3& origin = origin_;
    for (std::int64_t r = 0; r < components.runs.rows(); ++r) {
        const RunRow row = components.runs.row(r);
        for (std::int64_t i = 1; i < row.changes; i += 2) {
            const std::int32_t object = object_[static_cast<std::size_t>(components.of_run[row.run(i)])];
            if (object < 0) continue;
            ObjectPlace& place = places_[static_cast<std::size_t>(object)];
            const std::int64_t rows = components.runs.extent.size[1];
            const Index3 low = Index3{row.change[i - 1] - std::int64_t{1}, r % rows, r / rows} + origin;
            const Index3 end{row.change[i] - std::int64_t{1} + origin[0], low[1] + 1, low[2] + 1};
            place.voxels += end[0] - low[0];
            place.box = {min(place.box.begin, low), max(place.box.end, end)};
        }
    }
    box_ = {extent.size, {0, 0, 0}};
    for (const ObjectPlace& place : places_) {
        box_ = {min(box_.begin, place.box.begin), max(box_.end, place.box.end)};
        Vec3& middle = reference_.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::vector<double>& places = boxes_.middle[axis];
            middle[axis] =
                (places[static_cast<std::size_t>(place.box.begin[axis])] + places[static_cast<std::size_t>(place.box.end[axis] - 1)]) / 2;
        }
    }
    sums_.resize(places_.size());
}

/// Voxels begin[0] .. end - 1 of a row; row[0]: the first of them. Sums are of the values of the file: negated ones of 32 bits are so far
/// from 0 that sums of them would lose digits.
template <class T>
void MeasuredVoxels::add_run(const T* row, const Index3& begin, std::int64_t end, const Vec3& reference, VoxelSums& sums) const {
    VoxelSums run;
    const auto count = static_cast<std::size_t>(end - begin[0]), first = static_cast<std::size_t>(begin[0]);
    const double *middle = boxes_.middle[0].data() + first, *width = boxes_.width[0].data() + first;
    const bool is_low = info_.calibration.mirror.has_value();
    const auto value_at = [&](std::size_t i) { return static_cast<double>(is_low ? negated_sample(row[i]) : row[i]); };
    double w = 0, wx = 0, wxx = 0, wv = 0, sum = 0, low = value_at(0), high = low;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = middle[i] - reference[0], value = value_at(i);
        w += width[i];
        wx += width[i] * x;
        wxx += width[i] * (x * x + width[i] * width[i] / 12);
        wv += width[i] * value;
        sum += value;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    run.voxels = end - begin[0];
    run.sum = sum, run.min = low, run.max = high;
    run.mean = std::clamp(wv / w, low, high);
    for (std::size_t i = 0; i < count; ++i) {
        const double difference = value_at(i) - run.mean;
        run.squares += width[i] * (difference * difference);
    }
    const bool flat = info_.extent.rank == 2;
    const auto iy = static_cast<std::size_t>(begin[1]), iz = static_cast<std::size_t>(begin[2]);
    const double y = boxes_.middle[1][iy] - reference[1], z = flat ? 0 : boxes_.middle[2][iz] - reference[2];
    const double width_y = boxes_.width[1][iy], width_z = boxes_.width[2][iz], across = width_y * (flat ? 1 : width_z);
    w *= across, wx *= across, wxx *= across, run.squares *= across;
    run.weight = w;
    run.first = {wx, w * y, w * z};
    run.second = {wxx, w * (y * y + width_y * width_y / 12), w * (z * z + width_z * width_z / 12), wx * y, wx * z, w * y * z};
    sums.add(run);
}

template <class T>
void MeasuredVoxels::add_unit(const T* samples, const SampleBox& part, std::int64_t unit, Part& sums) const {
    const bool flat = info_.extent.rank == 2;
    const std::int64_t z = flat ? 0 : unit;
    const std::int64_t y_begin = flat ? std::max(part.begin[1], unit * kRowsTogether) : std::max(part.begin[1], box_.begin[1]);
    const std::int64_t y_end = flat ? std::min(part.end[1], (unit + 1) * kRowsTogether) : std::min(part.end[1], box_.end[1]);
    const Index3 size = part.size();
    for (std::int64_t y = y_begin; y < y_end; ++y) {
        const T* row_samples = samples + size[0] * (y - part.begin[1] + size[1] * (z - part.begin[2]));
        const RunRow row = components_.runs.row(y - origin_[1], z - origin_[2]);
        for (std::int64_t i = 1; i < row.changes; i += 2) {
            const std::int32_t object = object_[static_cast<std::size_t>(components_.of_run[row.run(i)])];
            if (object < 0) continue;
            const Index3 begin{row.change[i - 1] - std::int64_t{1} + origin_[0], y, z};
            const std::int64_t end = row.change[i] - std::int64_t{1} + origin_[0];
            add_run(row_samples + (begin[0] - part.begin[0]), begin, end, reference_[static_cast<std::size_t>(object)], sums.of[object]);
        }
    }
}

void MeasuredVoxels::add(std::span<const std::byte> samples, const SampleBox& part, const Context& context) {
    const Units units = units_of({max(part.begin, box_.begin), min(part.end, box_.end)}, info_.extent.rank);
    for (std::int64_t first = units.begin; first < units.end; first += kUnitsTogether) {
        stop_if_cancelled(context);
        std::vector<Part> parts(static_cast<std::size_t>(std::min(kUnitsTogether, units.end - first)));
        for_each_block(context.threads, std::ssize(parts), [&](std::int64_t block) {
            visit_type(info_.type, [&]<class T>(T) {
                add_unit(reinterpret_cast<const T*>(samples.data()), part, first + block, parts[static_cast<std::size_t>(block)]);
            });
        });
        for (const Part& each : parts) {
            for (const auto& [object, sums] : each.of) sums_[static_cast<std::size_t>(object)].add(sums);
        }
    }
}

void MeasuredVoxels::describe(std::size_t object, ObjectMeasures& measures) const {
    const VoxelSums& sums = sums_[object];
    const ObjectPlace& place = places_[object];
    const bool flat = info_.extent.rank == 2;
    ISOATLAS_CHECK(sums.voxels == place.voxels);
    const auto count = static_cast<double>(sums.voxels);
    Calibration calibration = info_.calibration;
    calibration.mirror.reset();  // sums are of the values of the file
    measures.id = place.id;
    measures.voxels = sums.voxels;
    measures.voxel_volume = sums.weight * boxes_.skew;
    const double low = calibration.reported(sums.min), high = calibration.reported(sums.max);
    measures.values = {.mean = calibration.reported(std::clamp(sums.mean, sums.min, sums.max)),
                       .min = std::min(low, high),
                       .max = std::max(low, high),
                       .sum = calibration.slope * sums.sum + calibration.intercept * count,
                       .deviation = calibration.reported_difference(std::sqrt(sums.squares / sums.weight))};
    const Vec3 mean = times(1 / sums.weight, sums.first);
    measures.centroid = plus(boxes_.origin, times(boxes_.direction, plus(reference_[object], mean)));
    const auto central = [&](std::size_t k, std::size_t i, std::size_t j) { return sums.second[k] / sums.weight - mean[i] * mean[j]; };
    const double xy = central(3, 0, 1), xz = central(4, 0, 2), yz = central(5, 1, 2);
    const Mat3 grid{{{central(0, 0, 0), xy, xz}, {xy, central(1, 1, 1), yz}, {xz, yz, central(2, 2, 2)}}};
    const Mat3& d = boxes_.direction;
    Mat3 space{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) space[i][j] = dot(d[i], times(grid, d[j]));
    }
    const SymmetricAxes axes = symmetric_axes(space);
    measures.axes.direction = axes.direction;
    for (std::size_t i = 0; i < 3; ++i) {
        const double variance = std::max(axes.value[i], 0.0);
        measures.axes.length[i] = flat ? 4 * std::sqrt(variance) : 2 * std::sqrt(5 * variance);
    }
    if (flat) measures.axes.length[2] = 0;
    measures.touches_border = false;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(info_.extent.rank); ++axis) {
        if (place.box.begin[axis] == 0 || place.box.end[axis] == info_.extent.size[axis]) measures.touches_border = true;
    }
}

}  // namespace isoatlas

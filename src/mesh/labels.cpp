#include "isoatlas/labels.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include "base/cancel.h"
#include "base/phase.h"
#include "base/streamed.h"
#include "isoatlas/cut.h"
#include "isoatlas/environment.h"
#include "mesh/label_mask.h"

namespace isoatlas {
namespace {

[[noreturn]] void not_labels(const VolumeInfo& info, std::int64_t index, double value) {
    const Index3 voxel = info.extent.voxel(index);
    throw Error(ErrorKind::input,
                {.file = info.path,
                 .where = "voxel (" + std::to_string(voxel[0]) + ", " + std::to_string(voxel[1]) + ", " + std::to_string(voxel[2]) + ")",
                 .what = "the sample " + std::to_string(value) + " is not a label",
                 .expected = "whole numbers of at least 0",
                 .next = "take the samples as values"});
}

[[noreturn]] void too_many(const VolumeInfo& info, std::int64_t most) {
    throw Error(ErrorKind::input, {.file = info.path,
                                   .what = "there are more than " + std::to_string(most) + " different labels",
                                   .expected = "a label volume",
                                   .next = "take the samples as values"});
}

/// Counts, bounds and sums of places of the labels, by runs along x.
class Regions {
public:
    Regions(const Volume& volume, std::int64_t most) : volume_(volume), most_(most) {}

    void look(const Context& context) {
        visit_samples(volume_, [&]<class T>(std::span<const T> samples) {
            const Extent& extent = volume_.info.extent;
            const auto rows = static_cast<std::size_t>(extent.size[1] * extent.size[2]), length = static_cast<std::size_t>(extent.size[0]);
            for (const std::size_t row : streamed(rows, StepBytes{length * sizeof(T)})) {
                if (row % 1024 == 0) stop_if_cancelled(context);
                look_at_row(samples.subspan(row * length, length), static_cast<std::int64_t>(row * length));
            }
        });
    }

    std::vector<LabelRegion> take() {
        std::ranges::sort(regions_, {}, &LabelRegion::label);
        for (LabelRegion& region : regions_) {
            for (double& place : region.position) place /= static_cast<double>(region.voxels);
        }
        return std::move(regions_);
    }

private:
    template <class T>
    void look_at_row(std::span<const T> row, std::int64_t first) {
        for (std::size_t i = 0; i < row.size();) {
            std::size_t end = i + 1;
            while (end < row.size() && row[end] == row[i]) ++end;
            add(static_cast<double>(row[i]), first + static_cast<std::int64_t>(i), static_cast<std::int64_t>(end - i));
            i = end;
        }
    }

    void add(double value, std::int64_t index, std::int64_t length) {
        if (!(value >= 0 && value == std::floor(value) && value < 0x1p53)) not_labels(volume_.info, index, value);
        const auto label = static_cast<std::int64_t>(value);
        const Index3 low = volume_.info.extent.voxel(index), high = low + Index3{length - 1, 0, 0};
        const auto [found, is_new] = places_.try_emplace(label, regions_.size());
        if (is_new) {
            if (std::ssize(regions_) >= most_) too_many(volume_.info, most_);
            LabelRegion region;
            region.label = label, region.box_low = low, region.box_high = high;
            regions_.push_back(region);
        }
        LabelRegion& region = regions_[found->second];
        region.box_low = min(region.box_low, low), region.box_high = max(region.box_high, high);
        const auto count = static_cast<double>(length);
        region.voxels += length;
        region.position[0] += count * (static_cast<double>(low[0] + high[0]) / 2);
        region.position[1] += count * static_cast<double>(low[1]), region.position[2] += count * static_cast<double>(low[2]);
    }

    const Volume& volume_;
    std::int64_t most_;
    std::vector<LabelRegion> regions_;
    std::unordered_map<std::int64_t, std::size_t> places_;
};

std::vector<LabelRegion> regions_of(const Volume& volume, std::int64_t most, const Context& context) {
    Regions regions(volume, most);
    regions.look(context);
    return regions.take();
}

}  // namespace

SampleBox box_around(const LabelRegion& region, const Extent& extent) {
    SampleBox box{max(region.box_low - 1, Index3{}), min(region.box_high + 2, extent.size)};
    if (extent.rank == 2) box.begin[2] = 0, box.end[2] = 1;
    return box;
}

Volume mask_of(const Volume& volume, std::int64_t label, const SampleBox& box) {
    const Volume part = crop(volume, box);
    Volume mask = make_volume(part.info.extent, ValueType::u8, part.info.geometry);
    mask.info.path = volume.info.path;
    visit_samples(part, [&](auto samples) {
        std::ranges::transform(samples, mask.samples<std::uint8_t>().begin(), [&](auto sample) {
            return static_cast<std::uint8_t>(static_cast<double>(sample) == static_cast<double>(label));
        });
    });
    return mask;
}

LabelTable list_labels(const Volume& volume, const LabelOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    LabelTable table{regions_of(volume, options.max_labels, context)};
    if (!table.regions.empty() && table.regions.front().label == 0) {
        table.background = table.regions.front().voxels;
        table.regions.erase(table.regions.begin());
    }
    Context quiet = context;
    quiet.progress = {};
    for (std::size_t i = 0; i < table.regions.size(); ++i) {
        report(context, only_phase("labels"), static_cast<double>(i) / static_cast<double>(table.regions.size()));
        LabelRegion& region = table.regions[i];
        const Volume mask = mask_of(volume, region.label, box_around(region, volume.info.extent));
        const Cut at = cut(mask, kMaskLevel, {.interpolant = options.interpolant}, quiet);
        region.components = std::ssize(at.objects);
        for (const CutObject& object : at.objects)
            region.tunnels += object.b1, region.cavities += object.b2, region.measure += object.measure;
    }
    return table;
}

Surface extract_label(const Volume& volume, std::int64_t label, const ExtractOptions& options, const Context& context) {
    const EnvironmentScope scope(context);
    const std::vector<LabelRegion> regions = regions_of(volume, volume.info.extent.voxels(), context);
    const auto found = std::ranges::find(regions, label, &LabelRegion::label);
    if (found == regions.end()) {
        throw Error(ErrorKind::not_found,
                    {.file = volume.info.path,
                     .what = "no sample has the label " + std::to_string(label),
                     .expected = std::to_string(regions.size()) + " labels, " + std::to_string(regions.front().label) + " to " +
                                 std::to_string(regions.back().label),
                     .next = "choose a label of the volume"});
    }
    const SampleBox box = box_around(*found, volume.info.extent);
    ExtractOptions all = options;
    all.surface.objects.clear(), all.surface.contours.clear();
    const Volume mask = mask_of(volume, label, box);
    Surface surface = extract(mask, kMaskLevel, all, context);
    surface.tau = static_cast<double>(label);
    surface.reported_tau = volume.info.calibration.reported(surface.tau);
    std::ranges::fill(surface.object, label);
    for (std::int64_t& id : surface.contour) id = volume.info.extent.index(mask.info.extent.voxel(id) + box.begin);
    return surface;
}

}  // namespace isoatlas

// A part of a store's samples against all of them: what is wanted is right, and nothing else looks as if it were.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "oracle/stores.h"

namespace oracle {
namespace {

using isoatlas::Extent;
using isoatlas::SamplesWanted;
using isoatlas::Volume;

/// Does the cell that begins at a voxel have a value in one of the ranges?
bool has_values(const Volume& volume, const isoatlas::Index3& first, const SamplesWanted& wanted) {
    const Extent& extent = volume.info.extent;
    double low = INFINITY, high = -INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
        isoatlas::Index3 at = first;
        for (int a = 0; a < 3; ++a) at[a] = std::min(at[a] + (corner >> a & 1), extent.size[a] - 1);
        const double value = volume.value(extent.index(at[0], at[1], at[2]));
        low = std::min(low, value), high = std::max(high, value);
    }
    return std::any_of(wanted.values.begin(), wanted.values.end(), [&](const auto& range) { return high >= range[0] && low <= range[1]; });
}

bool inside(const isoatlas::SampleBox& box, const isoatlas::Index3& at) {
    for (int a = 0; a < 3; ++a) {
        if (at[a] < box.begin[a] || at[a] >= box.end[a]) return false;
    }
    return true;
}

SamplesWanted arbitrary_wish(const Volume& volume) {
    SamplesWanted wanted;
    const Extent& extent = volume.info.extent;
    const auto sample = [&] { return volume.value(*rc::gen::inRange<Index>(0, extent.voxels())); };
    for (int n = *rc::gen::inRange(0, 3); n > 0; --n) {
        const double a = sample(), b = *rc::gen::inRange(0, 3) == 0 ? sample() : a;
        wanted.values.push_back({std::min(a, b), std::max(a, b)});
    }
    for (int n = *rc::gen::inRange(0, 2); n > 0; --n) {
        isoatlas::SampleBox box{};
        for (int a = 0; a < 3; ++a) {
            box.begin[a] = *rc::gen::inRange<Index>(-2, extent.size[a]);
            box.end[a] = *rc::gen::inRange<Index>(box.begin[a], extent.size[a] + 3);
        }
        wanted.boxes.push_back(box);
    }
    return wanted;
}

RC_GTEST_FIXTURE_PROP(Stores, GiveTheRequestedSamples, ()) {
    const Grid grid = arbitrary_volume();
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    isoatlas::build_atlas(path_, volume);
    const isoatlas::Atlas atlas(path_);
    const SamplesWanted wanted = arbitrary_wish(volume);
    isoatlas::QueryCost cost;
    const Volume part = atlas.volume(wanted, {}, &cost);
    const Extent& extent = volume.info.extent;
    RC_ASSERT(part.info.extent == extent);
    RC_ASSERT(cost.cells_loaded <= extent.voxels());
    if (wanted.values.empty() && wanted.boxes.empty()) RC_ASSERT(cost.bricks == 0);
    std::vector<bool> needed(static_cast<std::size_t>(extent.voxels()));
    for (Index i = 0; i < extent.voxels(); ++i) {
        const isoatlas::Index3 at = extent.voxel(i);
        const bool shown = has_values(volume, at, wanted);
        RC_ASSERT(has_values(part, at, wanted) == shown);
        if (std::any_of(wanted.boxes.begin(), wanted.boxes.end(), [&](const auto& box) { return inside(box, at); })) needed[i] = true;
        if (!shown) continue;
        for (Index z = std::max<Index>(0, at[2] - 7); z <= std::min(extent.size[2] - 1, at[2] + 8); ++z) {
            for (Index y = std::max<Index>(0, at[1] - 7); y <= std::min(extent.size[1] - 1, at[1] + 8); ++y) {
                for (Index x = std::max<Index>(0, at[0] - 7); x <= std::min(extent.size[0] - 1, at[0] + 8); ++x)
                    needed[extent.index(x, y, z)] = true;
            }
        }
    }
    for (Index i = 0; i < extent.voxels(); ++i) RC_ASSERT(!needed[i] || part.value(i) == volume.value(i));
}

}  // namespace
}  // namespace oracle

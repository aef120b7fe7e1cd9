// Filters against sums written out over all three axes at once.
#include "isoatlas/filter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "oracle/compare.h"
#include "oracle/mesh_checks.h"
#include "oracle/volumes.h"

namespace oracle {
namespace {

using isoatlas::Context;
using isoatlas::Error;
using isoatlas::ErrorKind;
using isoatlas::SampleBox;
using isoatlas::ValueType;
using isoatlas::Volume;

/// The mean of the samples around a voxel, each weighted by its distance; beyond the ends the last sample goes on.
double mean_around(const Grid& grid, const isoatlas::Vec3& spacing, double sigma, Index voxel) {
    const std::array<Index, 3> at = grid.voxel(voxel);
    std::array<Index, 3> reach{};
    for (std::size_t a = 0; a < 3; ++a) reach[a] = grid.size[a] == 1 ? 0 : static_cast<Index>(4 * sigma / spacing[a] + 0.5);
    double sum = 0, weights = 0;
    for (Index dz = -reach[2]; dz <= reach[2]; ++dz) {
        for (Index dy = -reach[1]; dy <= reach[1]; ++dy) {
            for (Index dx = -reach[0]; dx <= reach[0]; ++dx) {
                const auto clamp = [&](std::size_t a, Index d) { return std::clamp<Index>(at[a] + d, 0, grid.size[a] - 1); };
                const double x = static_cast<double>(dx) * spacing[0], y = static_cast<double>(dy) * spacing[1],
                             z = static_cast<double>(dz) * spacing[2];
                const double weight = std::exp(-(x * x + y * y + z * z) / (2 * sigma * sigma));
                sum += weight * grid.value[grid.index(clamp(0, dx), clamp(1, dy), clamp(2, dz))];
                weights += weight;
            }
        }
    }
    return sum / weights;
}

isoatlas::Vec3 arbitrary_spacing() {
    isoatlas::Vec3 spacing{};
    for (double& s : spacing) s = *rc::gen::inRange(1, 9) / 4.0;
    return spacing;
}

SampleBox arbitrary_box(const isoatlas::Extent& extent) {
    SampleBox box{};
    for (std::size_t a = 0; a < 3; ++a) {
        box.begin[a] = *rc::gen::inRange<Index>(0, extent.size[a]);
        box.end[a] = *rc::gen::inRange<Index>(box.begin[a] + 1, extent.size[a] + 1);
    }
    return box;
}

RC_GTEST_PROP(GaussianFilter, IsTheWeightedMeanAroundEverySample, ()) {
    const Grid grid = *arbitrary_grid();
    const ValueType type = arbitrary_type(grid);
    Volume volume = to_volume(grid, type);
    volume.info.geometry.spacing = arbitrary_spacing();
    const double sigma = *rc::gen::inRange(1, 12) / 4.0;
    const Volume filtered = isoatlas::gaussian_filter(volume, sigma, arbitrary_context());
    RC_ASSERT(filtered.info.type == type);
    RC_ASSERT(filtered.info.gaussian == sigma);
    RC_ASSERT(filtered.info.geometry == volume.info.geometry);
    for (Index v = 0; v < grid.voxels(); ++v) {
        const double expected = mean_around(grid, volume.info.geometry.spacing, sigma, v);
        const double allowed = isoatlas::is_floating(type) ? 1e-5 * (1 + std::abs(expected)) : 0.5 + 1e-9;
        RC_ASSERT(std::abs(filtered.value(v) - expected) <= allowed);
    }
}

RC_GTEST_PROP(GaussianFilter, GivesTheSameBytesForAnyThreads, ()) {
    const Grid grid = *arbitrary_grid(12, 1000);
    const Volume volume = to_volume(grid, arbitrary_type(grid));
    const double sigma = *rc::gen::inRange(1, 12) / 4.0;
    Context one;
    one.threads = 1;
    RC_ASSERT(isoatlas::gaussian_filter(volume, sigma, arbitrary_context()).bytes == isoatlas::gaussian_filter(volume, sigma, one).bytes);
}

RC_GTEST_PROP(GaussianFilter, OfAPartIsThePartOfTheFiltered, ()) {
    const Grid grid = *arbitrary_grid(12, 1000);
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    const SampleBox box = arbitrary_box(volume.info.extent);
    for (auto& axis : volume.info.geometry.coordinates) axis.clear();
    const double sigma = 0.6 * volume.info.geometry.spacing[0];
    const Volume part = isoatlas::gaussian_filter(volume, box, sigma, arbitrary_context());
    const Volume expected = isoatlas::crop(isoatlas::gaussian_filter(volume, sigma), box);
    RC_ASSERT(part.bytes == expected.bytes);
    RC_ASSERT(part.info.geometry == expected.info.geometry);
    RC_ASSERT(part.info.extent == expected.info.extent);
}

RC_GTEST_PROP(Crop, KeepsSamplesWhereTheyLieInSpace, ()) {
    const Grid grid = *arbitrary_grid();
    Volume volume = to_volume(grid, arbitrary_type(grid));
    volume.info.geometry = arbitrary_geometry(grid);
    const SampleBox box = arbitrary_box(volume.info.extent);
    const Volume part = isoatlas::crop(volume, box);
    for (Index v = 0; v < part.info.extent.voxels(); ++v) {
        isoatlas::Index3 at = part.info.extent.voxel(v);
        const isoatlas::Vec3 here{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
        for (std::size_t a = 0; a < 3; ++a) at[a] += box.begin[a];
        const isoatlas::Vec3 there{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
        RC_ASSERT(part.value(v) == volume.value(volume.info.extent.index(at[0], at[1], at[2])));
        const isoatlas::Vec3 p = to_physical(part.info.geometry, here), q = to_physical(volume.info.geometry, there);
        for (std::size_t a = 0; a < 3; ++a) RC_ASSERT(std::abs(p[a] - q[a]) <= 1e-9 * (1 + std::abs(q[a])));
    }
}

TEST(GaussianFilter, ConstantsAndExtremesOfIntegersStay) {
    for (const double value : {0.0, 255.0}) {
        Volume volume = isoatlas::make_volume({3, {5, 4, 3}}, ValueType::u8);
        for (auto& sample : volume.samples<std::uint8_t>()) sample = static_cast<std::uint8_t>(value);
        EXPECT_EQ(isoatlas::gaussian_filter(volume, 1.3).bytes, volume.bytes);
    }
}

TEST(GaussianFilter, RefusesWhatItCannotDo) {
    Volume volume = isoatlas::make_volume({3, {4, 4, 4}}, ValueType::u8);
    const auto kind_and_text = [&](double sigma) {
        try {
            (void)isoatlas::gaussian_filter(volume, sigma);
            return std::pair(ErrorKind::internal, isoatlas::ErrorText{});
        } catch (const Error& error) {
            return std::pair(error.kind(), error.text());
        }
    };
    for (const double sigma : {0.0, -1.0, 1001.0, std::nan("")}) {
        EXPECT_EQ(kind_and_text(sigma).first, ErrorKind::usage) << sigma;
        EXPECT_NE(kind_and_text(sigma).second.next, "") << sigma;
    }
    volume.info.geometry.coordinates = {{{0, 1, 2, 4}, {0, 1, 2, 3}, {0, 1, 2, 3}}};
    EXPECT_EQ(kind_and_text(1).first, ErrorKind::usage);
    EXPECT_EQ(kind_and_text(1).second.reason, isoatlas::Reason::unequal_spacing);
}

TEST(Crop, RefusesBoxesThatStickOut) {
    const Volume volume = isoatlas::make_volume({3, {4, 5, 6}}, ValueType::u8);
    for (const SampleBox& box : {SampleBox{{0, 0, 0}, {5, 5, 6}}, SampleBox{{2, 0, 0}, {2, 5, 6}}, SampleBox{{-1, 0, 0}, {2, 5, 6}}}) {
        EXPECT_THROW((void)isoatlas::crop(volume, box), Error);
        EXPECT_THROW((void)isoatlas::gaussian_filter(volume, box, 1), Error);
    }
}

}  // namespace
}  // namespace oracle

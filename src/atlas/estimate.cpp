// Estimates the cost of a build: critical elements are counted in a few slabs, all else is proportional to them or to the samples.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "atlas/object_arrays.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "critical/bodies.h"
#include "critical/scan.h"
#include "field/volume_view.h"
#include "isoatlas/build.h"
#include "isoatlas/error.h"
#include "isoatlas/filter.h"

namespace isoatlas {
namespace {

constexpr double kNoise = 1.2;                             // critical elements a voxel of white noise
constexpr std::int64_t kProgram = std::int64_t{40} << 20;  // code, libraries, heap
constexpr std::int64_t kSlabs = 5, kSlabSlices = 3;

/// Critical elements of one isolated slab, without those of its first and last slice.
std::int64_t count_elements(const VolumeView& slab, double tunnel_height) {
    return visit_samples(slab, [&]<class T>(std::span<const T> samples) {
        const Extent& extent = slab.info->extent;
        const std::int64_t middle = extent.size[2] > 2 ? 1 : 0;
        std::vector<std::uint8_t> links(static_cast<std::size_t>(extent.slice()));
        std::int64_t elements = 0;
        for (const auto& chunk : scan_slab(GridView<T>{samples.data(), extent}, {middle, middle + 1}, links, tunnel_height).chunks)
            elements += static_cast<std::int64_t>(chunk.size());
        return elements;
    });
}

/// The samples seen by the filter.
VolumeInfo filtered_info(VolumeInfo info, const BuildOptions& options) {
    if (options.geometry) info.geometry = *options.geometry;
    return info;
}

/// Critical elements a voxel.
double sampled_density(VolumeReader& reader, const AnalysisOptions& options, std::int64_t budget) {
    VolumeInfo info = reader.info();
    const std::int64_t slices = info.extent.size[2], thick = std::min(kSlabSlices, slices);
    const bool is_small = info.extent.voxels() < std::int64_t{1} << 20;
    info.extent.size[2] = thick;
    const bool is_too_large = info.extent.voxels() * static_cast<std::int64_t>(size_of(info.type)) > budget / 4;
    if (!info.slab_readable || is_small || is_too_large) return kNoise;  // approximate upper bound
    std::vector<std::byte> samples(static_cast<std::size_t>(info.extent.voxels()) * size_of(info.type));
    const double height = tunnel_height_of(options.interpolant, options.tunnel_height);
    double elements = 0;
    for (std::int64_t i = 0; i < kSlabs; ++i) {
        const std::int64_t z = (slices - thick) * (2 * i + 1) / (2 * kSlabs);
        reader.read(z, z + thick, samples);
        elements += static_cast<double>(count_elements({info, samples.data()}, height));
    }
    return std::min(kNoise, elements / static_cast<double>(kSlabs * info.extent.slice()));
}

std::int64_t rounded(double bytes) { return static_cast<std::int64_t>(std::llround(bytes)); }

}  // namespace

BuildEstimate estimate_build(VolumeReader& reader, const std::string& path, const BuildOptions& options, int threads) {
    const VolumeInfo& info = reader.info();
    const auto voxels = static_cast<double>(info.extent.voxels());
    const double sample = static_cast<double>(info.calibration.slope < 0 ? sizeof(double) : size_of(info.type));
    BuildEstimate estimate;
    estimate.budget = memory_is_limited() ? memory_limit() : options.memory > 0 ? options.memory : available_memory() / 2;
    const double elements = sampled_density(reader, options.analysis, estimate.budget) * voxels;
    const double id = voxels < 0x1p31 && elements < 0x1p30 ? 4 : 8;
    const int workers = thread_count(threads);
    estimate.critical_elements = rounded(elements);
    // Sorting and trees; sizes of zones: voxels of zones across tiles are kept individually, unless few values limit them.
    const double trees = voxels * (sample + 1 + id) + elements * (32 + 8 * id);
    const double zones = voxels * (sample + id + (sample > 2 ? sample + 2 * id : 0)) + elements * (36 + 5 * id);
    // Tables of objects, measured on white noise of 64^3 to 128^3 samples: 180 to 220 bytes an element.
    const double tables = elements > 1.25 * static_cast<double>(kTableElements) ? 0 : elements * 230;
    estimate.memory = kProgram + rounded(std::max({trees, zones, tables}));
    const double window =
        options.gaussian > 0 ? static_cast<double>(2 * gaussian_radius(filtered_info(info, options), options.gaussian)[2] + 1) : 0;
    const std::int64_t filter = rounded(window * static_cast<double>(info.extent.slice()) * sizeof(double));
    // Slices of every thread; the index of bricks; counts of levels of every independent part.
    const std::int64_t slices = workers * 8 * info.extent.slice(), bricks = rounded(voxels / 16);
    const std::int64_t census = (2 * std::int64_t{workers} + 1) * 40 * rounded(std::clamp(voxels / 256, 256.0, 65535.0));
    estimate.min_memory = filter + std::max(kMinMemory, kProgram + slices + bricks + census);
    estimate.uses_scratch = estimate.memory > estimate.budget / 5 * 3;
    const double sides = options.polarities == PolarityChoice::both ? 2 : 1;
    const double stored = sides * (elements > voxels / 2 ? 3 : 7);  // bytes an element; of noise without order and values
    estimate.store_bytes = rounded(voxels * sample + elements * stored);
    std::error_code ignored;
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    const std::filesystem::space_info space = std::filesystem::space(folder.empty() ? "." : folder, ignored);
    estimate.disk_free = static_cast<std::int64_t>(std::min<std::uintmax_t>(space.available, INT64_MAX));
    estimate.disk = estimate.store_bytes + rounded(elements * stored) + (estimate.uses_scratch ? estimate.memory : 0);
    estimate.seconds = sides * (voxels * 4e-8 + elements * 8e-7) / std::min(workers, 8) + static_cast<double>(estimate.disk) / 1e9;
    return estimate;
}

void check_estimate(const BuildEstimate& estimate, const std::string& volume_path, const std::string& path) {
    if (estimate.budget < estimate.min_memory) {
        throw Error(ErrorKind::resource, {.file = volume_path,
                                          .what = "a memory budget of " + std::to_string(estimate.budget >> 20) + " MiB is too small",
                                          .expected = std::to_string((estimate.min_memory + (1 << 20) - 1) >> 20) + " MiB or more",
                                          .next = "allow more memory, or use fewer threads",
                                          .reason = Reason::memory_budget_too_small});
    }
    if (estimate.disk > estimate.disk_free) {
        throw Error(ErrorKind::resource, {.file = path,
                                          .what = "the disk has " + std::to_string(estimate.disk_free >> 20) + " MiB left",
                                          .expected = "about " + std::to_string(estimate.disk >> 20) + " MiB for store and scratch file",
                                          .next = "free some space, build on another disk, or allow more memory",
                                          .reason = Reason::no_scratch_space});
    }
}

}  // namespace isoatlas

// Sample queries of a store: boxes, downsampled volumes, and comparison with a file.
#include "atlas/access.h"
#include "base/cancel.h"
#include "base/phase.h"
#include "bricks/brick_samples.h"
#include "bricks/stored_samples.h"
#include "codec/checksum.h"
#include "formats/volume/read_slabs.h"
#include "isoatlas/atlas.h"
#include "isoatlas/environment.h"

namespace isoatlas {
namespace {

void check_box(const SampleBox& box, std::int64_t step, const VolumeInfo& info) {
    const auto refuse = [&](const std::string& where, const std::string& what, const std::string& expected) {
        throw Error(ErrorKind::usage, {.file = info.path, .where = where, .what = what, .expected = expected});
    };
    if (step < 1) refuse("step", std::to_string(step) + " is not a step", "1 or more");
    for (int a = 0; a < 3; ++a) {
        if (box.begin[a] < 0 || box.begin[a] >= box.end[a] || box.end[a] > info.extent.size[a])
            refuse("axis " + std::to_string(a), "the box is empty or exceeds the volume",
                   "samples 0 to " + std::to_string(info.extent.size[a]));
    }
}

Geometry geometry_of(const VolumeInfo& info, const SampleBox& box, std::int64_t step) {
    Geometry geometry = info.geometry;
    Vec3 first{};
    for (std::size_t a = 0; a < 3; ++a) {
        first[a] = static_cast<double>(box.begin[a]);
        geometry.spacing[a] *= static_cast<double>(step);
        std::vector<double>& places = geometry.coordinates[a];
        if (places.empty()) continue;
        std::vector<double> kept;
        for (std::int64_t i = box.begin[a]; i < box.end[a]; i += step) kept.push_back(places[i]);
        places = std::move(kept);
    }
    if (geometry.coordinates[0].empty()) geometry.origin = to_physical(info.geometry, first);
    return geometry;
}

/// Means of 8 neighbouring values, of fewer at the far ends.
CoarseVolume halved(const CoarseVolume& fine) {
    CoarseVolume result{.step = 2 * fine.step, .extent = fine.extent, .mean = {}};
    for (std::int64_t& n : result.extent.size) n = steps_along(n, 2);
    result.mean.reserve(static_cast<std::size_t>(result.extent.voxels()));
    for (std::int64_t i = 0; i < result.extent.voxels(); ++i) {
        const Index3 at = result.extent.voxel(i);
        double sum = 0;
        int count = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const std::int64_t x = 2 * at[0] + (corner & 1), y = 2 * at[1] + (corner >> 1 & 1), z = 2 * at[2] + (corner >> 2);
            if (x >= fine.extent.size[0] || y >= fine.extent.size[1] || z >= fine.extent.size[2]) continue;
            sum += static_cast<double>(fine.mean[fine.extent.index(x, y, z)]);
            ++count;
        }
        result.mean.push_back(static_cast<float>(sum / count));
    }
    return result;
}

}  // namespace

Volume Atlas::samples(const SampleBox& box, std::int64_t step, const Context& context) const {
    const EnvironmentScope scope(context);
    check_box(box, step, info());
    Extent extent = info().extent;
    for (int a = 0; a < 3; ++a) extent.size[a] = steps_along(box.end[a] - box.begin[a], step);
    Volume volume = make_volume(extent, info().type, geometry_of(info(), box, step));
    volume.info.calibration = info().calibration;
    LevelQuery spent;
    AtlasAccess::samples(*this).read_box({box.begin, box.end}, step, volume.bytes, context, spent);
    AtlasAccess::count(*this, spent, 0, nullptr);
    return volume;
}

CoarseVolume Atlas::coarse(std::int64_t max, const Context& context) const {
    const EnvironmentScope scope(context);
    constexpr std::int64_t kLargestCube = 8;  // that lies in one brick
    if (max < 1) throw Error(ErrorKind::usage, {.where = "max", .what = "no values would be left", .expected = "1 or more"});
    CoarseVolume result{.step = 1, .extent = info().extent, .mean = {}};
    while (result.extent.voxels() > max && result.step < kLargestCube) {
        result.step *= 2;
        for (int a = 0; a < 3; ++a) result.extent.size[a] = steps_along(info().extent.size[a], result.step);
    }
    result.mean.resize(static_cast<std::size_t>(result.extent.voxels()));
    LevelQuery spent;
    StoredSamples& samples = AtlasAccess::samples(*this);
    const std::int64_t layers = samples.grid().size[2];
    for (std::int64_t layer = 0; layer < layers; ++layer) {
        stop_if_cancelled(context);
        report(context, only_phase("read"), static_cast<double>(layer) / static_cast<double>(layers));
        samples.read_means(result.step, layer, result.mean, context, spent);
    }
    AtlasAccess::count(*this, spent, 0, nullptr);
    while (result.extent.voxels() > max) result = halved(result);
    return result;
}

bool Atlas::is_of(VolumeReader& volume, const Context& context) const {
    const EnvironmentScope scope(context);
    const VolumeInfo &own = info(), &other = volume.info();
    if (own.extent != other.extent || own.type != other.type) return false;
    Checksum sum;
    for_each_slab(volume, context, {}, [&sum](std::int64_t, std::span<std::byte> samples) { sum.add(samples); });
    return sum.sum() == AtlasAccess::store(*this).contents().parameters.samples_checksum;
}

}  // namespace isoatlas

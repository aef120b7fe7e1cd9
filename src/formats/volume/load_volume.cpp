// load_volume: loads a volume file into memory, slab by slab, with the policy for missing samples.
#include <algorithm>
#include <new>
#include <string>

#include "base/cancel.h"
#include "formats/common/missing.h"
#include "formats/volume/load_samples.h"
#include "formats/volume/read_slabs.h"
#include "isoatlas/environment.h"
#include "isoatlas/volume.h"

namespace isoatlas {
namespace {

[[noreturn]] void not_enough_memory(const VolumeInfo& info, std::size_t bytes) {
    throw Error(ErrorKind::resource, {.file = info.path,
                                      .what = "not enough memory for the volume: " + std::to_string(bytes) + " bytes",
                                      .next = "free some memory, or crop or downsample the volume"});
}

std::span<std::byte> room_for(std::size_t count, const Allocate& allocate, const VolumeInfo& info) {
    try {
        return allocate(count);
    } catch (const std::bad_alloc&) {
        not_enough_memory(info, count);
    } catch (const std::length_error&) {
        not_enough_memory(info, count);
    }
}

/// Reads the stored samples. Missing ones are only counted here; they are replaced at the end.
VolumeInfo load_stored(VolumeReader& reader, MissingScan& scan, const Allocate& allocate, const Context& context) {
    const VolumeInfo& info = reader.info();
    const std::span<std::byte> all = room_for(static_cast<std::size_t>(info.extent.voxels()) * size_of(info.type), allocate, info);
    for_each_slab(reader, context, all,
                  [&](std::int64_t z, std::span<std::byte> samples) { scan.look(info.type, samples, z * info.extent.slice()); });
    VolumeInfo loaded = reader.info();  // after reading, because of the notes about the end of the file
    scan.replace(loaded, all);
    return loaded;
}

/// Reads with the calibration applied: a negative slope turns high stored values into low ones, so superlevel sets must be of the
/// reported values.
VolumeInfo load_calibrated(VolumeReader& reader, MissingScan& scan, const Allocate& allocate, const Context& context) {
    const VolumeInfo& info = reader.info();
    const std::span<std::byte> bytes = room_for(static_cast<std::size_t>(info.extent.voxels()) * sizeof(double), allocate, info);
    const std::span<double> all(reinterpret_cast<double*>(bytes.data()), static_cast<std::size_t>(info.extent.voxels()));
    for_each_slab(reader, context, {}, [&](std::int64_t z, std::span<std::byte> samples) {
        const std::int64_t first = z * info.extent.slice();
        const std::span<double> out = all.subspan(static_cast<std::size_t>(first), samples.size() / size_of(info.type));
        scan.calibrate(info.type, samples, info.calibration, out);
        scan.look(ValueType::f64, std::as_writable_bytes(out), first);
    });
    VolumeInfo loaded = reader.info();
    loaded.type = ValueType::f64;
    loaded.calibration = {};
    loaded.notes.emplace_back("the calibration slope is negative: it was applied to the samples, which are float64 now");
    scan.replace(loaded, bytes);
    return loaded;
}

}  // namespace

VolumeInfo load_samples(VolumeReader& reader, const MissingPolicy& missing, const Allocate& allocate, const Context& context) {
    const bool calibrate = reader.info().calibration.slope < 0;
    MissingScan scan(reader.info(), missing, calibrate);
    return calibrate ? load_calibrated(reader, scan, allocate, context) : load_stored(reader, scan, allocate, context);
}

Volume load_volume(VolumeReader& reader, const MissingPolicy& missing, const Context& context) {
    const EnvironmentScope scope(context);
    Volume volume;
    const Allocate allocate = [&volume](std::size_t bytes) {
        volume.bytes.resize(bytes);
        return std::span<std::byte>(volume.bytes);
    };
    volume.info = load_samples(reader, missing, allocate, context);
    return volume;
}

void replace_missing(Volume& volume, const MissingPolicy& missing, const Context& context) {
    const EnvironmentScope scope(context);
    const Volume& given = volume;  // borrowed samples are copied when they are written to, and not before
    if (volume.info.calibration.slope < 0) {
        const std::int64_t slice = volume.info.extent.slice() * static_cast<std::int64_t>(size_of(volume.info.type));
        const auto reader = slab_reader(volume.info, [&](std::int64_t z_begin, std::int64_t z_end, std::span<std::byte> out) {
            std::copy(given.bytes.begin() + z_begin * slice, given.bytes.begin() + z_end * slice, out.begin());
        });
        volume = load_volume(*reader, missing, context);
        return;
    }
    MissingScan scan(volume.info, missing, false);
    const std::span<const std::byte> all(given.bytes.data(), given.bytes.size());
    const std::size_t slab = kSlabBytes, size = size_of(volume.info.type);
    for (std::size_t first = 0; first < all.size(); first += slab) {
        stop_if_cancelled(context);
        scan.look(volume.info.type, all.subspan(first, std::min(slab, all.size() - first)), static_cast<std::int64_t>(first / size));
    }
    if (scan.has_missing()) scan.replace(volume.info, volume.bytes);
}

Volume load_volume(const std::string& path, const OpenOptions& options, const MissingPolicy& missing, const Context& context) {
    const EnvironmentScope scope(context);
    const std::unique_ptr<VolumeReader> reader = open_volume(path, options);
    return load_volume(*reader, missing, context);
}

}  // namespace isoatlas

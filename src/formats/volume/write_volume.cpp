// Writes sample volumes in the format of the extension.
#include "base/atomic_file.h"
#include "formats/common/text.h"
#include "formats/common/volume_file.h"
#include "formats/volume/vdb.h"
#include "formats/volume/write_hdf5.h"
#include "formats/volume/write_zarr.h"
#include "isoatlas/output.h"
#include "isoatlas/polarity.h"

namespace isoatlas {
namespace {

using Writer = void (*)(Sink&, const VolumeInfo&, const SampleFeed&);

struct WrittenFormat {
    const char* end;
    Writer write;
};

constexpr WrittenFormat kWrittenFormats[] = {
    {".nrrd", [](Sink& sink, const VolumeInfo& info, const SampleFeed& samples) { write_nrrd(sink, info, samples, Packing::raw); }},
    {".npy", write_npy},
    {".raw", [](Sink& sink, const VolumeInfo&, const SampleFeed& samples) { write_raw(sink, samples); }},
    {".mha", write_metaimage},
    {".vti", write_vti},
    {".mrc", write_mrc},
    {".vdb", write_vdb},
    {".h5", write_hdf5},
    {".hdf5", write_hdf5},
    {".nii", [](Sink& sink, const VolumeInfo& info, const SampleFeed& samples) { write_nifti(sink, info, samples, Packing::raw); }},
    {".nii.gz", [](Sink& sink, const VolumeInfo& info, const SampleFeed& samples) { write_nifti(sink, info, samples, Packing::gzip); }},
    {".tif", [](Sink& sink, const VolumeInfo& info, const SampleFeed& samples) { write_tiff(sink, info, samples); }},
    {".tiff", [](Sink& sink, const VolumeInfo& info, const SampleFeed& samples) { write_tiff(sink, info, samples); }}};

void check_samples(const std::string& path, const Volume& volume) {
    const VolumeInfo& info = volume.info;
    if (static_cast<std::int64_t>(volume.bytes.size()) != info.extent.voxels() * static_cast<std::int64_t>(size_of(info.type))) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "the number of samples does not match the extent",
                                       .expected = std::to_string(info.extent.voxels()) + " samples"});
    }
}

/// The writer of a name, if the volume is consistent.
Writer checked_writer(const std::string& path, const Volume& volume) {
    check_samples(path, volume);
    for (const WrittenFormat& format : kWrittenFormats) {
        if (ends_with_ignoring_case(path, format.end)) return format.write;
    }
    throw Error(ErrorKind::usage,
                {.file = path,
                 .what = "the name does not say in which format to write the volume",
                 .expected = "a name that ends in .nrrd, .nii, .nii.gz, .mha, .mrc, .vdb, .h5, .vti, .npy, .tif, .raw or .zarr",
                 .next = "change the extension of the output file"});
}

SampleFeed feed_of(const Volume& volume) {
    return [&volume](const ByteSink& put) { put(volume.bytes); };
}

}  // namespace

void write_volume(Sink& sink, const Volume& volume) {
    if (is_zarr_name(sink.name())) refuse_zarr_sink(sink.name());
    if (polarity_of(volume.info) == Polarity::low) return write_volume(sink, negated(volume));
    checked_writer(sink.name(), volume)(sink, volume.info, feed_of(volume));
}

void write_volume(const std::string& path, const Volume& volume) {
    if (polarity_of(volume.info) == Polarity::low) return write_volume(path, negated(volume));
    if (is_zarr_name(path)) {
        check_samples(path, volume);
        return write_ome_zarr(path, volume);
    }
    const Writer write = checked_writer(path, volume);
    if (ends_with_ignoring_case(path, ".raw")) return write_raw(path, volume.info, feed_of(volume));
    AtomicFile file(path);
    write(file, volume.info, feed_of(volume));
    file.commit();
}

}  // namespace isoatlas

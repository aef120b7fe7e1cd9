// Writes sample volumes in the format of the extension.
#include "formats/common/text.h"
#include "formats/common/volume_file.h"
#include "isoatlas/output.h"

namespace isoatlas {

void write_volume(const std::string& path, const Volume& volume) {
    const VolumeInfo& info = volume.info;
    if (static_cast<std::int64_t>(volume.bytes.size()) != info.extent.voxels() * static_cast<std::int64_t>(size_of(info.type))) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "the number of samples does not match the extent",
                                       .expected = std::to_string(info.extent.voxels()) + " samples"});
    }
    const SampleFeed feed = [&](const ByteSink& put) { put(volume.bytes); };
    const auto ends = [&](const char* end) { return ends_with_ignoring_case(path, end); };
    if (ends(".nrrd")) return write_nrrd(path, info, feed, Packing::raw);
    if (ends(".npy")) return write_npy(path, info, feed);
    if (ends(".raw")) return write_raw(path, info, feed);
    if (ends(".mha")) return write_metaimage(path, info, feed);
    if (ends(".nii")) return write_nifti(path, info, feed, Packing::raw);
    if (ends(".nii.gz")) return write_nifti(path, info, feed, Packing::gzip);
    if (ends(".tif") || ends(".tiff")) return write_tiff(path, info, feed);
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = "the name does not say in which format to write the volume",
                                   .expected = "a name that ends in .nrrd, .nii, .nii.gz, .mha, .npy, .tif or .raw",
                                   .next = "change the extension of the output file"});
}

}  // namespace isoatlas

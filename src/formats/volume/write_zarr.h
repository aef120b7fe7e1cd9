// Writers of OME-Zarr.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "isoatlas/segmentation.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// An image with its levels, as a new folder that appears whole or not at all. Throws Error{resource}, also when there is something at
/// `path` already. Memory: 1/7 of the samples.
void write_ome_zarr(const std::string& path, const Volume& volume);

/// A group `labels/NAME` with what each label is: in a new folder, or in the one that is there, when it is an OME-Zarr of version 0.4 with
/// an image of the same sizes. A label image that is there stays: the new one gets a name with a number. Returns warnings for the user, the
/// name in use among them where it is another. segments: may be empty. Throws Error: resource, usage (a folder of something else).
std::vector<std::string> write_zarr_labels(const std::string& path, const std::string& name, std::span<const std::uint32_t> labels,
                                           std::span<const Segment> segments, const VolumeInfo& info);

/// Whether the name says OME-Zarr: it ends in .zarr.
[[nodiscard]] bool is_zarr_name(const std::string& path);
/// Throws Error{usage}: a folder is not a stream of bytes.
[[noreturn]] void refuse_zarr_sink(const std::string& name);

}  // namespace isoatlas

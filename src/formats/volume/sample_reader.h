// A VolumeReader over a stream of samples in file order (x fastest): most formats consist of a header parser, a ByteSource and this.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/common/byte_source.h"
#include "formats/common/wide_integers.h"
#include "formats/volume/choose.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Bytes of a volume of this shape and type, or of `volumes` of them in a row.
/// Throws Error{input} naming `path` for sizes below 1 and for products beyond 63 bits.
[[nodiscard]] std::int64_t sample_bytes(const std::string& path, const Extent& extent, ValueType type, std::int64_t volumes = 1);

/// Reads info.extent samples of info.type (info.big_endian: swapped) that start at position step.index * bytes of one volume of the
/// source. wide: they are integers, info.type is f64; adds a note. Sets info.slab_readable and the time step in info.volumes. Throws
/// Error{input}, before anything is allocated, when the source cannot hold step.count volumes. Bytes after the last volume are
/// Error{input}, or a note with options.skip_rest: immediately with random access, else when the last slice of the volume and the rest of
/// the stream have been read.
[[nodiscard]] std::unique_ptr<VolumeReader> make_sample_reader(VolumeInfo info, std::unique_ptr<ByteSource> source,
                                                               const OpenOptions& options, const TimeStep& step = {},
                                                               WideInteger wide = WideInteger::none);

/// Converts the texts of a header to UTF-8 without control characters. Every reader calls it.
void tidy_texts(VolumeInfo& info);

/// Reverses the bytes of every sample in place (between big and little endian).
void swap_bytes(std::span<std::byte> samples, std::size_t bytes_per_sample);
/// Whether samples of this byte order must be swapped on this machine.
[[nodiscard]] bool needs_swap(bool big_endian);

}  // namespace isoatlas

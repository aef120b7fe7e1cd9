#include "formats/volume/label_samples.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "formats/common/text.h"
#include "formats/volume/vdb.h"
#include "formats/volume/write_hdf5.h"
#include "formats/volume/write_zarr.h"

namespace isoatlas {

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;

template <class T>
SampleFeed narrowed(std::span<const std::uint32_t> labels) {
    return [labels](const ByteSink& put) {
        std::vector<T> piece(std::min(kPiece, labels.size()));
        for (std::size_t begin = 0; begin < labels.size(); begin += kPiece) {
            const std::span<const std::uint32_t> part = labels.subspan(begin, std::min(kPiece, labels.size() - begin));
            std::transform(part.begin(), part.end(), piece.begin(), [](std::uint32_t label) { return static_cast<T>(label); });
            put(std::as_bytes(std::span<const T>(piece).first(part.size())));
        }
    };
}

constexpr const char* kEnds[] = {".nrrd", ".nii", ".nii.gz", ".tif", ".tiff", ".mrc", ".vdb", ".h5", ".hdf5", ".zarr"};

constexpr std::uint32_t kMostOfMrc = 1U << 24;  ///< MRC has no integers of 32 bits, and float32 no odd ones above this

void write_mrc_labels(Sink& sink, VolumeInfo header, const SampleFeed& feed) {
    if (header.type != ValueType::u32) return write_mrc(sink, header, feed);
    header.type = ValueType::f32;
    write_mrc(sink, header, [&](const ByteSink& put) {
        std::vector<float> piece(kPiece);
        feed([&](std::span<const std::byte> bytes) {
            for (std::size_t begin = 0, size = 0; begin < bytes.size(); begin += size) {
                size = std::min(kPiece * sizeof(float), bytes.size() - begin);
                for (std::size_t i = 0; i < size / sizeof(float); ++i) {
                    std::uint32_t label = 0;
                    std::memcpy(&label, bytes.data() + begin + i * sizeof label, sizeof label);
                    piece[i] = static_cast<float>(label);
                }
                put(std::as_bytes(std::span<const float>(piece)).first(size));
            }
        });
    });
}

}  // namespace

ValueType label_type(std::span<const std::uint32_t> labels) {
    const std::uint32_t largest = labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end());
    if (largest <= std::numeric_limits<std::uint8_t>::max()) return ValueType::u8;
    return largest <= std::numeric_limits<std::uint16_t>::max() ? ValueType::u16 : ValueType::u32;
}

SampleFeed label_feed(std::span<const std::uint32_t> labels, ValueType type) {
    if (type == ValueType::u8) return narrowed<std::uint8_t>(labels);
    if (type == ValueType::u16) return narrowed<std::uint16_t>(labels);
    return [labels](const ByteSink& put) { put(std::as_bytes(labels)); };
}

void check_labels(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels) {
    if (static_cast<std::int64_t>(labels.size()) != info.extent.voxels()) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "the number of labels does not match the extent",
                                       .expected = std::to_string(info.extent.voxels()) + " labels"});
    }
    if (ends_with_ignoring_case(path, ".mrc") && !labels.empty() && std::ranges::max(labels) > kMostOfMrc) {
        throw Error(ErrorKind::unsupported, {.file = path,
                                             .what = "MRC cannot keep the label " + std::to_string(std::ranges::max(labels)),
                                             .expected = "at most " + std::to_string(kMostOfMrc),
                                             .next = "write .nrrd or .h5"});
    }
    if (std::ranges::any_of(kEnds, [&](const char* end) { return ends_with_ignoring_case(path, end); })) return;
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = "the name does not say in which format to write labels",
                                   .expected = "a name that ends in .nrrd, .nii, .nii.gz, .tif, .mrc, .vdb, .h5 or .zarr",
                                   .next = "change the extension of the output file"});
}

void write_label_file(Sink& sink, const VolumeInfo& header, const SampleFeed& feed, const KeyValues& pairs) {
    if (is_zarr_name(sink.name())) refuse_zarr_sink(sink.name());
    const auto ends = [&](const char* end) { return ends_with_ignoring_case(sink.name(), end); };
    if (ends(".nrrd")) return write_nrrd(sink, header, feed, Packing::gzip, pairs);
    if (ends(".nii")) return write_nifti(sink, header, feed, Packing::raw);
    if (ends(".nii.gz")) return write_nifti(sink, header, feed, Packing::gzip);
    if (ends(".mrc")) return write_mrc_labels(sink, header, feed);
    if (ends(".vdb")) return write_vdb_labels(sink, header, feed);
    if (ends(".h5") || ends(".hdf5")) return write_hdf5_labels(sink, header, feed, pairs);
    write_tiff(sink, header, feed, pairs);
}

}  // namespace isoatlas

// Label volumes: the smallest unsigned type that holds the largest label.
#include <algorithm>
#include <limits>
#include <vector>

#include "base/atomic_file.h"
#include "formats/common/connectivity.h"
#include "formats/common/text.h"
#include "formats/common/volume_file.h"
#include "isoatlas/output.h"

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

ValueType label_type(std::span<const std::uint32_t> labels) {
    const std::uint32_t largest = labels.empty() ? 0 : *std::max_element(labels.begin(), labels.end());
    if (largest <= std::numeric_limits<std::uint8_t>::max()) return ValueType::u8;
    return largest <= std::numeric_limits<std::uint16_t>::max() ? ValueType::u16 : ValueType::u32;
}

SampleFeed feed_of(std::span<const std::uint32_t> labels, ValueType type) {
    if (type == ValueType::u8) return narrowed<std::uint8_t>(labels);
    if (type == ValueType::u16) return narrowed<std::uint16_t>(labels);
    return [labels](const ByteSink& put) { put(std::as_bytes(labels)); };
}

/// Description of the labels in the header: a sentence and pairs.
struct Meaning {
    std::string sentence = "labels";
    KeyValues pairs;
};

Meaning meaning_of(const VolumeInfo& info, const LabelOrigin& origin) {
    const Connectivity connectivity{origin.interpolant, info.calibration.reported_difference(origin.tunnel_height)};
    const std::string end = ", " + describe(connectivity.interpolant, connectivity.tunnel_height);
    Meaning meaning{"isoatlas zones" + end, {{"labels_are", "zones"}}};
    if (origin.tau) {
        const double tau = info.calibration.reported(*origin.tau);
        const std::string what = origin.cavities ? "cavities" : "objects";
        meaning = {"isoatlas " + what + " at tau " + short_text(tau) + end, {{"labels_are", what}, {"tau", number_text(tau)}}};
    }
    for (const auto& pair : key_values(connectivity)) meaning.pairs.push_back(pair);
    return meaning;
}

constexpr const char* kEnds[] = {".nrrd", ".nii", ".nii.gz", ".tif", ".tiff"};

void check(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels) {
    if (static_cast<std::int64_t>(labels.size()) != info.extent.voxels()) {
        throw Error(ErrorKind::usage, {.file = path,
                                       .what = "the number of labels does not match the extent",
                                       .expected = std::to_string(info.extent.voxels()) + " labels"});
    }
    if (std::ranges::any_of(kEnds, [&](const char* end) { return ends_with_ignoring_case(path, end); })) return;
    throw Error(ErrorKind::usage, {.file = path,
                                   .what = "the name does not say in which format to write labels",
                                   .expected = "a name that ends in .nrrd, .nii, .nii.gz or .tif",
                                   .next = "change the extension of the output file"});
}

void write(Sink& sink, const VolumeInfo& info, std::span<const std::uint32_t> labels, const Meaning& meaning) {
    check(sink.name(), info, labels);
    VolumeInfo header;
    header.extent = info.extent;
    header.geometry = info.geometry;
    header.description = meaning.sentence;
    header.type = label_type(labels);
    const SampleFeed feed = feed_of(labels, header.type);
    const auto ends = [&](const char* end) { return ends_with_ignoring_case(sink.name(), end); };
    if (ends(".nrrd")) return write_nrrd(sink, header, feed, Packing::gzip, meaning.pairs);
    if (ends(".nii")) return write_nifti(sink, header, feed, Packing::raw);
    if (ends(".nii.gz")) return write_nifti(sink, header, feed, Packing::gzip);
    write_tiff(sink, header, feed, meaning.pairs);
}

void write(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels, const Meaning& meaning) {
    check(path, info, labels);
    AtomicFile file(path);
    write(file, info, labels, meaning);
    file.commit();
}

}  // namespace

std::vector<std::uint32_t> object_labels(const Cut& cut, std::span<const std::int64_t> objects) {
    std::vector<std::uint8_t> is_wanted(cut.objects.size() + 1, objects.empty() ? 1 : 0);  // behind -1
    for (const std::int64_t voxel : objects) {
        const bool is_inside = voxel >= 0 && voxel < static_cast<std::int64_t>(cut.label.size());
        const std::int32_t object = is_inside ? cut.label[static_cast<std::size_t>(voxel)] : -1;
        if (object < 0)
            throw Error(ErrorKind::not_found, {.what = "no object contains voxel " + std::to_string(voxel) + " at this isovalue"});
        is_wanted[static_cast<std::size_t>(object) + 1] = 1;
    }
    std::vector<std::uint32_t> labels(cut.label.size());
    std::ranges::transform(cut.label, labels.begin(), [&](std::int32_t object) {
        const auto label = static_cast<std::uint32_t>(object + 1);
        return is_wanted[label] != 0 ? label : 0;
    });
    return labels;
}

void write_labels(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels) { write(path, info, labels, {}); }

void write_labels(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels, const LabelOrigin& origin) {
    write(path, info, labels, meaning_of(info, origin));
}

void write_labels(Sink& sink, const VolumeInfo& info, std::span<const std::uint32_t> labels, const LabelOrigin& origin) {
    write(sink, info, labels, meaning_of(info, origin));
}

}  // namespace isoatlas

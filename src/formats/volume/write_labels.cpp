// Label volumes: the smallest unsigned type that holds the largest label.
#include <algorithm>
#include <vector>

#include "base/atomic_file.h"
#include "formats/common/connectivity.h"
#include "formats/volume/label_samples.h"
#include "formats/volume/write_zarr.h"
#include "isoatlas/output.h"

namespace isoatlas {

namespace {

/// Description of the labels in the header: a sentence and pairs.
struct Meaning {
    std::string sentence = "labels";
    KeyValues pairs;
};

Meaning meaning_of(const VolumeInfo& info, const LabelOrigin& origin) {
    const Connectivity connectivity = connectivity_of(info, origin.interpolant, origin.tunnel_height);
    const std::string side = connectivity.is_low() ? "low " : "";
    const std::string end = ", " + describe(connectivity.interpolant, connectivity.tunnel_height);
    Meaning meaning{"isoatlas " + side + "zones" + end, {{"labels_are", "zones"}}};
    if (origin.tau) {
        const double tau = info.calibration.reported(*origin.tau);
        const std::string what = origin.cavities ? "cavities" : "objects";
        meaning = {"isoatlas " + side + what + " at tau " + short_text(tau) + end, {{"labels_are", what}, {"tau", number_text(tau)}}};
    }
    for (const auto& pair : key_values(connectivity)) meaning.pairs.push_back(pair);
    return meaning;
}

void write(Sink& sink, const VolumeInfo& info, std::span<const std::uint32_t> labels, const Meaning& meaning) {
    check_labels(sink.name(), info, labels);
    VolumeInfo header;
    header.extent = info.extent;
    header.geometry = info.geometry;
    header.description = meaning.sentence;
    header.type = label_type(labels);
    write_label_file(sink, header, label_feed(labels, header.type), meaning.pairs);
}

void write(const std::string& path, const VolumeInfo& info, std::span<const std::uint32_t> labels, const Meaning& meaning) {
    check_labels(path, info, labels);
    if (is_zarr_name(path)) {
        VolumeInfo header;
        header.extent = info.extent, header.geometry = info.geometry;
        static_cast<void>(write_zarr_labels(path, "labels", labels, {}, header));
        return;
    }
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

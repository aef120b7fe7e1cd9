#include <span>
#include <string>

#include "field/copy_box.h"
#include "isoatlas/filter.h"

namespace isoatlas {
namespace {

std::string text_of(const Extent& extent) {
    std::string text = std::to_string(extent.size[0]) + " x " + std::to_string(extent.size[1]);
    return extent.rank == 2 ? text : text + " x " + std::to_string(extent.size[2]);
}

void check(const Extent& extent, const SampleBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (box.begin[axis] >= 0 && box.begin[axis] < box.end[axis] && box.end[axis] <= extent.size[axis]) continue;
        throw Error(ErrorKind::usage, {.what = "the box " + std::to_string(box.begin[axis]) + ":" + std::to_string(box.end[axis]) +
                                               " along axis " + std::to_string(axis) + " does not lie inside the volume",
                                       .expected = "FIRST:END, samples of a volume of " + text_of(extent),
                                       .next = "choose a box inside the volume"});
    }
}

}  // namespace

Volume crop(const Volume& volume, const SampleBox& box) {
    const Extent& whole = volume.info.extent;
    check(whole, box);
    const Extent extent{whole.rank, box.size()};
    Volume part = make_volume(extent, volume.info.type);
    part.info = volume.info;
    part.info.extent = extent;
    part.info.geometry = geometry_of(volume.info.geometry, box);
    const std::span<const std::byte> samples(volume.bytes.data(), volume.bytes.size());
    copy_box(extent.size, {samples, whole.size, box.begin}, {part.bytes, extent.size, {0, 0, 0}}, size_of(volume.info.type));
    return part;
}

}  // namespace isoatlas

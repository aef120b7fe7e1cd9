#include <cstring>
#include <string>

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
    const std::size_t size = size_of(volume.info.type), row = static_cast<std::size_t>(extent.size[0]) * size;
    std::byte* to = part.bytes.data();
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y, to += row)
            std::memcpy(to, volume.bytes.data() + static_cast<std::size_t>(whole.index(box.begin[0], y, z)) * size, row);
    }
    return part;
}

}  // namespace isoatlas

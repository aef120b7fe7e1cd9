// Boxes of samples: where they lie, and reading them from a volume that comes in slices.
#include <algorithm>
#include <cstring>

#include "isoatlas/volume.h"

namespace isoatlas {

bool is_inside(const SampleBox& box, const Extent& extent) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (box.begin[axis] < 0 || box.begin[axis] >= box.end[axis] || box.end[axis] > extent.size[axis]) return false;
    }
    return true;
}

Geometry geometry_of(const Geometry& whole, const SampleBox& box) {
    Geometry part = whole;
    Vec3 first{};  // axes with coordinates keep their origin
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double>& c = part.coordinates[axis];
        if (c.empty()) {
            first[axis] = whole.spacing[axis] * static_cast<double>(box.begin[axis]);
        } else {
            c = {c.begin() + box.begin[axis], c.begin() + box.end[axis]};
        }
    }
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) part.origin[row] += whole.direction[row][axis] * first[axis];
    }
    return part;
}

void VolumeReader::read_box(const SampleBox& box, std::span<std::byte> out) {
    const Extent& extent = info_.extent;
    const std::size_t size = size_of(info_.type), row = static_cast<std::size_t>(box.size()[0]) * size;
    if (box.begin[0] == 0 && box.begin[1] == 0 && box.end[0] == extent.size[0] && box.end[1] == extent.size[1]) {
        read(box.begin[2], box.end[2], out);
        return;
    }
    std::vector<std::byte> slice(static_cast<std::size_t>(extent.slice()) * size);
    std::byte* to = out.data();
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        read(z, z + 1, slice);
        for (std::int64_t y = box.begin[1]; y < box.end[1]; ++y, to += row)
            std::memcpy(to, slice.data() + static_cast<std::size_t>(extent.index(box.begin[0], y, 0)) * size, row);
    }
}

}  // namespace isoatlas

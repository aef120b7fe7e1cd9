// Boxes of samples: where they lie, and reading them from a volume that comes in slices.
#include "field/copy_box.h"
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
    const std::size_t sample = size_of(info_.type);
    const Index3 size = box.size();
    if (size[0] == extent.size[0] && size[1] == extent.size[1]) {
        read(box.begin[2], box.end[2], out);
        return;
    }
    std::vector<std::byte> slice(static_cast<std::size_t>(extent.slice()) * sample);
    for (std::int64_t z = box.begin[2]; z < box.end[2]; ++z) {
        read(z, z + 1, slice);
        copy_box({size[0], size[1], 1}, {slice, extent.size, {box.begin[0], box.begin[1], 0}}, {out, size, {0, 0, z - box.begin[2]}},
                 sample);
    }
}

}  // namespace isoatlas

#include "octree_front/leaf_deviation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/sample_types.h"
#include "geometry/triangles.h"
#include "mesh/place_hits.h"

namespace isoatlas {

template <class T>
Vec3 LeafDeviation<T>::place_of(const EdgeHit& hit) const {
    const Index3 first = hit.position - 1;  // a voxel, or padding
    Vec3 place{static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2])};
    const auto axis = static_cast<std::size_t>(hit.axis);
    if (first[axis] < 0) {
        place[axis] = -kHitMargin;
    } else if (first[axis] + 1 == grid_.extent.size[axis]) {
        place[axis] += kHitMargin;
    } else {
        place[axis] +=
            hit_fraction(static_cast<double>(grid_.corner(first, 0)), static_cast<double>(grid_.corner(first, 1 << hit.axis)), tau_);
    }
    return space_ == nullptr ? place : space_->point(place);
}

template <class T>
double LeafDeviation<T>::operator()(const FrontLeaf& leaf, std::span<const EdgeHit> loop, const EdgeHit& centre) const {
    thread_local std::vector<Vec3> corner;
    corner.clear();
    Vec3 middle{};
    for (const EdgeHit& hit : loop) {
        corner.push_back(place_of(hit));
        for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += corner.back()[axis] / static_cast<double>(loop.size());
    }
    if (centre.axis >= 0) middle = place_of(centre);
    double worst = 0;
    const auto look_at = [&](const EdgeHit& hit) {
        const Vec3 place = place_of(hit);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < corner.size() && nearest > worst; ++i)
            nearest = std::min(nearest, squared_distance(place, middle, corner[i], corner[(i + 1) % corner.size()]));
        worst = std::max(worst, nearest);
    };
    const Index3 first = leaf.position();
    const std::int64_t width = leaf.width();
    const std::uint64_t vertices = (std::uint64_t{1} << (width + 1)) - 1;
    for (std::int64_t z = first[2]; z <= first[2] + width; ++z) {
        for (std::int64_t y = first[1]; y <= first[1] + width; ++y) {
            const std::uint64_t row = blocks_.vertex_bits(0, {first[0], y, z});
            const std::array<std::uint64_t, 3> hits{
                (row ^ row >> 1) & vertices >> 1,
                y < first[1] + width ? (row ^ blocks_.vertex_bits(0, {first[0], y + 1, z})) & vertices : 0,
                z < first[2] + width ? (row ^ blocks_.vertex_bits(0, {first[0], y, z + 1})) & vertices : 0};
            for (int axis = 0; axis < 3; ++axis) {
                for (std::uint64_t rest = hits[static_cast<std::size_t>(axis)]; rest != 0; rest &= rest - 1)
                    look_at({{first[0] + std::countr_zero(rest), y, z}, axis});
            }
        }
    }
    return std::sqrt(worst);
}

#define ISOATLAS_INSTANTIATE(T) template class LeafDeviation<T>;
ISOATLAS_FOR_SAMPLE_TYPES(ISOATLAS_INSTANTIATE)
#undef ISOATLAS_INSTANTIATE

}  // namespace isoatlas

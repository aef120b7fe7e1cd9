#include "field/brick_grid.h"

#include <algorithm>
#include <utility>

namespace isoatlas {
namespace {

/// Is p before q in Morton order (bits of z, y, x interleaved)? The highest bit in which they differ decides (Chan 2002).
bool comes_before(const Index3& p, const Index3& q) {
    int axis = 2;
    std::int64_t max = p[2] ^ q[2];
    for (const int other : {1, 0}) {
        const std::int64_t differing = p[other] ^ q[other];
        if (max < differing && max < (max ^ differing)) axis = other, max = differing;
    }
    return p[axis] < q[axis];
}

}  // namespace

Box BrickGrid::box(BrickId brick) const {
    const Index3 at = place(brick);
    Box box{};
    for (int axis = 0; axis < 3; ++axis) {
        box.begin[axis] = at[axis] * kBrickSize[axis];
        box.end[axis] = box.begin[axis] + length(axis, at[axis]);
    }
    return box;
}

std::vector<BrickId> BrickGrid::file_order() const {
    std::vector<BrickId> order;
    order.reserve(static_cast<std::size_t>(count()));
    for (const BrickId brick : bricks()) order.push_back(brick);
    std::sort(order.begin(), order.end(), [this](BrickId p, BrickId q) { return comes_before(place(p), place(q)); });
    return order;
}

}  // namespace isoatlas

#pragma once

#include <rapidcheck/gtest.h>

#include "oracle/brick_scene.h"

namespace isoatlas {

using oracle::Scene;

inline Scene arbitrary_scene() {
    Extent extent;
    extent.rank = *rc::gen::element(2, 3, 3);
    extent.size = {*rc::gen::inRange<std::int64_t>(1, 50), *rc::gen::inRange<std::int64_t>(1, 26),
                   extent.rank == 2 ? 1 : *rc::gen::inRange<std::int64_t>(1, 26)};
    Scene scene{BrickGrid(extent), {}};
    scene.is_high.assign(static_cast<std::size_t>(extent.voxels()), *rc::gen::arbitrary<bool>());
    const auto some = *rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(0, extent.voxels()));
    for (const std::int64_t voxel : some) scene.is_high[static_cast<std::size_t>(voxel)].flip();
    return scene;
}

}  // namespace isoatlas

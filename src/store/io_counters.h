// What was read of the bricks of a store.
#pragma once

#include <cstdint>

namespace isoatlas {

/// Read statistics.
struct IoCounters {
    std::int64_t bytes = 0, extents = 0, bricks = 0;
    std::int64_t samples = 0;  ///< of the bricks
    IoCounters& operator+=(const IoCounters& other) {
        bytes += other.bytes, extents += other.extents, bricks += other.bricks, samples += other.samples;
        return *this;
    }
};

}  // namespace isoatlas

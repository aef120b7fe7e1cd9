// How fast are the bricks of a store decoded?
#pragma once

#include <isoatlas/isoatlas.h>

#include <nlohmann/json.hpp>

namespace bench {

/// Encodes whole bricks of a volume as a store does, at most 8192, from all over it; decodes them on this thread into one buffer, and
/// copies the same samples into it. Constant bricks, which have no bytes, do not count. Members: `bricks`, `sample_bytes` and
/// `packed_bytes` of all, `coded_bricks` and `coded_sample_bytes` of those that are not kept as they are; `seconds` of decoding all,
/// `coded_seconds`, `copy_seconds` of all: processor time of each repeat. Throws std::runtime_error where a decoded brick is another one.
[[nodiscard]] nlohmann::ordered_json measure_decoding(const isoatlas::Volume& volume, int repeats);

}  // namespace bench

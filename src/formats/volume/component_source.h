// One component of samples that have several, interleaved: vectors, colours.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/common/byte_source.h"

namespace isoatlas {

/// The samples of component `index` of `components` (at least 1) in a row, of sample_bytes bytes each. Reads and seeks must be whole
/// samples; whole tuples are read from `source`.
[[nodiscard]] std::unique_ptr<ByteSource> pick_component(std::unique_ptr<ByteSource> source, std::int64_t sample_bytes,
                                                         std::int64_t components, std::int64_t index);

}  // namespace isoatlas

// Criticality: what changes when an isovalue passes a critical element.
#pragma once

#include <cstdint>

namespace isoatlas {

enum class Criticality : std::uint8_t { maximum, minimum, merge, split, genus, complex };
[[nodiscard]] const char* name_of(Criticality kind);  ///< "maximum", "minimum", "merge", "split", "genus change", "complex"
/// In an analysis of negated samples (polarity.h) a maximum is a minimum of the file's values, and the other way round.
[[nodiscard]] Criticality mirrored(Criticality kind);

}  // namespace isoatlas

// Samples written as text (NRRD encoding ascii, MetaImage BinaryData = False): a ByteSource of binary samples in host byte order.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/common/byte_source.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Reads numbers separated by white space or commas from `text` (exact size known: random_access()), one per sample of `type`.
/// Floating samples are the nearest of their type. read throws Error{input} for a word that is no number of the type.
/// size_bound() follows from two characters being the least that a sample takes. A last number that nothing follows is refused where
/// `end` asks for a separator: 4 may be what is left of 41.
enum class TextEnd : std::uint8_t { separator, anything };
[[nodiscard]] std::unique_ptr<ByteSource> open_text_source(std::unique_ptr<ByteSource> text, ValueType type,
                                                           TextEnd end = TextEnd::separator);

}  // namespace isoatlas

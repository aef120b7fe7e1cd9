// Samples written as text (NRRD encoding ascii, MetaImage BinaryData = False): a ByteSource of binary samples in host byte order.
#pragma once

#include <cstdint>
#include <memory>

#include "formats/common/byte_source.h"
#include "formats/common/wide_integers.h"
#include "isoatlas/volume.h"

namespace isoatlas {

/// Reads numbers separated by white space or commas from `text` (exact size known: random_access()), one per sample of `type`.
/// Floating samples are the nearest of their type. wide: samples are integers of 64 bits, type is f64. read throws Error{input} for a word
/// that is not a number of the type. size_bound() assumes at least two characters a sample. A last number without a separator is rejected
/// where `end` requires one: 4 may be a truncated 41.
enum class TextEnd : std::uint8_t { separator, anything };
[[nodiscard]] std::unique_ptr<ByteSource> open_text_source(std::unique_ptr<ByteSource> text, ValueType type,
                                                           TextEnd end = TextEnd::separator, WideInteger wide = WideInteger::none);

}  // namespace isoatlas

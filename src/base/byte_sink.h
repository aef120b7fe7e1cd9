// ByteSink: a callback that receives the bytes of one array, piece by piece. A whole file goes to a Sink (isoatlas/sink.h).
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace isoatlas {

using ByteSink = std::function<void(std::span<const std::byte>)>;

}  // namespace isoatlas

// ByteSink: receives a stream of bytes, piece by piece.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace isoatlas {

using ByteSink = std::function<void(std::span<const std::byte>)>;

}  // namespace isoatlas

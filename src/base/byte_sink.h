// Where bytes go, one piece after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace isoatlas {

using ByteSink = std::function<void(std::span<const std::byte>)>;

}  // namespace isoatlas

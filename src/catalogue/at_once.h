// Work on both sides of a store, at the same time.
#pragma once

#include <functional>

#include "isoatlas/context.h"

namespace isoatlas {

/// Two independent jobs, at the same time unless memory is limited. The context that they get reports no progress; that of the caller is
/// asked on the calling thread only, whether it is cancelled.
void at_once(const Context& context, const std::function<void(const Context&)>& first, const std::function<void(const Context&)>& second);

}  // namespace isoatlas

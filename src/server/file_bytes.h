// Output of a file writer in memory, for downloads. No disk is touched.
#pragma once

#include <functional>
#include <string>

#include "isoatlas/context.h"

namespace isoatlas {

/// Calls write(path), which writes one file of that name from the calling thread; returns the content. extension: of the path, with the
/// dot. Throws what write() throws, and Error{cancelled}. Cost: memory for the file, twice while it grows.
[[nodiscard]] std::string file_bytes(const std::string& extension, const std::function<void(const std::string&)>& write,
                                     const Context& context = {});

}  // namespace isoatlas
